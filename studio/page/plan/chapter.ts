// The second chapter of the guide: change a value, break the plan, repair it, test it. A step is done
// once, whatever follows.
import { computed, effect, signal } from "@preact/signals";
import { text } from "../documents/documents";
import { results } from "../jobs/results";
import { files } from "../server/session";
import { number } from "./problems";

/** The steps in order, with the facts that end them. */
export const LATER = ["change", "rerun", "break", "mend", "scenario", "test"] as const;
export type Later = (typeof LATER)[number];

/** The state of the plan and the folder. */
export interface Now {
  /** Whether the text differs from that at the begin of the chapter. */
  isChanged: boolean;
  errors: number;
  /** Number of ended runs in this chapter. */
  runs: number;
  /** Number of new files in this chapter. */
  files: number;
  /** Whether scenarios have results. */
  isTested: boolean;
}

/** Whether the current step is done. */
export function isDone(step: Later, { isChanged, errors, runs, files, isTested }: Now): boolean {
  switch (step) {
    case "change":
      return isChanged && errors === 0;
    case "rerun":
      return runs > 0;
    case "break":
      return errors > 0;
    case "mend":
      return errors === 0;
    case "scenario":
      return files > 0;
    case "test":
      return isTested;
  }
}

const KEY = "afp-studio-chapter";

interface Begun {
  uri: string;
  /** The text at its begin. */
  text: string;
  files: number;
  /** Number of steps done. */
  done: number;
}

const begun = signal<Begun | null>(null);
const runs = signal(0);

/** The step of the second chapter for a plan; null outside of it. */
export const later = computed<Later | "end" | null>(() => (begun.value ? (LATER[begun.value.done] ?? "end") : null));
/** The plan of the chapter; empty outside of it. */
export const home = computed(() => begun.value?.uri ?? "");

const count = (): number => files.value.length;

function keep(now: Begun | null): void {
  begun.value = now;
  if (now) sessionStorage.setItem(KEY, JSON.stringify(now));
  else sessionStorage.removeItem(KEY);
}

/** Begins the chapter with a plan. */
export function open(uri: string): void {
  runs.value = 0;
  keep({ uri, text: text(uri), files: count(), done: 0 });
}

export const close = (): void => keep(null);

export const ran = (): void => void (runs.value += 1);

/** Restores the chapter after a reload, and goes on when a step is done. */
export function begin(): void {
  const kept = sessionStorage.getItem(KEY);
  if (kept) begun.value = JSON.parse(kept) as Begun;
  effect(() => {
    const now = begun.value;
    const step = later.value;
    if (!now || !step || step === "end") return;
    const state = { isChanged: text(now.uri) !== now.text, errors: number("error"), runs: runs.value, files: count() - now.files, isTested: results.value !== null };
    if (isDone(step, state)) queueMicrotask(() => begun.peek() === now && keep({ ...now, done: now.done + 1 }));
  });
}
