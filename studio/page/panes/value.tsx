// The value of a port: a quantity with steps, slider and unit, fitting entries, or a formula.
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import * as ask from "../drawing/ask";
import { useInSight } from "../drawing/choices";
import { draft, putBack, written } from "../drawing/drafts";
import { refuse } from "../drawing/say";
import type { Part } from "../drawing/shapes";
import { editing, fieldOf, isPending, negated, OPERATIONS, quantity, slider, spelled, stepped, converted } from "../drawing/value";
import { words } from "../drawing/words";

export function ValuePopup() {
  const now = editing.value;
  return now ? <Popup key={`${now.part.item} ${now.part.part?.name}`} part={now.part} at={now.at} /> : null;
}

function Popup({ part, at }: { part: Part; at: readonly [number, number] | null }) {
  const host = useRef<HTMLDivElement>(null);
  const [answer, setAnswer] = useState<ask.PortAnswer | null>(null);
  const { name = "", kind } = part.part ?? {};
  const close = (): void => void (editing.value = null);
  useEffect(() => {
    ask.port(part.item, name).then(setAnswer, (why) => {
      refuse(why);
      close();
    });
  }, [part]);
  useInSight(at, host, answer);
  useEffect(() => {
    const line = host.current?.querySelector<HTMLInputElement>("input[type=text]");
    line?.select();
    if (answer && !line) host.current?.querySelector<HTMLElement>("button")?.focus();
  }, [answer]);
  const key = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    event.preventDefault();
    event.stopPropagation();
    close();
  };
  // Another value may have been opened meanwhile.
  const done = (): void => void (editing.peek()?.part === part && close());
  return (
    <div class="over value-popup" ref={host} role="dialog" aria-label={words.valueOf(name)} tabIndex={-1} onKeyDown={key}>
      <div class="chooser-title">{name}{answer && <span> {answer.type}</span>}</div>
      {answer && <Value part={part} out={kind === "output"} answer={answer} done={done} left={done} />}
    </div>
  );
}

interface Given {
  part: Part;
  out: boolean;
  answer: ask.PortAnswer;
  done(): void;
  /** Called if it was left unchanged. */
  left?(): void;
}

/**
 * The controls for a value, in the popup and in the inspector. Leaving writes it; invalid text
 * stays, marked. Only `Escape` discards.
 */
export function Value({ part, out, answer, done, left }: Given) {
  const name = part.part?.name ?? "";
  const field = fieldOf(part);
  const first = answer.value ?? answer.default ?? "";
  const form = useRef<HTMLFormElement>(null);
  const discarded = useRef(false);
  const [text, setText] = useState(draft(field) ?? first);
  const [wrong, setWrong] = useState(draft(field) !== undefined);
  // An unchanged answer keeps the typed text; a changed one arrives before the next key.
  useLayoutEffect(() => setText(draft(field) ?? first), [first]);
  const set = (text: string): void => {
    setText(text);
    setWrong(false);
    discarded.current = false;
  };
  const bind = async (to: string): Promise<void> => {
    const binding = out ? { out: to } : { in: to };
    const change = { bind: { component: part.item, port: name, to: binding } };
    const isWritten = await written(field, to, () => ask.edit([change], {}, [part]));
    setWrong(!isWritten);
    if (isWritten) done();
  };
  const leave = (event: FocusEvent): void => {
    const host = form.current?.closest(".value-popup") ?? form.current;
    if (!document.hasFocus() || (event.relatedTarget instanceof Node && host?.contains(event.relatedTarget))) return;
    if (!discarded.current && text.trim() && text.trim() !== first) void bind(text.trim());
    else left?.();
  };
  const key = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    putBack(field);
    set(first);
    discarded.current = true;
  };
  const unbind = async (): Promise<void> => {
    if (await ask.edit([{ unbind: { component: part.item, port: name } }], {}, [{ item: part.item }])) done();
  };
  const submit = (event: Event): void => {
    event.preventDefault();
    if (text.trim()) void bind(text.trim());
  };
  // After an operation, an entry is its operand.
  const pick = (entry: string): void => {
    if (isPending(text)) set(`${text.trimEnd()} ${entry}`);
    else void bind(entry);
  };
  const fitting = answer.candidates.filter((candidate) => !candidate.refused);
  const known = quantity(text);
  return (
    <form class="value" ref={form} onSubmit={submit} onFocusOut={leave} onKeyDown={key}>
      {!out && known && answer.step !== null && <Steps text={text} set={set} answer={answer} />}
      {!out && answer.step !== null && <Formula text={text} set={set} answer={answer} />}
      {!out && (
        <div class="value-line">
          <input type="text" aria-label={words.formula} value={text} aria-invalid={wrong} spellcheck={false} autocomplete="off" onInput={(event) => set(event.currentTarget.value)} />
          {known && answer.units.length > 1 && <Units text={text} set={set} answer={answer} />}
          <button type="submit" class="main" aria-label={words.set} title={words.set}>✓</button>
        </div>
      )}
      {answer.range && <p class="value-hint">{words.range(answer.range[0], answer.range[1])}{answer.default && ` · ${words.isDefault(answer.default)}`}</p>}
      {fitting.length > 0 && (
        <div class="value-entries" role="group" aria-label={out ? words.writesInto : words.entriesThatFit}>
          {fitting.map((candidate) => <button type="button" class="entry-chip" key={candidate.text} onClick={() => pick(candidate.text)}>{candidate.text}</button>)}
        </div>
      )}
      {answer.value !== null && <button type="button" class="quiet" onClick={() => void unbind()}>{answer.default === null ? words.unset : words.useDefault}</button>}
    </form>
  );
}

