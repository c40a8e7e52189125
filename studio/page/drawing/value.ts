// The port whose value is edited, and the popup's place; `panes/value.tsx` shows it.
import { signal } from "@preact/signals";
import { putBack } from "./drafts";
import type { Part, Point } from "./shapes";

export const editing = signal<{ part: Part; at: Point | null } | null>(null);

export const fieldOf = ({ item, part }: Part): string => `${item} ${part?.name ?? ""}`;

/** Closes the popup and discards its text. */
export function discard(): void {
  const open = editing.peek();
  if (open) putBack(fieldOf(open.part));
  editing.value = null;
}
