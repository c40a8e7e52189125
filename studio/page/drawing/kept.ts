// Which plan of the file is shown, and which led to it: a reload of the page keeps that.
import { batch, effect } from "@preact/signals";
import { current } from "../documents/documents";
import { trail, wanted } from "./model";

const KEY = "afp-studio-plan";

/** Shows the plan that was shown before, where the same file is open, and keeps from now on which one is. */
export function begin(storage: Storage): void {
  const kept = read(storage);
  if (kept?.uri === current.peek() && wanted.peek() === null) batch(() => ([wanted.value, trail.value] = [kept.plan, kept.trail]));
  effect(() => storage.setItem(KEY, JSON.stringify({ uri: current.value, plan: wanted.value, trail: trail.value })));
}

function read(storage: Storage): { uri: string; plan: string | null; trail: string[] } | null {
  try {
    const kept = JSON.parse(storage.getItem(KEY) ?? "null");
    return kept && Array.isArray(kept.trail) ? kept : null;
  } catch {
    return null;
  }
}
