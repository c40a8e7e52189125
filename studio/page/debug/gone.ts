// A run ends with its page; a reloaded page reports that.
import { effect } from "@preact/signals";
import { trouble } from "../panes/files";
import { words } from "../words";
import { active, log } from "./run";

const KEY = "afp-studio-run";

/** Says that a run has ended with the page before, and remembers from now on whether there is one; a log can be opened again. */
export function begin(storage: Storage): void {
  if (storage.getItem(KEY)) trouble.value = words.runGone;
  effect(() => {
    if (active.value && !log.value) storage.setItem(KEY, "runs");
    else storage.removeItem(KEY);
  });
}
