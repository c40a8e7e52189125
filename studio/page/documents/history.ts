// The common history: typing, drawing, positions, fixes and external changes are entries of one
// list. The functions above `push` are pure: `(log, ...) -> log`.
import { computed, signal } from "@preact/signals";
import type { Part } from "../drawing/shapes";

/** Replaces `from..to` of a text by `insert`. Changes of a list are applied in order. */
export interface Change {
  uri: string;
  from: number;
  to: number;
  insert: string;
}

/** An applied change, with the removed text. */
export interface Step {
  uri: string;
  from: number;
  removed: string;
  inserted: string;
}

export interface Entry {
  label: string;
  steps: Step[];
  select?: Part[];
  /** By another program or user: undo asks first. */
  foreign?: boolean;
  /** Time in milliseconds; typing soon afterwards at the same place is merged. */
  typed?: number;
}

export interface Log {
  past: readonly Entry[];
  future: readonly Entry[];
}

export const EMPTY: Log = { past: [], future: [] };

/** Maximum number of entries; the oldest are dropped. */
const MOST = 2000;
/** Pause in typing that begins a new entry, milliseconds. */
const PAUSE = 700;

export const forward = (steps: Step[]): Change[] =>
  steps.map(({ uri, from, removed, inserted }) => ({ uri, from, to: from + removed.length, insert: inserted }));

export const backward = (steps: Step[]): Change[] =>
  steps.map(({ uri, from, removed, inserted }) => ({ uri, from, to: from + inserted.length, insert: removed })).reverse();

/** Appends an entry, or merges it if both are typing at one place. */
export function recorded(log: Log, entry: Entry): Log {
  const last = log.past.at(-1);
  if (last && log.future.length === 0 && joins(last, entry)) {
    const joined = { ...last, steps: [...last.steps, ...entry.steps], typed: entry.typed! };
    return { past: [...log.past.slice(0, -1), joined], future: [] };
  }
  return { past: [...log.past, entry].slice(-MOST), future: [] };
}

function joins(last: Entry, next: Entry): boolean {
  const [before, after] = [last.steps.at(-1), next.steps[0]];
  if (last.typed === undefined || next.typed === undefined || next.typed - last.typed > PAUSE) return false;
  if (!before || !after || next.steps.length !== 1 || before.uri !== after.uri) return false;
  // A new line begins a new entry.
  if (after.inserted.includes("\n") || before.inserted.endsWith("\n")) return false;
  const end = before.from + before.inserted.length;
  return after.from === end || after.from + after.removed.length === end;
}

/** Removes and returns the last entry; null if empty. */
export function stepBack(log: Log): [Log, Entry] | null {
  const entry = log.past.at(-1);
  return entry ? [{ past: log.past.slice(0, -1), future: [...log.future, entry] }, entry] : null;
}

export function stepForth(log: Log): [Log, Entry] | null {
  const entry = log.future.at(-1);
  return entry ? [{ past: [...log.past, entry], future: log.future.slice(0, -1) }, entry] : null;
}

/** The undo and redo lists, filled here and by `keep.ts` after a reload. */
export const log = signal<Log>(EMPTY);
export const undoLabel = computed(() => log.value.past.at(-1)?.label ?? null);
export const redoLabel = computed(() => log.value.future.at(-1)?.label ?? null);

interface Hands {
  /** Applies changes and returns the steps. */
  make(changes: Change[]): Step[];
  select(parts: Part[]): void;
  /** Asks whether to undo a foreign change. */
  agree(label: string): Promise<boolean>;
}
let hands: Hands | null = null;

/**
 * Sets the functions that apply changes and select: those of `documents.ts`, or a test's. The
 * history begins empty.
 */
export function attach(own: Hands): void {
  hands = own;
  log.value = EMPTY;
}

/** Applies changes and records them as one entry. */
export function push(entry: { label: string; changes: Change[]; select?: Part[]; foreign?: boolean; typed?: number }): void {
  const { changes, ...rest } = entry;
  const steps = hands?.make(changes) ?? [];
  if (steps.length) log.value = recorded(log.value, { ...rest, steps });
  if (rest.select) hands?.select(rest.select);
}

/** Records changes that are already applied: the editor applies typing first. */
export function record(entry: Entry): void {
  if (entry.steps.length) log.value = recorded(log.value, entry);
}

/** Changes in progress. */
const under = new Set<Promise<unknown>>();

/** Tracks a pending change until it is applied or rejected; an undo waits for it. */
export function underWay<T>(change: Promise<T>): Promise<T> {
  const end = (): void => void under.delete(change);
  under.add(change);
  change.then(end, end);
  return change;
}

async function move(step: typeof stepBack, changes: typeof backward): Promise<void> {
  if (under.size) await Promise.allSettled(under);
  const next = step(log.value);
  if (!next || !hands) return;
  const before = log.value;
  if (next[1].foreign && !(await hands.agree(next[1].label))) return;
  // The history may have changed during the question.
  if (log.value !== before) return;
  // A change that fails stays in the list.
  hands.make(changes(next[1].steps));
  log.value = next[0];
  if (next[1].select) hands.select(next[1].select);
}

export const undo = (): Promise<void> => move(stepBack, backward);
export const redo = (): Promise<void> => move(stepForth, forward);

/** Clears the history, for a new holder of the edit lock. */
export function clear(): void {
  log.value = EMPTY;
}
