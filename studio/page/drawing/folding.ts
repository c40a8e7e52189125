// Folded boxes: drawn without their bindings, and with one tab for all supervisors.
import { current } from "../documents/documents";
import { selected } from "../plan/selection";
import { drawing } from "./model";
import { refuse } from "./say";
import { holderOf } from "./shapes";
import { folded } from "./folded";
import { words } from "./words";

/** Folds the selected boxes; unfolds them if all are folded. */
export function fold(): void {
  const drawn = drawing.peek();
  const chosen = new Set(drawn ? selected.peek().flatMap((part) => holderOf(drawn, part.item)?.item ?? []) : []);
  if (chosen.size === 0) return refuse(words.selectFirst);
  const before = folded.peek()[current.peek()] ?? [];
  const open = before.filter((item) => !chosen.has(item));
  const all = [...chosen].every((item) => before.includes(item));
  folded.value = { ...folded.peek(), [current.peek()]: all ? open : [...open, ...chosen] };
}
