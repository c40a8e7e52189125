// The run as text: values of entries and messages; a click shows the source.
import { useEffect, useRef, useState } from "preact/hooks";
import { Tool } from "../screen/bar";
import { changes, phase, revealSaid, said, state, why } from "../debug/run";
import { words } from "../words";
import { Force } from "./forced";
import { Live } from "./live";
import { Stops } from "./stops";

/** Maximum number of displayed lines; the newest are last. */
const SHOWN = 300;

export function RunPane() {
  const [forcing, setForcing] = useState("");
  const list = useRef<HTMLOListElement>(null);
  const lines = said.value.slice(-SHOWN);
  const [reads, setReads] = useState(false);
  // Does not scroll if the user has scrolled up.
  useEffect(() => {
    const host = list.current;
    if (host && !reads) host.scrollTop = host.scrollHeight;
  }, [lines.at(-1)]);
  const scrolled = ({ currentTarget: { scrollHeight, scrollTop, clientHeight } }: { currentTarget: HTMLElement }): void => setReads(scrollHeight - scrollTop - clientHeight > 40);
  const entries = Object.entries(state.value?.entries ?? {});
  return (
    <div class="run-pane">
      <section aria-label={words.entries}>
        <h3>{words.entries}</h3>
        <dl>
          {entries.map(([name, value]) => (
            <div key={name}>
              <dt>{name}</dt>
              {forcing === name ? (
                <dd><Force entry={name} value={String(value)} done={() => setForcing("")} /></dd>
              ) : (
                <dd>
                  {String(value)}
                  {changes.value && !name.includes(".") && <Live name={name} value={String(value)} />}
                  {changes.value && !name.includes(".") && <Tool icon="lock" label={words.forceEntry(name)} run={() => setForcing(name)} />}
                </dd>
              )}
            </div>
          ))}
        </dl>
      </section>
      <section aria-label={words.happened}>
        {phase.value === "idle" && !lines.length && <p class="none">{words.noRun}</p>}
        <h3>{words.happened}{phase.value === "held" && why.value ? `: ${why.value}` : ""}</h3>
        <ol ref={list} tabIndex={0} aria-label={words.happened} onScroll={scrolled}>
          {lines.map((each, at) => (
            <li key={at} class={each.kind}>
              {each.path ? <button onClick={() => revealSaid(each)}>{each.text}</button> : <span>{each.text}</span>}
            </li>
          ))}
        </ol>
      </section>
      <Stops />
    </div>
  );
}
