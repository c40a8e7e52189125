// Builds and sweeps: the plan made into a program, the plan run many times, with what jobs have said.
import { signal } from "@preact/signals";
import { Code } from "../book";
import { nameOf } from "../documents";
import { Severity } from "../icons";
import { said } from "../jobs";
import { reveal } from "../places";
import { build, built, busy, placeOf, plain, swept, sweep, type Row, type Wrong } from "../results";
import { words } from "../words";
import { report } from "./files";
import { Busy } from "./scenarios";

const seeds = signal("0..20");
const vary = signal("");
const until = signal("60s");
/** Runs of a sweep that are shown. */
const SHOWN = 200;

export function Jobs() {
  const idle = busy.value === "";
  return (
    <div class="jobs-pane">
      <form class="do" onSubmit={(event) => { event.preventDefault(); void sweep(seeds.value, vary.value, until.value); }}>
        <button type="button" disabled={!idle} onClick={() => void build()}>{words.build}</button>
        <label>{words.seeds}<input value={seeds.value} size={7} onInput={(event) => (seeds.value = event.currentTarget.value)} /></label>
        <label>{words.vary}<input value={vary.value} size={22} placeholder="walldist=20cm..60cm:10cm" onInput={(event) => (vary.value = event.currentTarget.value)} /></label>
        <label>{words.until}<input value={until.value} size={5} onInput={(event) => (until.value = event.currentTarget.value)} /></label>
        <button type="submit" disabled={!idle}>{words.sweep}</button>
        <Busy />
      </form>
      {built.value && <p class="sum" role="status">{built.value.ok ? words.buildDone : words.buildFailed}</p>}
      {built.value && built.value.wrong.length > 0 && <ul class="results" aria-label={words.buildErrors}>{built.value.wrong.map((one, at) => <Failed of={one} key={at} />)}</ul>}
      {swept.value.length > 0 && <Table rows={swept.value} />}
      <pre class="output" tabIndex={0} aria-label={words.output}>{said.value.slice(-300).map(plain).join("\n")}</pre>
    </div>
  );
}

/** An error of a build: where it has a place, a press shows it, in the drawing too; else it says what to do. */
function Failed({ of }: { of: Wrong }) {
  const { code, message, help, uri, place } = of;
  if (uri === null || !place) {
    return (
      <li class="failed">
        <div class="head"><Severity of="error" /><span>{message}</span></div>
        {help && <p>{help}</p>}
      </li>
    );
  }
  const [start, end] = [placeOf(place), placeOf(place)];
  return (
    <li class="failed">
      <div class="head">
        <Severity of="error" />
        <button onClick={() => void reveal(uri, { start, end }, "other").catch(report)}>{message}</button>
        <span class="place">{`${nameOf(uri)} ${place.line}:${place.column}`}</span>
        {code && <Code of={code} />}
      </div>
    </li>
  );
}

/** The outcomes of a sweep, a row each. */
function Table({ rows }: { rows: readonly Row[] }) {
  const runs = rows.filter((row) => "run" in row || "seed" in row);
  const names = [...new Set(runs.flatMap((row) => Object.keys(row).filter((name) => typeof row[name] !== "object")))];
  return (
    <div class="table" tabIndex={0} role="region" aria-label={words.sweep}>
      <table>
        <thead><tr>{names.map((name) => <th scope="col" key={name}>{name}</th>)}</tr></thead>
        <tbody>{runs.slice(0, SHOWN).map((row, at) => <tr key={at}>{names.map((name) => <td key={name}>{String(row[name] ?? "")}</td>)}</tr>)}</tbody>
      </table>
    </div>
  );
}
