// Changes of texts as values: from server edits, from the editor, and from comparing two texts.
import type { ChangeSet } from "@codemirror/state";
import type { Change } from "./history";
import { hunks } from "./lines";
import { offset, type Range } from "./positions";

export interface TextEdit {
  range: Range;
  newText: string;
}

/** Text with `\n` line ends, as everywhere in the page. */
export const withNewlines = (text: string): string => (text.includes("\r") ? text.replace(/\r\n?/g, "\n") : text);

/** Converts edits of one text version to sequential changes. */
export function inOrder(uri: string, text: string, edits: TextEdit[]): Change[] {
  const changes = edits.map(({ range, newText }) => ({ uri, from: offset(text, range.start), to: offset(text, range.end), insert: newText }));
  // From the end, so that positions stay valid; at one position the later edit first.
  return changes.map((change, at) => ({ change, at })).sort((a, b) => b.change.from - a.change.from || b.at - a.at).map(({ change }) => change);
}

/** Converts a change set to sequential changes. */
export function sequence(uri: string, changes: ChangeSet): Change[] {
  const made: Change[] = [];
  changes.iterChanges((fromA, toA, fromB, _toB, inserted) => made.push({ uri, from: fromB, to: fromB + toA - fromA, insert: inserted.toString() }), true);
  return made;
}

/** Line-based changes from one text to another, in order. */
export function difference(uri: string, before: string, after: string): Change[] {
  const [old, now] = [lines(before), lines(after)];
  const [starts, ends] = [offsets(old), offsets(now)];
  const part = ({ from, to, start, end }: { from: number; to: number; start: number; end: number }): Change => {
    const insert = after.slice(ends[start], ends[end]);
    return within(uri, before.slice(starts[from], starts[to]), insert, starts[from]!);
  };
  // From the end, so that positions stay valid.
  return hunks(old, now).map(part).reverse();
}

const lines = (text: string): string[] => text.match(/[^\n]*\n|[^\n]+$/g) ?? [];

function offsets(all: readonly string[]): number[] {
  const found = [0];
  for (const line of all) found.push(found.at(-1)! + line.length);
  return found;
}

/**
 * The single change between two texts, without common start and end, and without splitting a
 * character.
 */
function within(uri: string, before: string, after: string, at: number): Change {
  let from = 0;
  while (from < before.length && from < after.length && before[from] === after[from]) from++;
  if (from > 0 && /[\ud800-\udbff]/.test(before[from - 1]!)) from--;
  let [to, end] = [before.length, after.length];
  while (to > from && end > from && before[to - 1] === after[end - 1]) [to, end] = [to - 1, end - 1];
  if (to < before.length && /[\udc00-\udfff]/.test(before[to]!)) [to, end] = [to + 1, end + 1];
  return { uri, from: at + from, to: at + to, insert: after.slice(from, end) };
}
