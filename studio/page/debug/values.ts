// What each entry holds in a run, on the drawing: a chip in the place of what the plan declares.
import { svg } from "../drawing/fragment";
import { nameOf, rectOf, type Drawing, type Entry } from "../drawing/shapes";
import { frameOf, type Frame } from "./follow";

/** Characters of a value that a chip shows. */
const LONGEST = 22;
/** The width of a character, the height of a chip, and what stands around its text, in units of the plan. */
const CHARACTER = 7.6;
const HEIGHT = 18;
const PAD = 6;
/** From the widest name to the chips. */
const GAP = 6;

/** What an entry of the plan that is shown holds; null where a run says nothing of it. */
export function held(frames: readonly Frame[], plan: string | null, entries: Readonly<Record<string, string>>, item: string): string | null {
  const frame = frameOf(frames, plan);
  if (!frame) return null;
  return entries[frame.path ? `${frame.path}.${nameOf(item)}` : nameOf(item)] ?? null;
}

const short = (value: string): string => (value.length > LONGEST ? `${value.slice(0, LONGEST - 1)}…` : value);

/** Chips for entries with a value; those of `fresh` have just been written. */
export function chips(drawn: Drawing, values: ReadonlyMap<string, string>, fresh: ReadonlySet<string>): SVGElement[] {
  const rights = drawn.entries.map(({ item }) => rectOf(drawn, { item })).map((rect) => (rect ? rect[0] + rect[2] : 0));
  const left = Math.max(...rights) + GAP;
  return drawn.entries.flatMap((entry) => chip(drawn, entry, left, values.get(entry.item), fresh.has(entry.item)));
}

function chip(drawn: Drawing, { item }: Entry, left: number, value: string | undefined, fresh: boolean): SVGElement[] {
  const rect = rectOf(drawn, { item });
  if (!rect || value === undefined) return [];
  const text = short(value);
  const middle = rect[1] + rect[3] / 2;
  const body = svg("rect", { class: `run-value${fresh ? " fresh" : ""}`, x: left, y: middle - HEIGHT / 2, width: text.length * CHARACTER + 2 * PAD, height: HEIGHT, rx: 4 });
  const words = svg("text", { class: "run-value-text", x: left + PAD, y: middle + 4.3, "data-item": item });
  words.textContent = text;
  return [body, words];
}
