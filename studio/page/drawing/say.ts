// Texts for users: names of parts for screen readers, the live region, and notices.
import { signal } from "@preact/signals";
import { holderOf, nameOf, type Drawing, type Element, type Part } from "./shapes";
import { words } from "./words";

/** The text of the live region. */
export const said = signal("");
/** A rejection, shown for a while. */
export const notice = signal("");

let ends: ReturnType<typeof setTimeout> | undefined;
/** Duration of a notice, milliseconds. */
const STAYS = 7000;

export function say(text: string): void {
  said.value = text;
}

/** Announces and shows a rejection. */
export function refuse(why: unknown): void {
  notice.value = why instanceof Error ? why.message : String(why);
  say(notice.value);
  clearTimeout(ends);
  ends = setTimeout(() => (notice.value = ""), STAYS);
}

/** The name of an element, supervisor, exit, port or entry, for screen readers. */
export function spoken(drawing: Drawing, part: Part): string {
  const { item } = part;
  const { kind = "whole", name = "" } = part.part ?? {};
  if (kind === "exit") return words.exitOf(name, nameOf(item), target(drawing, part));
  if (kind === "input" || kind === "output") return words.portOf(name, nameOf(item));
  const entry = drawing.entries.find((entry) => entry.item === item);
  if (entry) return joined([words.entry(entry.name ?? ""), entry.kind, entry.type, entry.value && words.startsWith(entry.value)]);
  const element = drawing.elements.get(item);
  if (element?.kind) return described(drawing, element);
  const supervises = item.split(".").length > 1 && holderOf(drawing, item) !== undefined;
  return supervises && element === undefined ? words.supervisor(nameOf(item)) : words.plan(drawing.plan ?? "", drawing.elements.size - 1, drawing.entries.length);
}

const joined = (texts: (string | null)[]): string => texts.filter(Boolean).join(", ");

function target(drawing: Drawing, exit: Part): string | null {
  const edge = [...drawing.edges.values()].find((edge) => edge.from === exit.item && edge.part.name === exit.part?.name);
  return edge ? nameOf(edge.to) : null;
}

function described(drawing: Drawing, element: Element): string {
  const inner = new Set(element.pieces.filter((piece) => piece.item !== element.item).map((piece) => piece.item));
  const exits = element.pieces.filter((piece) => piece.item === element.item && piece.part.kind === "exit");
  const wrong = (severity: string): boolean => element.pieces.some((piece) => piece.severity === severity);
  const start = [...drawing.edges.values()].some((edge) => edge.kind === "start" && edge.to === element.item);
  return joined([
    `${element.kind ?? ""} ${nameOf(element.item)}`,
    element.template,
    words.supervisors(inner.size),
    words.exits(exits.length),
    start ? words.isStart : null,
    wrong("error") ? words.withError : wrong("warning") ? words.withWarning : null,
  ]);
}
