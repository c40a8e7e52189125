// Run, pause, step and stop in the bar, and the card at the end of a run.
import { useState } from "preact/hooks";
import { hasNoPlan, Tool } from "../screen/bar";
import { command } from "../screen/commands";
import { reveal } from "../drawing/reveal";
import { refuse } from "../drawing/say";
import { words as drawn } from "../drawing/words";
import { Sign } from "../screen/icons";
import { number } from "../plan/problems";
import { select } from "../plan/selection";
import { words } from "../words";
import { robot } from "./attached";
import { toggleSelected } from "./breakpoints";
import { step } from "./robot";
import { askWhy } from "./why";
import { active, again, back, dismiss, ended, fork, frames, goOn, into, log, next, older, out, pause, phase, said, setSpeed, speed, state, stop, turns } from "./run";

const SPEEDS = [0.25, 0.5, 1, 2, 5, 20, null] as const;

/** Time of the run; before the start, the step that it waits for. */
function Clock({ at }: { at: number | undefined }) {
  const text = at === undefined ? (said.value.at(-1)?.text ?? words.starting) : words.seconds(at);
  return <span class={`clock ${phase.value}`} title={at === undefined ? text : undefined}>{text}</span>;
}

export function Controls() {
  const now = phase.value;
  const held = now === "held";
  const at = state.value?.at;
  return (
    <div class="controls" role="group" aria-label={words.runPane}>
      {older.value && active.value && !robot.value && (
        <button class="older" onClick={() => void again()} title={`${words.older} ${words.runAgain}`} aria-label={`${words.older} ${words.runAgain}`}>
          <Sign name="again" />
          <span>{words.olderText}</span>
        </button>
      )}
      {active.value && <Clock at={at} />}
      {held && log.value && <Tool icon="run" label={words.forkLog} run={() => void fork()} />}
      {held && turns.value && <Tool icon="back" label={`${words.stepBack} (Shift+F10)`} run={back} />}
      {held && !robot.value && <Tool icon="next" label={`${words.step} (F10)`} run={next} />}
      {held && !robot.value && <Tool icon="into" label={`${words.stepInto} (F11)`} run={into} />}
      {held && !robot.value && <Tool icon="out" label={`${words.stepOut} (Shift+F11)`} run={out} />}
      {(active.value || now === "over") && <Tool icon="why" label={`${words.why} (W)`} run={askWhy} />}
      {now === "running" && !robot.value && <Tool icon="pause" label={`${words.pause} (F8)`} run={pause} />}
      {active.value && !robot.value && <Tool icon="stop" label={`${words.stop} (Shift+F5)`} run={stop} />}
      {now !== "running" && now !== "starting" && !(robot.value && held) && (
        <button class={`run ${number("error") || hasNoPlan() ? "" : "main"}`} onClick={() => void goOn()} title={`${held ? words.goOn : words.run} (F5)`}>
          <Sign name="run" />
          <span>{held ? words.goOn : words.run}</span>
        </button>
      )}
      {!robot.value && <select aria-label={words.speed} title={words.speed} value={String(speed.value)} onChange={(event) => setSpeed(event.currentTarget.value === "null" ? null : Number(event.currentTarget.value))}>
        {SPEEDS.map((factor) => <option value={String(factor)} key={factor}>{words.speedOf(factor)}</option>)}
      </select>}
    </div>
  );
}

export function EndCard() {
  const end = ended.value;
  if (!end || active.value) return null;
  return (
    <section class={`end-card ${end.ending}`} role="status" aria-label={words.ended(end.ending)}>
      <h2>{words.ended(end.ending)}</h2>
      {end.sentences.map((sentence) => <p key={sentence}>{sentence}</p>)}
      {end.again && <Again command={end.again} key={end.again} />}
      <div class="choices">
        {end.by?.edge && <button onClick={() => showEnd(end.by!.edge!)}>{words.endedAt}</button>}
        <button onClick={dismiss}>{words.ok}</button>
        {!robot.value && <button class="main" onClick={() => void again()}>{words.runAgain}</button>}
      </div>
    </section>
  );
}

/** Command line that repeats the run. */
function Again({ command }: { command: string }) {
  const [copied, setCopied] = useState(false);
  const copy = () => navigator.clipboard.writeText(command).then(() => setCopied(true), () => refuse(drawn.noClipboard));
  return (
    <details>
      <summary>{words.onceMore}</summary>
      <code>{command}</code>
      <button onClick={() => void copy()}>{copied ? words.copied : words.copyIt}</button>
    </details>
  );
}

/** Selects the edge that ended the outermost plan. */
function showEnd(edge: string): void {
  const plan = frames.value[0]?.plan;
  const names = edge.split(".");
  const part = { item: [plan, ...names.slice(0, -1)].join("."), part: { kind: "exit", name: names.at(-1)!, nth: 1 } };
  select([part], "other");
  reveal(part);
}

export function commands(): void {
  command({ id: "run", label: words.run, key: "F5", run: goOn, enabled: () => !active.value });
  command({ id: "go", label: words.goOn, key: "F5", run: goOn, enabled: () => phase.value === "held" });
  command({ id: "pause", label: words.pause, key: "F8", run: pause, enabled: () => phase.value === "running" });
  command({ id: "step", label: words.step, key: "F10", run: () => (robot.peek() ? step() : next()), enabled: () => phase.value !== "running" });
  command({ id: "into", label: words.stepInto, key: "F11", run: into, enabled: () => phase.value !== "running" && !robot.value });
  command({ id: "out", label: words.stepOut, key: "Shift+F11", run: out, enabled: () => phase.value === "held" && !robot.value });
  command({ id: "back", label: words.stepBack, key: "Shift+F10", run: back, enabled: () => phase.value === "held" && turns.value });
  command({ id: "stop", label: words.stop, key: "Shift+F5", run: stop, enabled: () => active.value });
  command({ id: "breakpoint", label: words.breakpoint, key: "F9", run: () => void toggleSelected() });
  command({ id: "why", label: words.why, key: "W", where: "drawing", run: askWhy, enabled: () => phase.value !== "idle" });
  command({ id: "fork", label: words.forkLog, run: fork, enabled: () => phase.value === "held" && log.value !== "" });
  command({ id: "again", label: words.runAgain, key: "Ctrl+Shift+F5", run: again, enabled: () => phase.value !== "idle" && !robot.value });
}
