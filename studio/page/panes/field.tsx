// The field of a value: its text, and the controls that the engine offers for it.
import { useEffect, useRef, useState } from "preact/hooks";
import * as ask from "../drawing/ask";
import { refuse } from "../drawing/say";
import { words } from "../drawing/words";

export interface Field {
  text: string;
  /** The latest reading; that of a text just typed follows. */
  reading: ask.Reading;
  /** Shows another text. */
  show(text: string): void;
  /** Takes the text of a key. */
  type(text: string): void;
  /** Uses a control, after the earlier ones. */
  use(control: ask.Control): void;
  /** The reading after all keys and controls. */
  settled(): Promise<ask.Reading>;
}

export function useField(of: ask.Valued, answer: ask.PortAnswer, first: string, typing: () => void = () => {}): Field {
  const [text, setText] = useState(first);
  const [reading, setReading] = useState(answer.reading);
  const now = useRef(answer.reading);
  const typed = useRef(first);
  const queue = useRef<Promise<unknown>>(Promise.resolve());
  const show = (text: string): void => {
    typed.current = text;
    setText(text);
    if (text !== now.current.text) read();
  };
  const read = (control?: ask.Control): void => {
    queue.current = queue.current
      .then(async () => {
        const asked = typed.current;
        const found = await ask.value(of, asked, control);
        // Typing overrides a control.
        if (!found || typed.current !== asked) return;
        [now.current, typed.current] = [found.reading, found.reading.text];
        setText(found.reading.text);
        setReading(found.reading);
      })
      .catch(refuse);
  };
  useEffect(() => {
    if (first !== answer.reading.text) read();
  }, []);
  const settled = async (): Promise<ask.Reading> => {
    for (let last = null; last !== queue.current; ) await (last = queue.current);
    return { ...now.current, text: typed.current };
  };
  const type = (text: string): void => {
    typing();
    show(text);
  };
  const use = (control: ask.Control): void => {
    typing();
    read(control);
  };
  return { text, reading, show, type, use, settled };
}

/** `−`, `+` and, for a small range, a slider. */
export function Steps({ field }: { field: Field }) {
  const { number, slider, step } = field.reading;
  return (
    <div class="value-steps">
      <button type="button" aria-label={words.less} title={words.less} onClick={() => field.use("less")}>−</button>
      {slider ? <Slider label={words.valueTitle} ends={slider} step={step} number={number!} take={(number) => field.use({ number })} /> : <output>{field.text}</output>}
      <button type="button" aria-label={words.more} title={words.more} onClick={() => field.use("more")}>+</button>
    </div>
  );
}

interface Sliding {
  label: string;
  ends: readonly [least: number, most: number];
  step: number | null;
  number: number;
  take(number: number): void;
}

/** A slider. While it is dragged, its place does not depend on answers. */
export function Slider({ label, ends: [least, most], step, number, take }: Sliding) {
  const [own, setOwn] = useState<number | null>(null);
  const input = (to: number): void => {
    setOwn(to);
    take(to);
  };
  return (
    <input
      type="range" aria-label={label} min={Math.min(least, number)} max={Math.max(most, number)} step={step ?? "any"} value={own ?? number}
      onInput={(event) => input(Number(event.currentTarget.value))} onChange={() => setOwn(null)}
    />
  );
}

export function Units({ field, units }: { field: Field; units: readonly string[] }) {
  const { unit } = field.reading;
  return (
    <select aria-label={words.unit} value={unit} onChange={(event) => field.use({ unit: event.currentTarget.value })}>
      {!units.includes(unit) && <option value={unit}>{unit}</option>}
      {units.map((unit) => <option key={unit} value={unit}>{unit}</option>)}
    </select>
  );
}
