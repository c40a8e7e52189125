// The problems of each part, found by their source positions.
import { computed, effect, signal } from "@preact/signals";
import { current } from "../documents/documents";
import { itemAt } from "../plan/places";
import { problems, said, type Diagnostic } from "../plan/problems";
import { keyOf, type Drawing, type Part } from "./shapes";

/** Problems by the key of their part. */
const byPart = signal<ReadonlyMap<string, Diagnostic[]>>(new Map());

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

/** Code of an unreachable element. */
const UNREACHED = "E0302";

export const unreached = computed<ReadonlySet<string>>(() => new Set([...byPart.value].flatMap(([key, all]) => (all.some(({ code }) => code === UNREACHED) ? [key] : []))));

/** The problems of a part; for an element, also of its ports and exits. */
export function about(drawing: Drawing, part: Part): Diagnostic[] {
  const own = byPart.value.get(keyOf(part)) ?? [];
  if (part.part && part.part.kind !== "whole") return own;
  const pieces = [...drawing.elements.values()].flatMap((element) => element.pieces).filter((piece) => piece.item === part.item);
  const keys = new Set([keyOf({ item: part.item }), ...pieces.map(keyOf)]);
  return [...keys].flatMap((key) => byPart.value.get(key) ?? []);
}

/** The description of a part's problem; empty without one. */
export const messagesOf = (drawing: Drawing, part: Part): { message: string; help: string | null }[] => about(drawing, part).map(said);
