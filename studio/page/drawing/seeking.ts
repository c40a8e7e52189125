// The search in the drawing: selects parts with matching names or texts one after the other.
import { computed } from "@preact/signals";
import { select, selected } from "../plan/selection";
import { sought } from "../plan/seek";
import { nodes } from "./fragment";
import { drawing } from "./model";
import { reading } from "./navigate";
import { reveal } from "./reveal";
import { say, spoken } from "./say";
import { nameOf, same, type Drawing, type Element, type Part } from "./shapes";
import { words } from "./words";

const texts = new WeakMap<Element, string>();

/** All texts of an element in lower case. */
function textOf(element: Element): string {
  const known = texts.get(element);
  if (known !== undefined) return known;
  const shown = nodes(element.svg).flatMap((node) => [...node.querySelectorAll("text")]);
  const text = [nameOf(element.item), ...shown.map((each) => each.textContent)].join(" ").toLowerCase();
  texts.set(element, text);
  return text;
}

/**
 * The parts of an element whose names contain a text in lower case; the element itself if another
 * text matches.
 */
function within(element: Element, wanted: string): Part[] {
  if (!textOf(element).includes(wanted)) return [];
  const named = element.pieces.filter(({ item, part }) => (part.kind === "whole" ? nameOf(item) : (part.name ?? "")).toLowerCase().includes(wanted));
  const parts = named.map(({ item, part }): Part => (part.kind === "whole" ? { item } : { item, part }));
  return parts.length ? parts : [{ item: element.item }];
}

/** The matching parts of a drawing, in reading order. */
export function found(drawing: Drawing, text: string): Part[] {
  const wanted = text.trim().toLowerCase();
  return wanted ? reading(drawing).flatMap((element) => within(element, wanted)) : [];
}

export const hits = computed(() => (drawing.value && sought.value !== null ? found(drawing.value, sought.value) : []));

/** Index of the selected match; -1 for none. */
export const nth = computed(() => {
  const last = selected.value.at(-1);
  return last ? hits.value.findIndex((hit) => same(hit, last)) : -1;
});

/** Selects the next or previous match. */
export function next(by: 1 | -1): void {
  const all = hits.peek();
  const drawn = drawing.peek();
  const at = nth.peek();
  const to = all[(at < 0 ? (by === 1 ? 0 : all.length - 1) : at + by + all.length) % all.length];
  if (!to || !drawn) return say(words.nothingFound);
  select([to], "drawing");
  reveal(to);
  say(spoken(drawn, to));
}
