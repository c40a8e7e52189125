// Editing the note (comment) above an item; `notefield.tsx` shows the field.
import { signal } from "@preact/signals";
import * as actions from "./actions";
import * as ask from "./ask";
import { refuse } from "./say";
import type { Point } from "./shapes";
import { turn } from "./turn";
import { words } from "./words";

export const noting = signal<{ item: string; text: string; at: Point | null } | null>(null);

/** Opens the note of the selection; of a part, the note of its item. */
export async function write(): Promise<void> {
  const part = actions.focused();
  if (!part) return refuse(words.selectFirst);
  const { item } = part;
  const isMine = turn();
  const text = (await ask.parts(item).catch(() => null))?.note ?? null;
  if (text !== null && isMine()) noting.value = { item, text, at: actions.below({ item }) };
}

/** Writes a note if it has changed. */
export async function take(text: string): Promise<void> {
  const before = noting.peek();
  noting.value = null;
  if (before && text.trimEnd() !== before.text) await ask.edit([{ setNote: { item: before.item, text: text.trimEnd() } }], {}, [{ item: before.item }]);
}
