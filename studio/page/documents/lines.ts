// Two lists of lines, compared: where they differ, as few lines as can be.
import { diffArrays } from "diff";

/** `from..to` of the one list became `start..end` of the other. */
export interface Hunk {
  from: number;
  to: number;
  start: number;
  end: number;
}

/** Lines that may differ; lists that differ more are one difference. */
const MOST = 400;

/** The differences of two lists, first to last; those that touch are one. */
export function hunks(before: readonly string[], after: readonly string[]): Hunk[] {
  const parts = diffArrays([...before], [...after], { maxEditLength: MOST });
  if (!parts) return [{ from: 0, to: before.length, start: 0, end: after.length }];
  const found: Hunk[] = [];
  let [from, start] = [0, 0];
  for (const { added, removed, count } of parts) {
    const [to, end] = [from + (added ? 0 : count), start + (removed ? 0 : count)];
    if (added || removed) {
      const last = found.at(-1);
      if (last?.to === from && last.end === start) [last.to, last.end] = [to, end];
      else found.push({ from, to, start, end });
    }
    [from, start] = [to, end];
  }
  return found;
}
