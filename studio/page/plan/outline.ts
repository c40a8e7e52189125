// The plan as a tree, in reading order. Pure.
import { reading } from "../drawing/navigate";
import { keyOf, type Drawing, type Part } from "../drawing/shapes";

export interface Twig {
  part: Part;
  inside: Twig[];
}

/**
 * The plan with its entries and supervisors, then each element with its ports, supervisors and
 * exits.
 */
export function tree(drawn: Drawing): Twig[] {
  const entries = drawn.entries.map(({ item }) => ({ part: { item }, inside: [] }));
  return reading(drawn).map((element) => {
    const root = element.kind === null ? (drawn.plan ?? element.item) : element.item;
    const own = parts(element.pieces.filter(({ item }) => item === element.item || item === root));
    const others = [...new Set(element.pieces.map(({ item }) => item))].filter((item) => item !== element.item && item !== root && !drawn.entries.some((entry) => entry.item === item));
    const watching = others.map((item) => ({ part: { item }, inside: parts(element.pieces.filter((piece) => piece.item === item)) }));
    return { part: { item: root }, inside: [...(element.kind === null ? entries : []), ...own, ...watching] };
  });
}

const SHOWN = ["input", "output", "exit"];

function parts(pieces: readonly { item: string; part: NonNullable<Part["part"]> }[]): Twig[] {
  const found = pieces.filter(({ part }) => SHOWN.includes(part.kind)).map(({ item, part }) => ({ part: { item, part }, inside: [] as Twig[] }));
  return found.filter((twig, at) => found.findIndex((other) => keyOf(other.part) === keyOf(twig.part)) === at);
}
