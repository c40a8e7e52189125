// Breakpoints and logpoints. They are lines of text (elements, exits, supervisors, entries), follow
// edits and are stored.
import { effect, signal } from "@preact/signals";
import { current, onText, text, type Told } from "../documents/documents";
import { drawing } from "../drawing/model";
import { itemAt, spanOf } from "../plan/places";
import { offset, position } from "../documents/positions";
import type { Part } from "../drawing/shapes";
import { selected } from "../plan/selection";

const KEY = "afp-studio-breakpoints";

/** A breakpoint or logpoint. */
export interface Stop {
  /** Line, from 0. */
  line: number;
  off?: boolean;
  /** Condition, as a formula. */
  condition?: string;
  /** Logpoint message, with formulas in braces. */
  log?: string;
}

/** Breakpoints by document and line. */
export const breakpoints = signal<Readonly<Record<string, readonly Stop[]>>>({});
/** Breakpoints by part of the drawing. */
export const stops = signal<readonly { part: Part; stop: Stop }[]>([]);
/** Exceptions that stop a run. */
export const filters = signal<readonly string[]>([]);
export const FILTERS = ["fault", "deadlineMissed", "interruption"] as const;

export const stopsOf = (uri: string): readonly Stop[] => breakpoints.value[uri] ?? [];

const put = (uri: string, all: readonly Stop[]): void => {
  breakpoints.value = { ...breakpoints.peek(), [uri]: [...all].sort((a, b) => a.line - b.line) };
};

export function toggle(uri: string, line: number): void {
  const all = stopsOf(uri);
  put(uri, all.some((each) => each.line === line) ? all.filter((each) => each.line !== line) : [...all, { line }]);
}

/** Changes an existing breakpoint. */
export function change(uri: string, line: number, more: Partial<Stop>): void {
  put(uri, stopsOf(uri).map((each) => (each.line === line ? { ...each, ...more } : each)));
}

/** Toggles a breakpoint at the selection. */
export async function toggleSelected(): Promise<void> {
  const [uri, last] = [current.value, selected.value.at(-1)];
  const place = last && (await spanOf(uri, last));
  if (place) toggle(uri, place.start.line);
}

/** Adapts lines to a change of the text; drops deleted lines. */
export function moved(all: readonly Stop[], { range: { start, end }, text }: Told): Stop[] {
  const more = text.split("\n").length - 1 - (end.line - start.line);
  // Lines after the change move, as well as a line before which a whole line is inserted.
  const behind = (line: number): boolean => line > end.line || (line === end.line && end.character === 0 && (start.line < end.line || text.endsWith("\n")));
  const to = (line: number): number | null => (behind(line) ? line + more : line <= start.line ? line : line === end.line ? start.line : null);
  const found = new Map<number, Stop>();
  for (const stop of all) {
    const line = to(stop.line);
    if (line !== null && !found.has(line)) found.set(line, { ...stop, line });
  }
  return [...found.values()];
}

/** The valid part of a stored value; older versions stored only lines. */
function sound(kept: unknown): Record<string, Stop[]> {
  if (typeof kept !== "object" || kept === null) return {};
  const one = (stop: any): Stop[] => {
    if (Number.isInteger(stop)) return [{ line: stop }];
    if (!Number.isInteger(stop?.line)) return [];
    const word = (name: "condition" | "log") => (typeof stop[name] === "string" ? { [name]: stop[name] } : {});
    return [{ line: stop.line, ...(stop.off === true ? { off: true } : {}), ...word("condition"), ...word("log") }];
  };
  return Object.fromEntries(Object.entries(kept).flatMap(([uri, all]) => (Array.isArray(all) ? [[uri, all.flatMap(one)]] : [])));
}

/** Starts to track text changes, to store breakpoints and to find their items. */
export function begin(storage: Storage): void {
  try {
    breakpoints.value = sound(JSON.parse(storage.getItem(KEY) ?? "{}"));
  } catch {
    // An unreadable value is ignored.
  }
  onText((uri, _changes, _maker, told) => {
    const before = stopsOf(uri);
    const after = told.reduce<readonly Stop[]>(moved, before);
    if (lines(after) !== lines(before)) breakpoints.value = { ...breakpoints.peek(), [uri]: after };
  });
  effect(() => storage.setItem(KEY, JSON.stringify(breakpoints.value)));
  effect(() => {
    // A changed drawing may have other names.
    void drawing.value;
    void find(current.value, stopsOf(current.value));
  });
}

const lines = (all: readonly Stop[]): string => all.map(({ line }) => line).join();

async function find(uri: string, all: readonly Stop[]): Promise<void> {
  const now = text(uri);
  const places = all.map(({ line }) => {
    const start = offset(now, { line, character: 0 });
    return position(now, start + (/^\s*/.exec(now.slice(start, offset(now, { line, character: 1e6 })))?.[0].length ?? 0));
  });
  const parts = await Promise.all(places.map((place) => itemAt(uri, place).catch(() => null)));
  if (current.peek() !== uri || stopsOf(uri) !== all) return;
  stops.value = parts.flatMap((part, at) => (part ? [{ part, stop: all[at]! }] : []));
}

/** Breakpoints for the debugger. */
export const asked = (all: readonly Stop[]): object[] =>
  all.filter(({ off }) => !off).map(({ line, condition, log }) => ({ line: line + 1, ...(condition ? { condition } : {}), ...(log ? { logMessage: log } : {}) }));
