// Which port's value is being set, and where; `panes/value.tsx` shows it.
import { signal } from "@preact/signals";
import { putBack } from "./drafts";
import type { Part, Point } from "./shapes";

export const editing = signal<{ part: Part; at: Point | null } | null>(null);

/** The field of a port's value. */
export const fieldOf = ({ item, part }: Part): string => `${item} ${part?.name ?? ""}`;

/** Closes the value that is open, and forgets what was typed into it. */
export function discard(): void {
  const open = editing.peek();
  if (open) putBack(fieldOf(open.part));
  editing.value = null;
}

/** A quantity as a number and its unit; null where a text is another formula. */
export function quantity(text: string): { number: number; unit: string } | null {
  const found = /^\s*(-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*([A-Za-z%][\w%/^]*)?\s*$/i.exec(text);
  return found ? { number: Number(found[1]), unit: found[2] ?? "" } : null;
}

/** A number as a person writes it: no more digits than its step needs. */
export const rounded = (number: number): number => Number(number.toPrecision(10));

export const spelled = (number: number, unit: string): string => `${rounded(number)}${unit ? ` ${unit}` : ""}`;

/** The next number of the grid of the step, or the one before. */
export const stepped = (number: number, step: number, times: 1 | -1): number =>
  rounded(step * (times > 0 ? Math.floor(number / step + 1e-9) + 1 : Math.ceil(number / step - 1e-9) - 1));

/** A number in another unit; each unit has what one of it is worth. */
export const converted = (number: number, from: number, to: number): number => rounded((number * from) / to);

/** The ends of a slider in a unit; null where they are said in another one, or are too far apart to be of use. */
export function slider(range: [string, string] | null, unit: string, step: number): { least: number; most: number } | null {
  const ends = range?.map((end) => quantity(end)) ?? [];
  const [least, most] = ends.map((end) => (end && (end.unit === unit || end.number === 0) ? end.number : null));
  if (least === null || most === null || least === undefined || most === undefined) return null;
  return (most - least) / step > 1000 ? null : { least, most };
}
