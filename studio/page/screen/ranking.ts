// Matches of a search, best first: commands, places, choices of the drawing.

interface Rules<T> {
  /** The searched text; the default is the label. */
  text?(each: T): string;
  /** Sorts after all others. */
  isLast?(each: T): boolean;
}

/** Those that hold all words that were typed, those that fit best first, else in their order. */
export function matching<T extends { label: string }>(typed: string, all: readonly T[], { text = labelOf, isLast = () => false }: Rules<T> = {}): T[] {
  const words = wordsOf(typed);
  const fits = all.filter((each) => words.every((word) => text(each).toLowerCase().includes(word)));
  const rank = (each: T): number => rankOf(each.label, typed) + (isLast(each) ? LAST : 0);
  return fits.sort((one, two) => rank(one) - rank(two));
}

/** More than any name's own rank. */
const LAST = 10;

/** Less is better: the name itself, then what begins with all that was typed; then what begins with the first word, and has all of them. */
function rankOf(label: string, typed: string): number {
  const name = label.toLowerCase();
  const [wanted, words] = [typed.trim().toLowerCase(), wordsOf(typed)];
  if (name === wanted) return 0;
  if (name.startsWith(wanted)) return 1;
  return 2 + Number(!name.startsWith(words[0] ?? "")) + Number(!words.every((word) => name.includes(word)));
}

const labelOf = ({ label }: { label: string }): string => label;
const wordsOf = (typed: string): string[] => typed.toLowerCase().split(/\s+/).filter(Boolean);
