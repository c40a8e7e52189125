// Conversion between the protocol's positions (lines, UTF-16 columns) and string offsets. Lines end
// with `\n`.

export interface Position {
  line: number;
  character: number;
}

export interface Range {
  start: Position;
  end: Position;
}

let lastText = "";
let lastStarts = [0];

/** Offsets of line starts; cached for the last text. */
function starts(text: string): number[] {
  if (text !== lastText) {
    lastStarts = [0];
    for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1)) lastStarts.push(at + 1);
    lastText = text;
  }
  return lastStarts;
}

/** The offset of a position, limited to its line's end. */
export function offset(text: string, { line, character }: Position): number {
  const all = starts(text);
  const start = all[line];
  if (start === undefined) return text.length;
  const next = all[line + 1];
  return Math.min(start + character, next === undefined ? text.length : next - 1);
}

export function position(text: string, at: number): Position {
  const all = starts(text);
  let [low, high] = [0, all.length];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (all[middle]! <= at) low = middle;
    else high = middle;
  }
  return { line: low, character: at - all[low]! };
}

export function range(text: string, from: number, to: number): Range {
  return { start: position(text, from), end: position(text, to) };
}
