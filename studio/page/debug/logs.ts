// Logs of past runs: opened like runs, with their plan if the folder has it.
import { effect } from "@preact/signals";
import { pathOf } from "../documents/addresses";
import { drawing, trail, wanted } from "../drawing/model";
import { show } from "../panes/files";
import { show as showPane } from "../screen/layout";
import { files } from "../server/session";
import { launched, openLog, phase, seek } from "./run";

/** Opens a log at a moment. */
export async function openLogAt(uri: string, at: number): Promise<void> {
  await showLog(uri);
  await begun();
  seek(at);
}

/** Waits until a run stops, continues or fails. */
const begun = (): Promise<void> =>
  new Promise((done) => {
    const ends = effect(() => {
      if (phase.value === "starting") return;
      queueMicrotask(() => ends());
      done();
    });
  });

/** Opens a log and its plan. */
export async function showLog(uri: string): Promise<void> {
  await openLog(pathOf(uri));
  if (launched.peek()) await shown();
}

/** Shows the plan of the last log or robot; false if the folder does not have it. */
export async function shown(): Promise<boolean> {
  const begun = launched.peek()!;
  showPane("timeline");
  const isHere = files.peek().some(({ uri }) => uri === begun.uri);
  if (!isHere) return false;
  await show(begun.uri);
  if (drawing.peek()?.plan !== begun.plan) [trail.value, wanted.value] = [[], begun.plan];
  return true;
}
