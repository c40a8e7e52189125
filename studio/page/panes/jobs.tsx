// Builds and sweeps, with the output of jobs.
import { effect, signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import * as ask from "../drawing/ask";
import { Code } from "../screen/book";
import { nameOf } from "../documents/documents";
import { drawing } from "../drawing/model";
import type { Entry } from "../drawing/shapes";
import { Severity } from "../screen/icons";
import { said } from "../jobs/jobs";
import { reveal } from "../plan/places";
import { build, built, busy, placeOf, sweep, type Wrong } from "../jobs/results";
import { words } from "../words";
import { report } from "./files";
import { Busy } from "./scenarios";
import { Sweep } from "./sweep";

const seeds = signal("0..20");
/** The varied inputs: one for the columns of the map, one for its rows. */
const vary = signal<readonly [string, string]>(["", ""]);
const until = signal("60 s");

const KEY = "afp-studio-sweep";

/** Restores the fields after a reload, and starts to store them. */
export function begin(storage: Storage): void {
  try {
    [seeds.value, vary.value, until.value] = JSON.parse(storage.getItem(KEY) ?? "") as [string, [string, string], string];
  } catch {
    // Nothing is stored yet.
  }
  effect(() => storage.setItem(KEY, JSON.stringify([seeds.value, vary.value, until.value])));
}

export function Jobs() {
  const idle = busy.value === "";
  const ranges = useSuggested();
  return (
    <div class="jobs-pane">
      <form class="do" onSubmit={(event) => { event.preventDefault(); void sweep(seeds.value, vary.value.filter((each) => each.trim()), until.value); }}>
        <button type="button" disabled={!idle} onClick={() => void build()}>{words.build}</button>
        <label>{words.seeds}<input value={seeds.value} size={7} onInput={(event) => (seeds.value = event.currentTarget.value)} /></label>
        <label>{words.vary}<input value={vary.value[0]} size={24} list="ranges" placeholder={words.varyHint} onInput={(event) => (vary.value = [event.currentTarget.value, vary.value[1]])} /></label>
        {vary.value[0] && <label>{words.varyToo}<input value={vary.value[1]} size={24} list="ranges" onInput={(event) => (vary.value = [vary.value[0], event.currentTarget.value])} /></label>}
        <datalist id="ranges">{ranges.map((range) => <option value={range} key={range} />)}</datalist>
        <label>{words.until}<input value={until.value} size={5} onInput={(event) => (until.value = event.currentTarget.value)} /></label>
        <button type="submit" disabled={!idle}>{words.sweep}</button>
        <Busy />
      </form>
      {built.value && <p class="sum" role="status">{built.value.ok ? words.buildDone : words.buildFailed}</p>}
      {built.value && built.value.wrong.length > 0 && <ul class="results" aria-label={words.buildErrors}>{built.value.wrong.map((one, at) => <Failed of={one} key={at} />)}</ul>}
      <Sweep />
      <pre class="output" role="log" tabIndex={0} aria-label={words.output}>{said.value.slice(-300).join("\n")}</pre>
    </div>
  );
}

/**
 * A build error: a press shows its place, also in the drawing; without a place it shows its help.
 */
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

/** Suggested ranges for inputs, around their values as the engine reads them. */
function useSuggested(): readonly string[] {
  const [ranges, setRanges] = useState<readonly string[]>([]);
  const drawn = drawing.value;
  useEffect(() => {
    let wanted = true;
    const inputs = (drawn?.entries ?? []).filter(({ kind }) => kind === "in");
    const range = async ({ item, name }: Entry): Promise<string[]> => {
      const { number = null, unit = "" } = (await ask.value({ item }).catch(() => null))?.reading ?? {};
      if (!name || !number) return [];
      const [low, high] = [number / 2, number * 1.5].sort((one, two) => one - two);
      return [`${name}=${low}${unit}..${high}${unit}:${Math.abs(number) / 4}${unit}`];
    };
    void Promise.all(inputs.map(range)).then((all) => wanted && setRanges(all.flat()));
    return () => void (wanted = false);
  }, [drawn]);
  return ranges;
}
