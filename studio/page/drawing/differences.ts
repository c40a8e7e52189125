// Applies differences to a drawing. Pure, so that tests need no page.
import type { Answer, Changed, Drawing } from "./shapes";

export function whole(uri: string, answer: Answer): Drawing {
  return {
    uri,
    plan: answer.plan,
    plans: answer.plans,
    bounds: answer.bounds ?? [0, 0, 0, 0],
    elements: new Map(answer.elements.map((one) => [one.item, one])),
    edges: new Map(answer.edges.map((one) => [one.id, one])),
    entries: answer.entries ?? [],
    symbols: answer.symbols,
  };
}

/** The new name of a plan after a change, found by its position in the file; null if it is gone. */
export function calledNow(name: string, before: readonly string[], now: readonly string[]): string | null {
  if (now.includes(name)) return name;
  const there = before.length === now.length ? now[before.indexOf(name)] : undefined;
  return there !== undefined && !before.includes(there) ? there : null;
}

/**
 * Items with the new names of their plans; items of a removed plan are kept, since it may return.
 */
export const itemsNow = (items: readonly string[], before: readonly string[], now: readonly string[]): string[] =>
  items.map((item) => {
    const [plan = "", ...rest] = item.split(".");
    return [calledNow(plan, before, now) ?? plan, ...rest].join(".");
  });

/**
 * The drawing after a change: unchanged parts keep their identity, so that views can compare them.
 */
export function changed(before: Drawing, change: Changed): Drawing {
  const elements = new Map(before.elements);
  const edges = new Map(before.edges);
  for (const id of change.gone) {
    elements.delete(id);
    edges.delete(id);
  }
  for (const one of change.elements) elements.set(one.item, one);
  for (const one of change.edges) edges.set(one.id, one);
  return {
    uri: before.uri,
    plan: change.plan,
    plans: change.plans,
    bounds: change.bounds ?? [0, 0, 0, 0],
    elements,
    edges,
    entries: change.entries ?? [],
    symbols: change.symbols,
  };
}
