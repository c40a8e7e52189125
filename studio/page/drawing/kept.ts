// Which plan of the file is shown, and which led to it: a reload of the page keeps that, and Back goes to what was shown before.
import { batch, effect } from "@preact/signals";
import { current } from "../documents/documents";
import { show, trail, wanted, type Place } from "./model";

const KEY = "afp-studio-plan";

/** Shows the plan that was shown before, where the same file is open, and keeps from now on which one is. */
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

/** Makes what is shown an entry of the browser's history, unless it is the last one. */
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
