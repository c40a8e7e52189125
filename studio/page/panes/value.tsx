// The value of a port: a quantity with steps, slider and unit, fitting entries, or a formula.
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import * as ask from "../drawing/ask";
import { useInSight } from "../drawing/choices";
import { draft, putBack, written } from "../drawing/drafts";
import { refuse } from "../drawing/say";
import type { Part } from "../drawing/shapes";
import { editing, fieldOf } from "../drawing/value";
import { words } from "../drawing/words";
import { liven } from "../debug/live";
import { Steps, Units, useField, type Field } from "./field";

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
    ask.value({ item: part.item, port: name }).then(setAnswer, (why) => {
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
  const key = fieldOf(part);
  const first = answer.value ?? answer.default ?? "";
  const form = useRef<HTMLFormElement>(null);
  const discarded = useRef(false);
  const [wrong, setWrong] = useState(draft(key) !== undefined);
  const typing = (): void => {
    setWrong(false);
    discarded.current = false;
  };
  const field = useField({ item: part.item, port: name }, answer, draft(key) ?? first, typing);
  // An unchanged answer keeps the typed text; a changed one arrives before the next key.
  useLayoutEffect(() => field.show(draft(key) ?? first), [first]);
  const bind = async (to: string): Promise<void> => {
    const binding = out ? { out: to } : { in: to };
    const change = { bind: { component: part.item, port: name, to: binding } };
    const isWritten = await written(key, to, () => ask.edit([change], {}, [part]));
    setWrong(!isWritten);
    if (isWritten) done();
  };
  const leave = async (event: FocusEvent): Promise<void> => {
    const host = form.current?.closest(".value-popup") ?? form.current;
    if (!document.hasFocus() || (event.relatedTarget instanceof Node && host?.contains(event.relatedTarget))) return;
    const { text } = await field.settled();
    if (!discarded.current && text.trim() && text.trim() !== first) void bind(text.trim());
    else left?.();
  };
  const escape = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    putBack(key);
    field.type(first);
    discarded.current = true;
  };
  const unbind = async (): Promise<void> => {
    if (await ask.edit([{ unbind: { component: part.item, port: name } }], {}, [{ item: part.item }])) done();
  };
  const submit = async (event: Event): Promise<void> => {
    event.preventDefault();
    const { text } = await field.settled();
    if (text.trim()) void bind(text.trim());
  };
  // After an operation, an entry is its operand.
  const pick = async (entry: string): Promise<void> => {
    if ((await field.settled()).pending) field.use({ operand: entry });
    else void bind(entry);
  };
  const asEntry = async (): Promise<void> => {
    if (await liven(part, (await field.settled()).text)) done();
  };
  const fitting = answer.candidates.filter((candidate) => !candidate.refused);
  const { number } = field.reading;
  const isNumber = !out && number !== null && answer.step !== null;
  return (
    <form class="value" ref={form} onSubmit={(event) => void submit(event)} onFocusOut={(event) => void leave(event)} onKeyDown={escape}>
      {isNumber && <Steps field={field} />}
      {!out && answer.step !== null && <Formula field={field} />}
      {!out && (
        <div class="value-line">
          <input type="text" aria-label={words.formula} value={field.text} aria-invalid={wrong} spellcheck={false} autocomplete="off" onInput={(event) => field.type(event.currentTarget.value)} />
          {isNumber && answer.units.length > 1 && <Units field={field} units={answer.units} />}
          <button type="submit" class="main" aria-label={words.set} title={words.set}>✓</button>
        </div>
      )}
      {answer.range && <p class="value-hint">{words.range(answer.range[0], answer.range[1])}{answer.default && ` · ${words.isDefault(answer.default)}`}</p>}
      {fitting.length > 0 && (
        <div class="value-entries" role="group" aria-label={out ? words.writesInto : words.entriesThatFit}>
          {fitting.map((candidate) => <button type="button" class="entry-chip" key={candidate.text} onClick={() => void pick(candidate.text)}>{candidate.text}</button>)}
        </div>
      )}
      {isNumber && <button type="button" class="quiet" title={words.asEntryHint} onClick={() => void asEntry()}>{words.asEntry}</button>}
      {answer.value !== null && <button type="button" class="quiet" onClick={() => void unbind()}>{answer.default === null ? words.unset : words.useDefault}</button>}
    </form>
  );
}

/** The operations of formulas, each with its sign on a button. */
const OPERATIONS = [["+", "+"], ["-", "−"], ["*", "×"], ["/", "÷"]] as const;

/** The sign and the operations of a formula, for use without a keyboard. */
function Formula({ field }: { field: Field }) {
  // A disabled button would lose the focus, and leaving the form writes.
  const isReady = field.text.trim() !== "" && !field.reading.pending;
  return (
    <div class="value-steps" role="group" aria-label={words.operations}>
      <button type="button" aria-label={words.sign} title={words.sign} aria-disabled={!isReady} onClick={() => field.use("negate")}>±</button>
      {OPERATIONS.map(([operation, sign]) => (
        <button type="button" key={operation} aria-label={words.operation(sign)} title={words.operation(sign)} aria-disabled={!isReady} onClick={() => field.use({ operation })}>{sign}</button>
      ))}
    </div>
  );
}
