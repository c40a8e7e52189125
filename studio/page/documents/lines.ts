// Line-based comparison with few changed lines.
import { diffArrays } from "diff";

/** `from..to` of the old list became `start..end` of the new one. */
export interface Hunk {
  from: number;
  to: number;
  start: number;
  end: number;
}

/** Maximum number of differing lines; beyond, the lists are one difference. */
const MOST = 400;

/** The differences in order; adjacent ones are merged. */
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
