// The value of an entry during a run: a slider, steps or choices that write it at once. *Keep* makes
// it the first value in the text.
import { useEffect, useRef, useState } from "preact/hooks";
import { keep, opened, write } from "../debug/live";
import { frames, state } from "../debug/run";
import * as ask from "../drawing/ask";
import { useInSight } from "../drawing/choices";
import { refuse } from "../drawing/say";
import { nameOf, type Point } from "../drawing/shapes";
import { words as drawn } from "../drawing/words";
import { pen } from "../server/session";
import { words } from "../words";
import { Slider } from "./field";

/** The control of an entry of the outermost plan; nothing for an entry that a run cannot change. */
export function Live({ name, value }: { name: string; value: string }) {
  const { uri, plan } = frames.value[0]!;
  const item = `${plan}.${name}`;
  const [answer, setAnswer] = useState<ask.PortAnswer | null>(null);
  useEffect(() => {
    let wanted = true;
    if (uri) ask.value({ uri, item }).then((found) => wanted && setAnswer(found), () => {});
    return () => void (wanted = false);
  }, [uri, item]);
  if (!uri || !answer?.writable) return null;
  return <Control of={{ uri, item }} value={value} answer={answer} />;
}

function Control({ of, value, answer }: { of: ask.Valued; value: string; answer: ask.PortAnswer }) {
  const name = nameOf(of.item);
  const [reading, setReading] = useState<ask.Reading | null>(null);
  const latest = useRef("");
  const [isKept, setKept] = useState(false);
  const take = async (text: string, control: ask.Control): Promise<string> => {
    const found = await ask.value(of, text, control);
    if (found) setReading(found.reading);
    latest.current = found?.reading.text ?? text;
    return latest.current;
  };
  // The run's value, in the unit of the text.
  useEffect(() => {
    void take(value, { unit: answer.reading.unit || answer.unit }).catch(refuse);
  }, [value]);
  const use = (control: ask.Control): void => {
    setKept(false);
    void take(latest.current, control).then((text) => write(name, text), refuse);
  };
  const keepIt = async (): Promise<void> => {
    const text = reading?.number === null ? value : latest.current;
    setKept((await keep(of.item, text)) !== null);
  };
  const { number = null, slider = null, step = null } = reading ?? {};
  return (
    <span class="live" role="group" aria-label={words.liveOf(name)}>
      {number !== null && step !== null && (
        <>
          <button type="button" class="tool" aria-label={drawn.less} title={drawn.less} onClick={() => use("less")}>−</button>
          {slider && <Slider label={words.liveOf(name)} ends={slider} step={step} number={number} take={(number) => use({ number })} />}
          <button type="button" class="tool" aria-label={drawn.more} title={drawn.more} onClick={() => use("more")}>+</button>
        </>
      )}
      {answer.candidates.length > 0 && (
        <select aria-label={words.liveOf(name)} value={value} onChange={(event) => void write(name, event.currentTarget.value)}>
          {answer.candidates.map(({ text }) => <option key={text}>{text}</option>)}
        </select>
      )}
      <button type="button" class="keep" title={words.keepHint} disabled={!pen.value || isKept} onClick={() => void keepIt()}>{isKept ? words.kept : words.keepIt}</button>
    </span>
  );
}

export function LivePopup() {
  const now = opened.value;
  const name = now ? nameOf(now.item) : "";
  const value = state.value?.entries[name];
  return now && value !== undefined ? <Popup key={name} name={name} at={now.at} value={value} /> : null;
}

function Popup({ name, at, value }: { name: string; at: Point | null; value: string }) {
  const host = useRef<HTMLDivElement>(null);
  useInSight(at, host, null);
  useEffect(() => host.current?.focus(), []);
  const close = (): void => void (opened.value = null);
  const key = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    event.preventDefault();
    event.stopPropagation();
    close();
  };
  const leave = (event: FocusEvent): void => {
    if (document.hasFocus() && !host.current?.contains(event.relatedTarget as Node)) close();
  };
  return (
    <div class="over value-popup live-popup" ref={host} role="dialog" aria-label={words.liveOf(name)} tabIndex={-1} onKeyDown={key} onFocusOut={leave}>
      <div class="chooser-title">{name}<span> {value}</span></div>
      <Live name={name} value={value} />
    </div>
  );
}
