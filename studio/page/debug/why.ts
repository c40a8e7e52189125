// Why an element runs, or does not: asked of the run about what is selected.
import { effect, signal } from "@preact/signals";
import { plan } from "../drawing/model";
import { selected } from "../plan/selection";
import { frameOf } from "./follow";
import { active, ask, frames, phase, state } from "./run";

export interface Edge {
  from: string;
  outcome: string;
  /** When it was taken last, seconds; null for never. */
  last: number | null;
  /** Whether its component looks now. */
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

/** The path in question; empty for none. */
export const asked = signal("");
export const why = signal<Why | null>(null);

/** The path in the run of an item of the plan that is shown; null where that plan is not active. */
export function pathInRun(item: string): string | null {
  const frame = frameOf(frames.peek(), plan.peek());
  if (!frame) return null;
  const own = item.split(".").slice(1).join(".");
  return own && frame.path ? `${frame.path}.${own}` : own || null;
}

/** Asks why what is selected runs, or does not. */
export function askWhy(): void {
  const last = selected.peek().at(-1);
  const path = last && active.peek() ? pathInRun(last.item) : null;
  if (path) asked.value = path;
}

export const close = (): void => {
  asked.value = "";
};

/** Milliseconds between two questions while the run goes on. */
const PAUSE = 500;

/** Begins to ask again as the run goes on. */
export function begin(): void {
  let last = -Infinity;
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
  active.subscribe((runs) => {
    if (!runs) close();
  });
}

