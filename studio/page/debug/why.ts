// Explains why the selected element runs or not; the run answers.
import { effect, signal } from "@preact/signals";
import { plan } from "../drawing/model";
import { selected } from "../plan/selection";
import { frameOf } from "./follow";
import { ask, frames, phase, state } from "./run";

export interface Edge {
  from: string;
  outcome: string;
  /** Time when it was last taken, seconds; null for never. */
  last: number | null;
  /** Whether its component is active. */
  looks: boolean;
  values: Record<string, string>;
}

export interface Why {
  path: string;
  active: boolean;
  values: Record<string, string>;
  edges: Edge[];
  since?: number;
  because?: string;
}

/** The queried path; empty for none. */
export const asked = signal("");
export const why = signal<Why | null>(null);

/** An item's path in the run; null if its plan is not active. */
export function pathInRun(item: string): string | null {
  const frame = frameOf(frames.peek(), plan.peek());
  if (!frame) return null;
  const own = item.split(".").slice(1).join(".");
  return own && frame.path ? `${frame.path}.${own}` : own || null;
}

export function askWhy(): void {
  const last = selected.peek().at(-1);
  const path = last && phase.peek() !== "idle" ? pathInRun(last.item) : null;
  if (path) asked.value = path;
}

/** Explains an element of the run, by its path. */
export const explain = (path: string): void => void (asked.value = path);

/** While the card is open, it follows the selection. */
const followed = (): void => {
  const last = selected.value.at(-1);
  const path = last && asked.peek() ? pathInRun(last.item) : null;
  if (path) asked.value = path;
};

export const close = (): void => {
  asked.value = "";
};

/** Milliseconds between queries of a running plan. */
const PAUSE = 500;

export function begin(): void {
  let last = -Infinity;
  effect(followed);
  effect(() => {
    const [path, now, still] = [asked.value, state.value, phase.value === "held"];
    if (!path || !now) {
      why.value = null;
      return;
    }
    if (why.peek()?.path === path && !still && performance.now() - last < PAUSE) return;
    last = performance.now();
    void ask<Why>("afp/why", { path }).then((found) => {
      if (asked.peek() !== path) return;
      if (found) why.value = found;
      else close();
    });
  });
  // The debugger still answers after the end of a run.
  phase.subscribe((now) => {
    if (now === "idle" || now === "starting") close();
  });
}

