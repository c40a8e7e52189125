// Numbers of a run over its time, to plot: values of entries and sensors.
import { signal } from "@preact/signals";
import { quantity } from "../drawing/value";
import { sensed } from "../world/sensed";
import { records, state } from "./run";

export interface Curve {
  unit: string;
  /** Seconds of the run and what it was from there on; in order. */
  points: readonly (readonly [number, number])[];
}

/** Points of a curve that are kept. */
const MOST = 2000;

/** Units of small quantities, in those of larger ones. */
const PARTS: Record<string, [unit: string, factor: number]> = { cm: ["m", 0.01], "cm/s": ["m/s", 0.01], ms: ["s", 0.001] };

/** A text as a number to plot; null where it is none. */
export function plotted(text: string): { number: number; unit: string } | null {
  if (text === "true" || text === "false") return { number: Number(text === "true"), unit: "" };
  const found = quantity(text);
  const [unit, factor] = PARTS[found?.unit ?? ""] ?? [found?.unit ?? "", 1];
  return found && { number: found.number * factor, unit };
}

/** How many points of a curve are not later than a moment. */
function until(points: Curve["points"], at: number): number {
  let [low, high] = [0, points.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (points[middle]![0] <= at) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Half as many as are kept, as far apart everywhere; the last one stays. */
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

/** The curve with a new point, possibly between others, since a run can go back. */
export function extended(curve: Curve | undefined, at: number, text: string): Curve | undefined {
  const told = plotted(text);
  if (!told || (curve && curve.unit !== told.unit && told.number !== 0)) return curve;
  const { points, unit } = curve ?? { points: [], unit: told.unit };
  const place = until(points, at);
  const before = points[place - 1];
  if (before?.[1] === told.number) return curve;
  const point = [at, told.number] as const;
  const all = before?.[0] === at ? points.with(place - 1, point) : points.toSpliced(place, 0, point);
  return { unit, points: all.length > MOST ? thinned(all) : all };
}

/** The curve without what came after a moment. */
export const cut = (curve: Curve, at: number): Curve => ({ ...curve, points: curve.points.slice(0, until(curve.points, at)) });

/** Curves of the run that is shown, by entry or signal. */
export const curves = signal<ReadonlyMap<string, Curve>>(new Map());

/** Adds the values of a moment. */
export function tell(at: number, values: Iterable<readonly [name: string, text: string]>): void {
  const known = curves.peek();
  const changed = [...values].flatMap(([name, text]) => {
    const [before, after] = [known.get(name), extended(known.get(name), at, text)];
    return after && after !== before ? [[name, after] as const] : [];
  });
  if (changed.length) curves.value = new Map([...known, ...changed]);
}

/** Begins to keep what runs tell; the answer ends that. */
export function begin(): () => void {
  let last = 0;
  const ends = [
    state.subscribe((now) => now && tell(now.at, Object.entries(now.entries))),
    sensed.subscribe((now) => now && tell(now.at, now.sensed.map(({ signal, text }) => [signal, text] as const))),
    records.subscribe((known) => {
      const at = known.at(-1)?.at;
      // A run that goes on otherwise from a moment has another future there.
      if (at === undefined) curves.value = new Map();
      else if (at < last) curves.value = new Map([...curves.peek()].map(([name, curve]) => [name, cut(curve, at)]));
      last = at ?? 0;
    }),
  ];
  return () => ends.forEach((end) => end());
}
