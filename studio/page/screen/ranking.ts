// Ranked search matches: commands, places, choices of the drawing.

interface Rules<T> {
  /** The searched text; the default is the label. */
  text?(each: T): string;
  /** Sorts after all others. */
  isLast?(each: T): boolean;
}

/** The items that match all typed words, best first, otherwise in order. */
export function matching<T extends { label: string }>(typed: string, all: readonly T[], { text = labelOf, isLast = () => false }: Rules<T> = {}): T[] {
  const words = wordsOf(typed);
  const fits = all.filter((each) => words.every((word) => text(each).toLowerCase().includes(word)));
  const rank = (each: T): number => rankOf(each.label, typed) + (isLast(each) ? LAST : 0);
  return fits.sort((one, two) => rank(one) - rank(two));
}

/** Greater than any name's rank. */
const LAST = 10;

/**
 * Lower is better: the name itself, then the whole typed prefix, then the first word as prefix with
 * all words.
 */
function rankOf(label: string, typed: string): number {
  const name = label.toLowerCase();
  const [wanted, words] = [typed.trim().toLowerCase(), wordsOf(typed)];
  if (name === wanted) return 0;
  if (name.startsWith(wanted)) return 1;
  return 2 + Number(!name.startsWith(words[0] ?? "")) + Number(!words.every((word) => name.includes(word)));
}

const labelOf = ({ label }: { label: string }): string => label;
const wordsOf = (typed: string): string[] => typed.toLowerCase().split(/\s+/).filter(Boolean);
