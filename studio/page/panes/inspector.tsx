// The selection as a form: name, template, ports, exits, timing and help; without a selection, the
// plan with its entries.
import { useEffect, useRef, useState } from "preact/hooks";
import * as actions from "../drawing/actions";
import * as ask from "../drawing/ask";
import { offers } from "../drawing/catalog";
import { Icon } from "../drawing/choices";
import * as entries from "../drawing/entries";
import { about } from "../drawing/messages";
import { drawing, isEmpty } from "../drawing/model";
import { draft, putBack, written } from "../drawing/drafts";
import { component, worth, type Component as Found, type Port } from "../drawing/parts";
import { refuse } from "../drawing/say";
import { nameOf, type Drawing, type Entry, type Part } from "../drawing/shapes";
import { words } from "../drawing/words";
import { Severity, Sign } from "../screen/icons";
import { AllAbout, Code } from "../screen/book";
import { nodes } from "../screen/markdown";
import { said, severityOf } from "../plan/problems";
import { select, selected } from "../plan/selection";
import { pen } from "../server/session";
import { Value } from "./value";

export function Inspector() {
  const drawn = drawing.value;
  const part = selected.value.at(-1);
  if (!drawn || drawn.plan === null) return <p class="empty">{drawn ? words.noPlan : words.comes}</p>;
  if (selected.value.length > 1) return <p class="empty">{words.manySelected(selected.value.length)}</p>;
  const entry = part && drawn.entries.find((entry) => entry.item === part.item);
  const plan = !part || part.item === drawn.plan || part.item === `${drawn.plan}.start`;
  return (
    <fieldset class="inspector" disabled={!pen.value}>
      {plan ? <PlanForm drawn={drawn} /> : entry ? <EntryForm drawn={drawn} entry={entry} /> : <Component key={part.item} drawn={drawn} part={part} />}
    </fieldset>
  );
}

/**
 * A line that `Enter` or leaving writes. Invalid or rejected text stays for correction, and
 * `Escape` reverts. Null while its value loads.
 */
function Line({ item, label, value, take, wrong, hint, hidden }: { item: string; label: string; value: string | null; take(text: string): Promise<unknown>; wrong?(text: string): string | null; hint?: string; hidden?: boolean }) {
  const field = `${item} ${label}`;
  // From the first key, the typed text overrides the value.
  const [typed, setTyped] = useState({ over: value, text: draft(field) ?? value ?? "" });
  const [refused, setRefused] = useState(draft(field) !== undefined);
  const text = typed.over === value || refused ? typed.text : (value ?? "");
  const set = (text: string): void => {
    setTyped({ over: value, text });
    setRefused(false);
  };
  const back = (): void => {
    putBack(field);
    set(value ?? "");
  };
  const end = (): void => {
    if (text.trim() === value) return;
    const why = wrong?.(text.trim()) ?? null;
    if (why !== null) refuse(why);
    void written(field, text, async () => why === null && (await take(text.trim()))).then((done) => setRefused(!done));
  };
  const key = (event: KeyboardEvent): void => {
    if (event.key === "Enter") end();
    if (event.key === "Escape") back();
  };
  return (
    <label class="line">
      <span class={hidden ? "hidden" : ""}>{label}</span>
      <input type="text" value={text} disabled={value === null} aria-invalid={refused || (wrong !== undefined && wrong(text.trim()) !== null)} placeholder={hint} spellcheck={false} autocomplete="off" onInput={(event) => set(event.currentTarget.value)} onKeyDown={key} onBlur={end} />
    </label>
  );
}

const Name = ({ item }: { item: string }) => (
  <Line item={item} label={words.name} value={nameOf(item)} hint={words.nameHint} take={(to) => ask.edit([{ rename: { item, to } }], {}, [{ item: [...item.split(".").slice(0, -1), to].join(".") }])} />
);

