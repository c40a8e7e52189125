// Finds the item under a point of the plan from the engine's rectangles.
import { boxOf, distance, holderOf, inside, type Drawing, type Edge, type Element, type Part, type Point } from "./shapes";

/** The pressed item. */
export type Hit =
  | { on: "element" | "exit" | "port" | "entry" | "start"; part: Part; element: string }
  | { on: "edge" | "head"; part: Part; edge: string };

/** Tolerance around edges, in screen pixels: for a mouse, and for a finger. */
export const NEAR_EDGE = 6;
export const NEAR_FINGER = 14;
/** Length of the arrowhead that can be dragged to another target, in screen pixels. */
const HEAD = 16;

/** The topmost item at a point; null on the ground. */
export function hit(drawing: Drawing, at: Point, zoom: number, near = NEAR_EDGE): Hit | null {
  return piece(drawing, at) ?? edge(drawing, at, near / zoom, zoom);
}

function piece(drawing: Drawing, at: Point): Hit | null {
  let found: { hit: Hit; size: number } | null = null;
  for (const element of drawing.elements.values()) {
    if (!inside(element.outer, at, 10)) continue;
    for (const piece of element.pieces) {
      const size = piece.rect[2] * piece.rect[3];
      // The smaller of two is on top: exits on boxes.
      if (!(inside(piece.rect, at) || (piece.tag && inside(piece.tag, at))) || (found && found.size <= size)) continue;
      const part: Part = { item: piece.item, part: piece.part };
      found = { size, hit: { on: kindOf(element, part), part, element: element.item } };
    }
  }
  return found?.hit ?? null;
}

function kindOf(element: Element, part: Part): "element" | "exit" | "port" | "entry" | "start" {
  if (part.part?.kind === "exit") return "exit";
  if (part.part?.kind === "input" || part.part?.kind === "output") return "port";
  if (element.kind === null && !part.item.includes(".")) return "start";
  const entry = element.kind === null && element.pieces.some((other) => other.item === part.item && other.part.kind === "exit") === false;
  return entry ? "entry" : "element";
}

/** The kind of a part. */
export function onOf(drawing: Drawing, part: Part): Hit["on"] | null {
  const holder = holderOf(drawing, part.item);
  return holder ? kindOf(holder, part) : null;
}

function edge(drawing: Drawing, at: Point, near: number, zoom: number): Hit | null {
  let best: Edge | null = null;
  let least = near;
  for (const one of drawing.edges.values()) {
    if (!inside(boxOf(one), at, near)) continue;
    const away = distance(one.points, at);
    if (away <= least) [best, least] = [one, away];
  }
  if (!best) return null;
  const [x, y] = best.points[best.points.length - 1] ?? [0, 0];
  const on = Math.hypot(at[0] - x, at[1] - y) <= HEAD / zoom ? "head" : "edge";
  return { on, part: { item: best.from, part: best.part }, edge: best.id };
}
