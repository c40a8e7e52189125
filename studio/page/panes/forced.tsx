// Forced values of a run: a bar that stays visible, with an end button, and the form that forces an
// entry.
import { useState } from "preact/hooks";
import { active, order, state, stop } from "../debug/run";
import { Sign } from "../screen/icons";
import { words } from "../words";

/** Durations in seconds. */
const SECONDS = [10, 60, 600] as const;

export function ForcedBar() {
  const now = state.value;
  if (!active.value || !now?.forced.length) return null;
  return (
    <div class="forced-bar" role="alert">
      <Sign name="lock" />
      <strong>{words.forced}</strong>
      {now.forced.map(({ path, value, until }) => (
        <span class="one" key={path}>
          {words.forcedOne(path, value, Math.max(0, until - now.at))}
          <button onClick={() => void order("afp/release", { path })}>{words.release}</button>
        </span>
      ))}
      <button class="stop" onClick={() => void stop()}>{words.stop}</button>
    </div>
  );
}

/** Forces an entry to a value, with a unit, for a while. */
export function Force({ entry, value, done }: { entry: string; value: string; done: () => void }) {
  const [text, setText] = useState(value);
  const [seconds, setSeconds] = useState<number>(SECONDS[0]);
  const force = (event: Event): void => {
    event.preventDefault();
    void order("afp/force", { path: entry, value: text, seconds });
    done();
  };
  return (
    <form class="force" onSubmit={force}>
      <input aria-label={words.valueOf(entry)} value={text} spellcheck={false} autocomplete="off" onInput={(event) => setText(event.currentTarget.value)} ref={(node) => node?.focus()} />
      <select aria-label={words.lasting} value={seconds} onChange={(event) => setSeconds(Number(event.currentTarget.value))}>
        {SECONDS.map((each) => <option value={each} key={each}>{words.lastingOf(each)}</option>)}
      </select>
      <button class="main" type="submit">{words.force}</button>
      <button type="button" onClick={done}>{words.cancel}</button>
    </form>
  );
}