/** The help text of an item, as one line. */
function Help({ item, drawn }: { item: string; drawn: Drawing }) {
  const [text, setText] = useState<string | null>(null);
  useEffect(() => {
    let wanted = true;
    ask.parts(item).then((found) => wanted && setText((found?.help ?? "").replaceAll("\n", " ")), () => {});
    return () => void (wanted = false);
  }, [item, drawn]);
  return <Line item={item} label={words.help} value={text} hint={words.helpHint} take={(text) => ask.edit([{ setDoc: { item, text } }], {}, [{ item }])} />;
}

function Wrong({ drawn, part }: { drawn: Drawing; part: Part }) {
  const found = about(drawn, part);
  if (found.length === 0) return null;
  return (
    <ul class="wrong-list">
      {found.map((problem, nth) => (
        <li key={nth}><Severity of={severityOf(problem)} /><span>{said(problem).message}<small>{said(problem).help}</small></span>{problem.code && <Code of={problem.code} />}</li>
      ))}
    </ul>
  );
}

/** Periods for selection without a keyboard. */
const PERIODS = ["5 ms", "10 ms", "20 ms", "50 ms", "100 ms"];

function Component({ drawn, part }: { drawn: Drawing; part: Part }) {
  const [found, setFound] = useState<Found | null>(null);
  const known = offers.value;
  useEffect(() => {
    let wanted = true;
    component(part.item).then((parts) => wanted && setFound(parts), () => {});
    return () => void (wanted = false);
  }, [drawn, part.item, known]);
  if (!found) return null;
  const { item, offer, timing } = found;
  const time = (keyword: "every" | "deadline") => (value: string) => ask.edit([{ setTiming: { supervisor: item, keyword, value: value || null } }], {}, [{ item }]);
  return (
    <>
      <div class="inspector-head">
        <Icon svg={offer?.icon} />
        <div><strong>{nameOf(item)}</strong><small>{found.kind}</small></div>
      </div>
      <Wrong drawn={drawn} part={{ item }} />
      <Name item={item} />
      <div class="line"><span>{words.templateOf}</span><button type="button" class="field" onClick={() => void actions.template()}>{found.template}<Sign name="down" /></button></div>
      <AllAbout item={item} template={found.template} />
      {offer && <div class="inspector-help" ref={(node) => node?.replaceChildren(nodes(offer.help))} />}
      <Ports title={words.inputs} ports={found.ports.filter(({ out }) => !out)} />
      <Ports title={words.results} ports={found.ports.filter(({ out }) => out)} />
      {found.exits.length > 0 && <h3>{words.exitsTitle}</h3>}
      {found.exits.map((exit) => (
        <button type="button" class={`row ${exit.to ? "" : "undone"}`} key={exit.name} onClick={() => { select([exit.part], "other"); void actions.whatThen(exit.part); }}>
          <span>{exit.name}</span><span class="row-value">{exit.to ? `→ ${exit.to}` : words.open}</span>
        </button>
      ))}
      {timing && <h3>{words.timing}</h3>}
      {timing && <Line item={item} label={words.every} value={timing.every} hint={words.unlessSaid} take={time("every")} />}
      {timing && <div class="periods" role="group" aria-label={words.periods}>{PERIODS.map((each) => <button type="button" aria-pressed={timing.every === each} onClick={() => void time("every")(each)} key={each}>{each}</button>)}</div>}
      {timing && <Line item={item} label={words.deadline} value={timing.deadline} hint={words.unlessSaid} take={time("deadline")} />}
      {found.computation && <Computation item={item} of={found.computation} />}
      <Help item={item} drawn={drawn} />
    </>
  );
}

