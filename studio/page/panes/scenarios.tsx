// Scenarios: written and run here, with results; a failed one is shown at its moment.
import { useState } from "preact/hooks";
import { uriOf } from "../documents/addresses";
import { current } from "../documents/documents";
import { Severity, Sign } from "../screen/icons";
import { end, running } from "../jobs/jobs";
import { reveal } from "../plan/places";
import { busy, coverage, results, runAll, showFailure, shown, writeSome, type Result } from "../jobs/results";
import { files } from "../server/session";
import { report } from "./files";
import { words } from "../words";

export function Scenarios() {
  const all = results.value;
  const failed = all?.filter(({ passed }) => !passed).length ?? 0;
  const file = current.value.endsWith(".afp");
  return (
    <div class="jobs-pane">
      <div class="do">
        <button disabled={busy.value !== "" || !file} onClick={() => void writeSome()}>{words.writeSome}</button>
        <button class="main" disabled={busy.value !== ""} onClick={() => void runAll()}>{words.runScenarios}</button>
        {all && <label class="check"><input type="checkbox" checked={shown.value} onChange={(event) => (shown.value = event.currentTarget.checked)} />{words.onDrawing}</label>}
        <Busy />
      </div>
      {all && <p class="sum" role="status">{failed ? <Severity of="error" /> : <Sign name="check" />}{words.cameTo(all.length - failed, all.length)}</p>}
      {!all && <p class="empty">{hasScenarios() ? words.runThem : words.noScenarios}</p>}
      {all && <ul class="results">{all.map((one) => <One result={one} key={`${one.file}:${one.line}`} />)}</ul>}
      {all && coverage.value.length > 0 && <Unused />}
    </div>
  );
}

const hasScenarios = (): boolean => files.value.some(({ name }) => /(^|\/)(tests|scenarios)\/.*\.afp$/.test(name));

/** Progress with a stop button. */
export const Busy = () =>
  busy.value ? (
    <span class="busy" role="status">
      {busy.value} {running.value.at(-1)?.last}
      {running.value.map(({ id }) => <button onClick={() => void end(id).catch(report)} key={id}>{words.endJob}</button>)}
    </span>
  ) : null;

function One({ result }: { result: Result }) {
  const [open, setOpen] = useState(false);
  const { scenario, passed, broken, error, file, line } = result;
  const place = { line: line - 1, character: 0 };
  return (
    <li class={passed ? "" : "failed"}>
      <div class="head">
        {passed ? <Sign name="check" /> : <Severity of="error" />}
        <button onClick={() => setOpen(!open)} aria-expanded={open}>{scenario}</button>
        {!passed && !error && <button class="show" onClick={() => void showFailure(result).catch(report)}>{words.showMoment}</button>}
      </div>
      {!passed && (broken ?? []).slice(0, open ? 100 : 1).map(({ text, at_s, why }) => <p key={text}>{`${words.seconds(at_s)}: ${text}: ${why}`}</p>)}
      {error && <pre>{error}</pre>}
      {open && <button onClick={() => void reveal(uriOf(file), { start: place, end: place }, "other").catch(report)}>{words.inText(`${file.split("/").at(-1)}:${line}`)}</button>}
    </li>
  );
}

/** Items that no scenario used. */
function Unused() {
  const unused = coverage.value.flatMap(({ coverage: plan, parts }) => parts.filter(({ count }) => count === 0).map(({ kind, name }) => `${plan}: ${kind} ${name}`));
  return (
    <details>
      <summary>{words.neverUsed(unused.length)}</summary>
      <ul>{unused.map((each) => <li key={each}>{each}</li>)}</ul>
    </details>
  );
}
