// The selection: items of the plan, or parts of them. Drawing, text and inspector share it.
import { signal } from "@preact/signals";
import type { Part } from "../drawing/shapes";

export type Origin = "drawing" | "text" | "other";

/** The selected items; the last one is at the cursor. */
export const selected = signal<Part[]>([]);
/** The origin of the last selection, which needs no update. */
export const origin = signal<Origin>("other");

export function select(parts: Part[], from: Origin): void {
  if (same(parts, selected.peek())) return;
  origin.value = from;
  selected.value = parts;
}

const key = ({ item, part }: Part): string => `${item} ${part?.kind ?? "whole"} ${part?.name ?? ""} ${part?.nth ?? 1}`;

const same = (one: Part[], other: Part[]): boolean =>
  one.length === other.length && one.every((part, at) => key(part) === key(other[at]!));
