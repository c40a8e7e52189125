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

/** Parses a quantity to number and unit; null for another formula. */
export function quantity(text: string): { number: number; unit: string } | null {
  const found = /^\s*(-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*([A-Za-z%][\w%/^]*)?\s*$/i.exec(text);
  return found ? { number: Number(found[1]), unit: found[2] ?? "" } : null;
}

/** The negative of a formula, or back. */
export const negated = (text: string): string => (text.startsWith("-") ? text.slice(1).trim() : /^\w+$/.test(text) ? `-${text}` : `-(${text})`);

/** The operations of formulas, each with its sign on a button. */
export const OPERATIONS = [["+", "+"], ["-", "−"], ["*", "×"], ["/", "÷"]] as const;

/** Whether a formula waits for its right operand. */
export const isPending = (text: string): boolean => OPERATIONS.some(([operation]) => text.trimEnd().endsWith(operation));

/** Rounds to the digits that a step needs. */
export const rounded = (number: number): number => Number(number.toPrecision(10));

export const spelled = (number: number, unit: string): string => `${rounded(number)}${unit ? ` ${unit}` : ""}`;

/** The next or previous number on the grid of the step. */
export const stepped = (number: number, step: number, times: 1 | -1): number =>
  rounded(step * (times > 0 ? Math.floor(number / step + 1e-9) + 1 : Math.ceil(number / step - 1e-9) - 1));

/** Converts a number between units, given their SI values. */
export const converted = (number: number, from: number, to: number): number => rounded((number * from) / to);

/** The ends of a slider in a unit; null for ranges in another unit or too large for a slider. */
export function slider(range: [string, string] | null, unit: string, step: number): { least: number; most: number } | null {
  const ends = range?.map((end) => quantity(end)) ?? [];
  const [least, most] = ends.map((end) => (end && (end.unit === unit || end.number === 0) ? end.number : null));
  if (least === null || most === null || least === undefined || most === undefined) return null;
  return (most - least) / step > 1000 ? null : { least, most };
}
