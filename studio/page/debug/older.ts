// Whether the run is of another text than the one that is shown.
import { computed, type ReadonlySignal } from "@preact/signals";
import { isOpen, text } from "../documents";
import { files } from "../session";
import { differs } from "../hash";
import type { State } from "./told";

/** The path of a document, as the debugger says it. */
export const pathOf = (uri: string): string => decodeURIComponent(new URL(uri).pathname);

/** Whether a document that is open has another text than the one that runs. */
export function olderThan(state: ReadonlySignal<State | null>): ReadonlySignal<boolean> {
  // What is the case changes some twenty times a second, what runs does not.
  const sources = computed(() => JSON.stringify(state.value?.sources ?? {}));
  return computed(() => {
    const running = JSON.parse(sources.value) as State["sources"];
    return files.value.some(({ uri }) => isOpen(uri) && differs(running, pathOf(uri), text(uri)));
  });
}
