// Whether the run is of another text than the one that is shown.
import { computed, type ReadonlySignal } from "@preact/signals";
import { pathOf } from "../documents/addresses";
import { isOpen, text } from "../documents/documents";
import { files } from "../server/session";
import { differs } from "../documents/hash";
import type { State } from "./told";

/** Whether a document that is open has another text than the one that runs. */
export function olderThan(state: ReadonlySignal<State | null>): ReadonlySignal<boolean> {
  // The state changes some twenty times a second, the run does not.
  const sources = computed(() => JSON.stringify(state.value?.sources ?? {}));
  return computed(() => {
    const running = JSON.parse(sources.value) as State["sources"];
    return files.value.some(({ uri }) => isOpen(uri) && differs(running, pathOf(uri), text(uri)));
  });
}
