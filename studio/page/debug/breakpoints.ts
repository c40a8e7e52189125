// Where a run stops: lines of the text, which are elements of the drawing; they move with the text and are remembered.
import { effect, signal } from "@preact/signals";
import { current, onText, text, type Told } from "../documents";
import { drawing } from "../drawing/model";
import { itemAt, spanOf } from "../places";
import { offset, position } from "../positions";
import { selected } from "../selection";

const KEY = "afp-studio-breakpoints";

/** Lines, from 0, by document. */
export const breakpoints = signal<Readonly<Record<string, readonly number[]>>>({});
/** The items of the drawing that they stand at. */
export const stops = signal<ReadonlySet<string>>(new Set());

export const linesOf = (uri: string): readonly number[] => breakpoints.value[uri] ?? [];

export function toggle(uri: string, line: number): void {
  const lines = linesOf(uri);
  const now = lines.includes(line) ? lines.filter((each) => each !== line) : [...lines, line].sort((a, b) => a - b);
  breakpoints.value = { ...breakpoints.peek(), [uri]: now };
}

/** Sets or takes away a breakpoint at what is selected. */
export async function toggleSelected(): Promise<void> {
  const [uri, last] = [current.value, selected.value.at(-1)];
  const place = last && (await spanOf(uri, { item: last.item }));
  if (place) toggle(uri, place.start.line);
}

/** Where lines are after a change of a text; those whose line is gone are gone. */
export function moved(lines: readonly number[], { range: { start, end }, text }: Told): number[] {
  const more = text.split("\n").length - 1 - (end.line - start.line);
  // What begins behind the change moves with it; so does a line that a whole one is put before.
  const behind = (line: number): boolean => line > end.line || (line === end.line && end.character === 0 && (start.line < end.line || text.endsWith("\n")));
  const found = lines.flatMap((line) => (behind(line) ? [line + more] : line <= start.line ? [line] : line === end.line ? [start.line] : []));
  return [...new Set(found)];
}

/** Begins to move them with the texts, to remember them, and to find their items. */
export function begin(storage: Storage): void {
  try {
    const kept = JSON.parse(storage.getItem(KEY) ?? "{}");
    const sound = (lines: unknown): lines is number[] => Array.isArray(lines) && lines.every((line) => Number.isInteger(line));
    breakpoints.value = Object.fromEntries(Object.entries(kept).filter(([, lines]) => sound(lines))) as Record<string, number[]>;
  } catch {
    // What cannot be read is forgotten.
  }
  onText((uri, _changes, _maker, told) => {
    const before = linesOf(uri);
    const lines = told.reduce(moved, before);
    if (lines.join() !== before.join()) breakpoints.value = { ...breakpoints.peek(), [uri]: lines };
  });
  effect(() => storage.setItem(KEY, JSON.stringify(breakpoints.value)));
  effect(() => {
    // A drawing that has changed may have other names.
    void drawing.value;
    void find(current.value, linesOf(current.value));
  });
}

async function find(uri: string, lines: readonly number[]): Promise<void> {
  const now = text(uri);
  const places = lines.map((line) => {
    const start = offset(now, { line, character: 0 });
    return position(now, start + (/^\s*/.exec(now.slice(start, offset(now, { line, character: 1e6 })))?.[0].length ?? 0));
  });
  const items = await Promise.all(places.map((place) => itemAt(uri, place).catch(() => null)));
  if (current.peek() === uri && linesOf(uri).join() === lines.join()) stops.value = new Set(items.flatMap((each) => (each ? [each.item] : [])));
}