interface Field {
  text: string;
  set(text: string): void;
  answer: ask.PortAnswer;
}

/** `−`, `+`, `±` and, for a small range, a slider. */
function Steps({ text, set, answer }: Field) {
  const { number, unit } = quantity(text)!;
  // In an unusual unit, a step is one.
  const step = unit === answer.unit ? answer.step! : 1;
  const by = (times: 1 | -1): void => set(spelled(stepped(number, step, times), unit));
  const range = slider(answer.range, unit, step);
  return (
    <div class="value-steps">
      <button type="button" aria-label={words.less} title={words.less} onClick={() => by(-1)}>−</button>
      {range ? <input type="range" aria-label={words.valueTitle} min={range.least} max={range.most} step={step} value={number} onInput={(event) => set(spelled(Number(event.currentTarget.value), unit))} /> : <output>{text}</output>}
      <button type="button" aria-label={words.more} title={words.more} onClick={() => by(1)}>+</button>
    </div>
  );
}

/** The sign and the operations of a formula, for use without a keyboard. */
function Formula({ text, set }: Field) {
  const known = quantity(text);
  const flip = (): void => set(known ? spelled(-known.number, known.unit) : negated(text.trim()));
  // A disabled button would lose the focus, and leaving the form writes.
  const isReady = text.trim() !== "" && !isPending(text);
  return (
    <div class="value-steps" role="group" aria-label={words.operations}>
      <button type="button" aria-label={words.sign} title={words.sign} aria-disabled={!isReady} onClick={() => isReady && flip()}>±</button>
      {OPERATIONS.map(([operation, sign]) => (
        <button type="button" key={operation} aria-label={words.operation(sign)} title={words.operation(sign)} aria-disabled={!isReady} onClick={() => isReady && set(`${text.trim()} ${operation} `)}>{sign}</button>
      ))}
    </div>
  );
}

function Units({ text, set, answer: { units, scales } }: Field) {
  const { number, unit } = quantity(text)!;
  const scale = (unit: string): number => scales[units.indexOf(unit)] ?? 1;
  const change = (to: string): void => set(spelled(units.includes(unit) ? converted(number, scale(unit), scale(to)) : number, to));
  return (
    <select aria-label={words.unit} value={unit} onChange={(event) => change(event.currentTarget.value)}>
      {!units.includes(unit) && <option value={unit}>{unit}</option>}
      {units.map((unit) => <option key={unit} value={unit}>{unit}</option>)}
    </select>
  );
}
