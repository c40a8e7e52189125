// Whether the running text differs from the displayed text.
import { computed, type ReadonlySignal } from "@preact/signals";
import { pathOf } from "../documents/addresses";
import { isOpen, text } from "../documents/documents";
import { files } from "../server/session";
import { differs } from "../documents/hash";
import type { State } from "./told";

/** Whether an open document differs from the running text. */
export function olderThan(state: ReadonlySignal<State | null>): ReadonlySignal<boolean> {
  // The state changes about twenty times a second, the sources do not.
  const sources = computed(() => JSON.stringify(state.value?.sources ?? {}));
  return computed(() => {
    const running = JSON.parse(sources.value) as State["sources"];
    return files.value.some(({ uri }) => isOpen(uri) && differs(running, pathOf(uri), text(uri)));
  });
}
