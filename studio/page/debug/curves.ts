// Curves of a run: values of entries and sensors over time.
import { signal } from "@preact/signals";
import { sensed } from "../world/sensed";
import { records, state } from "./run";
import type { Plotted } from "./told";

export interface Curve {
  unit: string;
  /** Pairs of seconds and the value from then on, in order. */
  points: readonly (readonly [number, number])[];
}

/** Maximum number of points per curve. */
const MOST = 2000;

/** Number of points up to a moment. */
function until(points: Curve["points"], at: number): number {
  let [low, high] = [0, points.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (points[middle]![0] <= at) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Drops every other point; the last one stays. */
function thinned(all: Curve["points"]): Curve["points"] {
  const apart = (all.at(-1)![0] - all[0]![0]) / (MOST / 2);
  let last = -Infinity;
  return all.filter(([at], nth) => {
    const stays = at - last >= apart || nth === all.length - 1;
    if (stays) last = at;
    return stays;
  });
}

/** The value of a curve at a moment; null before its first point. */
export const valueAt = ({ points }: Curve, at: number): number | null => points[until(points, at) - 1]?.[1] ?? null;

/** Adds a point, possibly between others, since a run can go back. */
export function extended(curve: Curve | undefined, at: number, told: Plotted): Curve | undefined {
  const { points, unit } = curve ?? { points: [], unit: told.unit };
  const place = until(points, at);
  const before = points[place - 1];
  if (before?.[1] === told.number) return curve;
  const point = [at, told.number] as const;
  const all = before?.[0] === at ? points.with(place - 1, point) : points.toSpliced(place, 0, point);
  return { unit, points: all.length > MOST ? thinned(all) : all };
}

/** Cuts the points after a moment. */
export const cut = (curve: Curve, at: number): Curve => ({ ...curve, points: curve.points.slice(0, until(curve.points, at)) });

/** Curves of the displayed run, by entry or signal. */
export const curves = signal<ReadonlyMap<string, Curve>>(new Map());

export function tell(at: number, values: Iterable<readonly [name: string, value: Plotted]>): void {
  const known = curves.peek();
  const changed = [...values].flatMap(([name, value]) => {
    const [before, after] = [known.get(name), extended(known.get(name), at, value)];
    return after && after !== before ? [[name, after] as const] : [];
  });
  if (changed.length) curves.value = new Map([...known, ...changed]);
}

/** Starts to record runs; returns a function that ends it. */
export function begin(): () => void {
  let last = 0;
  const ends = [
    state.subscribe((now) => now && tell(now.at, Object.entries(now.numbers))),
    sensed.subscribe((now) => now && tell(now.at, now.sensed.flatMap(({ signal, plotted }) => (plotted ? [[signal, plotted] as const] : [])))),
    records.subscribe((known) => {
      const at = known.at(-1)?.at;
      // A rewound run has a new future.
      if (at === undefined) curves.value = new Map();
      else if (at < last) curves.value = new Map([...curves.peek()].map(([name, curve]) => [name, cut(curve, at)]));
      last = at ?? 0;
    }),
  ];
  return () => ends.forEach((end) => end());
}
