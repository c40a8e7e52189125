// Changes of a text as values: those of an edit of the server, and the one between two texts.
import type { Change } from "./history";
import { offset, type Range } from "./positions";

export interface TextEdit {
  range: Range;
  newText: string;
}

/** Edits of one text, all for the text as it is, as changes to be made one after the other. */
export function inOrder(uri: string, text: string, edits: TextEdit[]): Change[] {
  const changes = edits.map(({ range, newText }) => ({ uri, from: offset(text, range.start), to: offset(text, range.end), insert: newText }));
  // From the end, so that none moves another; of two at one place the later one first.
  return changes.map((change, at) => ({ change, at })).sort((a, b) => b.change.from - a.change.from || b.at - a.at).map(({ change }) => change);
}

/** The one change between two texts: what both begin and end with is left out. */
export function difference(uri: string, before: string, after: string): Change[] {
  if (before === after) return [];
  let from = 0;
  while (from < before.length && from < after.length && before[from] === after[from]) from++;
  let [to, end] = [before.length, after.length];
  while (to > from && end > from && before[to - 1] === after[end - 1]) [to, end] = [to - 1, end - 1];
  return [{ uri, from, to, insert: after.slice(from, end) }];
}
