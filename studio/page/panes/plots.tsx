// Curves above the timeline's rows: values of entries and sensors, in the same time window.
import { signal } from "@preact/signals";
import { Tool } from "../screen/bar";
import { curves, valueAt, type Curve } from "../debug/curves";
import type { Window } from "../debug/trace";
import { words } from "../words";

/** Plotted names, in the order of selection. */
const chosen = signal<readonly string[]>([]);
/** Height of a plot and its margin, pixels. */
const TALL = 66;
const MARGIN = 8;

/** Adds a plot. */
export function Choose() {
  const others = [...curves.value.keys()].filter((name) => !chosen.value.includes(name)).sort();
  const add = (event: Event & { currentTarget: HTMLSelectElement }): void => {
    if (event.currentTarget.value) chosen.value = [...chosen.value, event.currentTarget.value];
    event.currentTarget.value = "";
  };
  return (
    <select class="plot" aria-label={words.plot} title={words.plotHint} value="" disabled={!others.length} onChange={add}>
      <option value="">{words.plot}</option>
      {others.map((name) => <option value={name} key={name}>{name}</option>)}
    </select>
  );
}

interface Seen {
  of: Window;
  x: (at: number) => number;
  now: number;
  width: number;
}

export function Plots(seen: Seen) {
  const shown = chosen.value.flatMap((name) => (curves.value.has(name) ? [[name, curves.value.get(name)!] as const] : []));
  return <>{shown.map(([name, curve]) => <Plot name={name} curve={curve} {...seen} key={name} />)}</>;
}

function Plot({ name, curve, of, x, now, width }: Seen & { name: string; curve: Curve }) {
  const value = valueAt(curve, now);
  const { line, least, most } = drawn(curve, of, x, now);
  return (
    <>
      <div class="plot-name">
        <span title={name}>{name}</span>
        <Tool icon="close" label={words.plotNot(name)} run={() => (chosen.value = chosen.value.filter((other) => other !== name))} />
        <strong>{value === null ? "" : words.number(value, curve.unit)}</strong>
      </div>
      <svg class="plot-lane" width={width} height={TALL} role="img" aria-label={words.plotOf(name, words.number(least, curve.unit), words.number(most, curve.unit))}>
        <line class="edge" x2={width} y1={TALL - 0.5} y2={TALL - 0.5} />
        <path class="curve" d={line} />
        <line class="now" x1={x(now)} x2={x(now)} y2={TALL} />
        <text x="4" y={MARGIN + 4}>{most}</text>
        {most > least && <text x="4" y={TALL - MARGIN + 2}>{least}</text>}
      </svg>
    </>
  );
}

/** A curve in a window: each value lasts until the next one, the last one until now. */
export function drawn({ points }: Curve, of: Window, x: (at: number) => number, now: number): { line: string; least: number; most: number } {
  const first = Math.max(0, points.findLastIndex(([at]) => at <= of.from));
  const inside = points.slice(first).filter(([at]) => at <= of.to);
  const values = inside.map(([, value]) => value);
  const [least, most] = values.length ? [Math.min(...values), Math.max(...values)] : [0, 0];
  const y = (value: number): number => (most > least ? MARGIN + ((most - value) / (most - least)) * (TALL - 2 * MARGIN) : TALL / 2);
  const steps = inside.map(([at, value], nth) => `${nth ? "H" : "M"}${pixel(x(Math.max(at, of.from)))}${nth ? "V" : " "}${pixel(y(value))}`);
  const last = inside.at(-1)?.[0] ?? 0;
  return { line: steps.join("") + (inside.length ? `H${pixel(x(Math.max(last, Math.min(now, of.to))))}` : ""), least: short(least), most: short(most) };
}

const pixel = (at: number): number => Math.round(at * 10) / 10;
const short = (value: number): number => Number(value.toPrecision(4));