/** The states of a declared computation, each with its condition and assignments. */
function Computation({ item, of: { name, states } }: { item: string; of: ask.Computation }) {
  const change = (kind: string, fields: object) => ask.edit([{ [kind]: { computation: name, ...fields } }], {}, [{ item }]);
  return (
    <fieldset class="declaration">
      <legend>{words.computation(name)}</legend>
      {states.map(({ name: state, condition, writes }) => (
        <section key={state} aria-label={state}>
          <h4>{state}</h4>
          {condition === null && <p class="value-hint">{words.otherwise}</p>}
          {condition !== null && <Line item={`${item} ${state}`} label={words.when} value={condition} hint={words.always} take={(text) => change("setCondition", { state, condition: text || null })} />}
          {writes.map(([output, formula]) => (
            <Line key={output} item={`${item} ${state}`} label={`${output} =`} value={formula} hint={words.unchanged} take={(text) => change("assign", { state, output, formula: text || null })} />
          ))}
        </section>
      ))}
    </fieldset>
  );
}

const Ports = ({ title, ports }: { title: string; ports: readonly Port[] }) => (
  <>
    {ports.length > 0 && <h3>{title}</h3>}
    {ports.map((port) => <PortRow key={port.name} port={port} />)}
  </>
);

function PortRow({ port }: { port: Port }) {
  const [open, setOpen] = useState(false);
  const host = useRef<HTMLDivElement>(null);
  // Scrolls the controls of an opened value into view.
  useEffect(() => void (open && host.current?.scrollIntoView({ block: "nearest" })), [open]);
  const { answer, name, out, part } = port;
  const missing = !answer?.value && !answer?.default && !out;
  return (
    <div class={`port ${open ? "open" : ""}`} ref={host}>
      <button type="button" class={`row ${missing ? "undone" : ""} ${answer?.value ? "" : "default"}`} aria-expanded={open} onClick={() => setOpen(!open)}>
        <span>{name}</span><span class="row-value">{out && answer?.value ? "⇒ " : ""}{worth(port)}</span>
      </button>
      {open && answer && <Value part={part} out={out} answer={answer} done={() => setOpen(false)} />}
    </div>
  );
}

function PlanForm({ drawn }: { drawn: Drawing }) {
  const plan = drawn.plan!;
  return (
    <>
      <div class="inspector-head"><div><strong>{plan}</strong><small>plan</small></div></div>
      {!isEmpty.value && <Wrong drawn={drawn} part={{ item: plan }} />}
      <Name item={plan} />
      <Help item={plan} drawn={drawn} />
      <h3>{words.entries}<button type="button" class="tool" aria-label={words.addEntry} title={words.addEntry} onClick={() => void entries.add()}><Sign name="plus" /></button></h3>
      {drawn.entries.length === 0 && <p class="value-hint">{words.noEntries}</p>}
      {drawn.entries.map((entry) => (
        <button type="button" class="row" key={entry.item} onClick={() => select([{ item: entry.item }], "other")}>
          <span><em>{entry.kind}</em> {entry.name}</span><span class="row-value">{[entry.type, entry.value].filter(Boolean).join(" = ")}</span>
        </button>
      ))}
    </>
  );
}

function EntryForm({ drawn, entry }: { drawn: Drawing; entry: Entry }) {
  const { item } = entry;
  const edit = (change: string, fields: object) => ask.edit([{ [change]: { entry: item, ...fields } }], {}, [{ item }]);
  return (
    <>
      <div class="inspector-head"><div><strong>{entry.name}</strong><small>{words.entryKinds[entry.kind]}</small></div></div>
      <Wrong drawn={drawn} part={{ item }} />
      <Name item={item} />
      <label class="line">
        <span>{words.kindOf}</span>
        <select value={entry.kind} onChange={(event) => void edit("setEntryKind", { keyword: event.currentTarget.value })}>
          {Object.entries(words.entryKinds).map(([kind, label]) => <option key={kind} value={kind}>{label}</option>)}
        </select>
      </label>
      <Line item={item} label={words.typeOf} value={entry.type ?? ""} take={(ty) => edit("setEntryType", { ty: ty || null })} />
      <Line item={item} label={words.valueTitle} value={entry.value ?? ""} take={(value) => edit("setEntryValue", { value: value || null })} />
      <Help item={item} drawn={drawn} />
      <button type="button" class="quiet" onClick={() => void actions.remove([{ item }])}>{words.removeEntry(entry.name ?? "")}</button>
    </>
  );
}
