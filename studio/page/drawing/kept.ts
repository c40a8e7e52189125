// The displayed plan and the path to it: kept across reloads, and in the browser's history for
// Back.
import { batch, effect } from "@preact/signals";
import { current } from "../documents/documents";
import { show, trail, wanted, type Place } from "./model";

const KEY = "afp-studio-plan";

/** Restores the last plan if the same file is open, and starts to store it. */
export function begin(storage: Storage): void {
  const kept = read(storage);
  if (kept?.uri === current.peek() && wanted.peek() === null) batch(() => ([wanted.value, trail.value] = [kept.plan, kept.trail]));
  effect(() => {
    storage.setItem(KEY, JSON.stringify({ uri: current.value, plan: wanted.value, trail: trail.value }));
    // File and plan change one after the other.
    queueMicrotask(remember);
  });
  addEventListener("popstate", ({ state }) => state?.uri && void show(state, state.trail).catch(console.error));
}

/** Adds the view to the browser's history, unless it is the last entry. */
function remember(): void {
  const now = { uri: current.peek(), plan: wanted.peek(), trail: trail.peek() };
  const last = history.state;
  if (!now.uri || (last?.uri === now.uri && last.plan === now.plan)) return;
  if (last?.uri) history.pushState(now, "");
  else history.replaceState(now, "");
}

function read(storage: Storage): { uri: string; plan: string | null; trail: Place[] } | null {
  try {
    const kept = JSON.parse(storage.getItem(KEY) ?? "null");
    return kept && Array.isArray(kept.trail) && kept.trail.every((place: Place) => place.uri) ? kept : null;
  } catch {
    return null;
  }
}
