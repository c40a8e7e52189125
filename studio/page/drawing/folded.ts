// Folded items by document, kept across reloads.
import { effect, signal } from "@preact/signals";

const KEY = "afp.folded";

export const folded = signal<{ readonly [uri: string]: readonly string[] }>({});

/** Restores folded items and starts to store them. */
export function begin(store: Pick<Storage, "getItem" | "setItem">): void {
  try {
    folded.value = JSON.parse(store.getItem(KEY) ?? "{}");
  } catch {
    // A value of another version can be dropped.
  }
  effect(() => store.setItem(KEY, JSON.stringify(folded.value)));
}
