// Two lists of lines, compared: where they differ, as few lines as can be (Myers 1986, "An O(ND) difference algorithm").

/** `from..to` of the one list became `start..end` of the other. */
export interface Hunk {
  from: number;
  to: number;
  start: number;
  end: number;
}

/** Lines that may differ; lists that differ more are one difference. */
const MOST = 400;

/** The differences of two lists, first to last. */
export function hunks(before: readonly string[], after: readonly string[]): Hunk[] {
  let head = 0;
  while (head < before.length && head < after.length && before[head] === after[head]) head++;
  let [to, end] = [before.length, after.length];
  while (to > head && end > head && before[to - 1] === after[end - 1]) [to, end] = [to - 1, end - 1];
  if (head === to && head === end) return [];
  const inner = joined(before.slice(head, to), after.slice(head, end));
  return inner.map((hunk) => ({ from: hunk.from + head, to: hunk.to + head, start: hunk.start + head, end: hunk.end + head }));
}

/** How far each diagonal reaches after each step, or null where the lists differ too much. */
function reaches(a: readonly string[], b: readonly string[]): Map<number, number>[] | null {
  const trace: Map<number, number>[] = [];
  let reach = new Map([[1, 0]]);
  for (let step = 0; step <= Math.min(MOST, a.length + b.length); step++) {
    const next = new Map<number, number>();
    for (let diagonal = -step; diagonal <= step; diagonal += 2) {
      const isDown = comesFromAbove(reach, step, diagonal);
      let x = isDown ? reach.get(diagonal + 1)! : reach.get(diagonal - 1)! + 1;
      while (x < a.length && x - diagonal < b.length && a[x] === b[x - diagonal]) x++;
      next.set(diagonal, x);
      if (x >= a.length && x - diagonal >= b.length) return [...trace, reach];
    }
    trace.push(reach);
    reach = next;
  }
  return null;
}

const comesFromAbove = (reach: Map<number, number>, step: number, diagonal: number): boolean =>
  diagonal === -step || (diagonal !== step && reach.get(diagonal - 1)! < reach.get(diagonal + 1)!);

/** The differences of two lists, those that touch as one. */
function joined(a: readonly string[], b: readonly string[]): Hunk[] {
  const trace = reaches(a, b);
  if (!trace) return [{ from: 0, to: a.length, start: 0, end: b.length }];
  const found: Hunk[] = [];
  let [x, y] = [a.length, b.length];
  for (let step = trace.length - 1; step > 0; step--) {
    const reach = trace[step]!;
    const isDown = comesFromAbove(reach, step, x - y);
    const before = isDown ? x - y + 1 : x - y - 1;
    const from = reach.get(before)!;
    const start = from - before;
    const [to, end] = isDown ? [from, start + 1] : [from + 1, start];
    const next = found[0];
    if (next?.from === to && next.start === end) [next.from, next.start] = [from, start];
    else found.unshift({ from, to, start, end });
    [x, y] = [from, start];
  }
  return found;
}
