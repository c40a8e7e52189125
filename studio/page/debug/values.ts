// Values of entries during a run, as chips over their declarations.
import { svg } from "../drawing/fragment";
import { inside, nameOf, rectOf, type Drawing, type Entry, type Point, type Rect } from "../drawing/shapes";
import { frameOf, type Frame } from "./follow";
import type { State } from "./told";

/** Minimum and maximum number of characters in a chip. */
const SHORTEST = 6;
const LONGEST = 22;
/** Distance from the chips to the start of the plan, or to the right border. */
const MARGIN = 34;
/**
 * Width of a character, height of a chip, its padding, and width of a lock, in units of the plan.
 */
const CHARACTER = 7.6;
const HEIGHT = 18;
const PAD = 6;
const LOCK = 14;
/** Distance from the widest name to the chips. */
const GAP = 6;

export interface Held {
  text: string;
  /** Remaining seconds of a forced value; null for a value of the plan. */
  left: number | null;
}

/** The value of an entry in the displayed plan; null if the run has none. */
export function holding(frames: readonly Frame[], plan: string | null, now: Pick<State, "at" | "entries" | "forced">, item: string): Held | null {
  const frame = frameOf(frames, plan);
  if (!frame) return null;
  const path = frame.path ? `${frame.path}.${nameOf(item)}` : nameOf(item);
  const text = now.entries[path];
  const forced = now.forced.find((each) => each.path === path && each.value !== undefined);
  if (text === undefined) return null;
  // In a stopped run, a forced value is written by the next step.
  return forced ? { text: forced.value ?? text, left: Math.max(0, Math.ceil(forced.until - now.at)) } : { text, left: null };
}

const short = (value: string, longest: number): string => (value.length > longest ? `${value.slice(0, longest - 1)}…` : value);

/** The places of the chips, by entry. */
const places = new Map<string, Rect>();

/** The entry whose chip is at a point of the plan. */
export const chipAt = (at: Point): string | null => [...places].find(([, rect]) => inside(rect, at, 2))?.[0] ?? null;

/** Chips of entries with values; `fresh` were just written. */
export function chips(drawn: Drawing, values: ReadonlyMap<string, Held>, fresh: ReadonlySet<string>): SVGElement[] {
  places.clear();
  const rights = drawn.entries.map(({ item }) => rectOf(drawn, { item })).map((rect) => (rect ? rect[0] + rect[2] : 0));
  const left = Math.max(...rights) + GAP;
  const start = drawn.elements.get(`${drawn.plan}.start`);
  const end = start ? (start.rect[0] > left ? start.rect[0] : start.outer[0] + start.outer[2]) - MARGIN : Infinity;
  return drawn.entries.flatMap((entry) => chip(drawn, entry, [left, end], values.get(entry.item), fresh.has(entry.item)));
}

function chip(drawn: Drawing, { item }: Entry, [x, end]: Point, value: Held | undefined, fresh: boolean): SVGElement[] {
  const rect = rectOf(drawn, { item });
  if (!rect || value === undefined) return [];
  const forced = value.left !== null;
  const sign = forced ? LOCK : 0;
  const left = forced ? `, ${value.left} s` : "";
  const room = Math.floor((end - x - 2 * PAD - sign) / CHARACTER) - left.length;
  const text = short(value.text, Math.max(SHORTEST, Math.min(LONGEST, room))) + left;
  const middle = rect[1] + rect[3] / 2;
  const width = text.length * CHARACTER + 2 * PAD + sign;
  places.set(item, [x, middle - HEIGHT / 2, width, HEIGHT]);
  const body = svg("rect", { class: `run-value${fresh ? " fresh" : ""}${forced ? " forced" : ""}`, x, y: middle - HEIGHT / 2, width, height: HEIGHT, rx: 4 });
  const words = svg("text", { class: "run-value-text", x: x + PAD + sign, y: middle + 4.3, "data-item": item });
  words.textContent = text;
  return [body, ...(forced ? [lock(x + PAD, middle)] : []), words];
}

const lock = (x: number, y: number): SVGElement => svg("path", { class: "run-lock", d: `M${x} ${y - 1}h9v6h-9zm2 0v-2a2.5 2.5 0 0 1 5 0v2` });
