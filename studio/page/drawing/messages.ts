// The problems of each part of the drawing, found by their places in the text.
import { computed, effect, signal } from "@preact/signals";
import { current } from "../documents/documents";
import { itemAt } from "../plan/places";
import { problems, said, type Diagnostic } from "../plan/problems";
import { keyOf, type Drawing, type Part } from "./shapes";

/** Problems by the key of the part that they are about. */
const byPart = signal<ReadonlyMap<string, Diagnostic[]>>(new Map());

/** Begins to find out; the answer ends it. */
export function begin(): () => void {
  let round = 0;
  return effect(() => {
    const [list, uri] = [problems.value, current.value];
    const own = ++round;
    const find = async (problem: Diagnostic): Promise<[Part, Diagnostic] | null> => {
      const part = await itemAt(uri, problem.range.start).catch(() => null);
      return part && [part, problem];
    };
    void Promise.all(list.map(find)).then((found) => {
      if (own !== round) return;
      const map = new Map<string, Diagnostic[]>();
      for (const pair of found) if (pair) map.set(keyOf(pair[0]), [...(map.get(keyOf(pair[0])) ?? []), pair[1]]);
      byPart.value = map;
    });
  });
}

/** The code of an element that no way from the start leads to. */
const UNREACHED = "E0302";

/** The elements that no way leads to. */
export const unreached = computed<ReadonlySet<string>>(() => new Set([...byPart.value].flatMap(([key, all]) => (all.some(({ code }) => code === UNREACHED) ? [key] : []))));

/** The problems of a part; of an element, those of its ports and exits as well. */
export function about(drawing: Drawing, part: Part): Diagnostic[] {
  const own = byPart.value.get(keyOf(part)) ?? [];
  if (part.part && part.part.kind !== "whole") return own;
  const pieces = [...drawing.elements.values()].flatMap((element) => element.pieces).filter((piece) => piece.item === part.item);
  const keys = new Set([keyOf({ item: part.item }), ...pieces.map(keyOf)]);
  return [...keys].flatMap((key) => byPart.value.get(key) ?? []);
}

/** The description of a part's problem; empty without one. */
export const messagesOf = (drawing: Drawing, part: Part): { message: string; help: string | null }[] => about(drawing, part).map(said);
