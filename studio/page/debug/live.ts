// Values of entries that change while the plan runs.
import { signal } from "@preact/signals";
import * as ask from "../drawing/ask";
import { below, beneath } from "../drawing/actions";
import { moved } from "../drawing/entries";
import { drawing } from "../drawing/model";
import { nameOf, planOf, type Part, type Point } from "../drawing/shapes";
import { active, changes, frames, log, order, state } from "./run";
import { robot } from "./attached";
import { isWritten } from "./written";

/** An entry of the outermost plan in the drawing, with the place of its popup. */
export const opened = signal<{ item: string; at: Point | null } | null>(null);

/** Whether the run has a value for an entry that the page shows. */
export const isLive = (item: string): boolean =>
  changes.value && planOf(item) === frames.value[0]?.plan && drawing.value?.uri === frames.value[0]?.uri && state.value?.entries[nameOf(item)] !== undefined;

/** Opens the control of an entry during a run; false if the run has none. */
export function open(part: Part): boolean {
  if (!isLive(part.item)) return false;
  // Below all entries, so that it covers no value.
  const [entry, all] = [below(part), beneath({ item: `${planOf(part.item)}.start` })];
  opened.value = { item: part.item, at: entry && all && [entry[0], all[1] + 8] };
  return true;
}

/** The latest value to write, by entry; each write ends before the next one starts. */
const waiting = new Map<string, string>();

/** Writes an entry of the run at once. */
export async function write(name: string, text: string): Promise<void> {
  const isBusy = waiting.has(name);
  waiting.set(name, text);
  if (isBusy) return;
  for (let next = text; ; next = waiting.get(name)!) {
    await order("setExpression", { expression: name, value: next });
    if (waiting.get(name) === next) break;
  }
  waiting.delete(name);
}

/** Makes the current value of the run the first value of the entry in the text. */
export const keep = (item: string, value: string): Promise<string[] | null> => ask.edit([{ setEntryValue: { entry: item, value } }], {}, [{ item }]);

/**
 * Moves a number from an input to a new variable. A run then continues with the new text at the
 * same instant.
 */
export async function liven(part: Part, text: string): Promise<boolean> {
  const made = await moved(part, text);
  if (!made) return false;
  if (active.peek() && !log.peek() && !robot.peek() && (await isWritten())) await order("afp/fork", {});
  return true;
}
