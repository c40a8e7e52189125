// Folded items by document, kept across reloads.
import { effect, signal } from "@preact/signals";

const KEY = "afp.folded";

export const folded = signal<{ readonly [uri: string]: readonly string[] }>({});

/** Takes up what was folded before, and keeps it from now on. */
export function begin(store: Pick<Storage, "getItem" | "setItem">): void {
  try {
    folded.value = JSON.parse(store.getItem(KEY) ?? "{}");
  } catch {
    // A value of another version can be lost.
  }
  effect(() => store.setItem(KEY, JSON.stringify(folded.value)));
}
