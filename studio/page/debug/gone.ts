// A run ends when its page is closed; the reloaded page reports it.
import { effect } from "@preact/signals";
import { trouble } from "../panes/files";
import { words } from "../words";
import { robot } from "./attached";
import { active, log } from "./run";

const KEY = "afp-studio-run";

/**
 * Reports a run that ended with the previous page, and tracks the current run. Logs are excluded,
 * since they can be reopened, and robots, which drive on.
 */
export function begin(storage: Storage): void {
  if (storage.getItem(KEY)) trouble.value = words.runGone;
  effect(() => {
    if (active.value && !log.value && !robot.value) storage.setItem(KEY, "runs");
    else storage.removeItem(KEY);
  });
}
