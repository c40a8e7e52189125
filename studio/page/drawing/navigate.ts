// Arrow keys in the drawing: down along exits, up back, left and right to neighbours, right into
// the supervisors of an element, from supervisors and parts back to the element. Pure.
import { centre, holderOf, type Drawing, type Element, type Part } from "./shapes";

export type Direction = "down" | "up" | "left" | "right";

/** The start of keyboard navigation without a selection: the plan's start. */
export function home(drawing: Drawing): Part | null {
  const plan = drawing.plan;
  if (plan === null) return null;
  const start = [...drawing.edges.values()].find((edge) => edge.kind === "start");
  return { item: start ? start.to : plan };
}

/** The element in a direction; null without one. */
export function step(drawing: Drawing, from: Part, direction: Direction): Part | null {
  const here = holderOf(drawing, from.item);
  if (!here) return home(drawing);
  const inner = inside(here, from, direction);
  if (inner) return inner;
  const found = direction === "down" ? along(drawing, here, from) : direction === "up" ? back(drawing, here) : beside(drawing, here, direction);
  return found ? whole(drawing, found) : null;
}

const whole = (drawing: Drawing, element: Element): Part => ({ item: element.kind === null ? (drawing.plan ?? element.item) : element.item });

/** Supervisors of an element in order; for the start, those of the plan. */
function supervisors(here: Element): string[] {
  const watching = here.pieces.filter((piece) => piece.item !== here.item && piece.part.kind === "exit").map((piece) => piece.item);
  const drawn = here.kind === null ? watching : here.pieces.filter((piece) => piece.item !== here.item && piece.part.kind === "whole").map((piece) => piece.item);
  return [...new Set(drawn)];
}

/**
 * Moves between an element, its parts and its supervisors; null if the key leads to another
 * element.
 */
function inside(here: Element, from: Part, direction: Direction): Part | null {
  const own = supervisors(here);
  const nth = own.indexOf(from.item);
  const part = (from.part?.kind ?? "whole") !== "whole";
  if (part && direction !== "down" && direction !== "right") return { item: from.item };
  if (nth < 0) return direction === "right" && own[0] !== undefined && !part ? { item: own[0] } : null;
  if (part) return null;
  const element = here.kind === null ? (here.pieces.find((piece) => !piece.item.includes("."))?.item ?? here.item) : here.item;
  if (direction === "left" || (direction === "up" && nth === 0)) return { item: element };
  const beside = direction === "up" ? own[nth - 1] : direction === "down" ? own[nth + 1] : undefined;
  return beside === undefined ? null : { item: beside };
}

/** The target of the selected exit, or of the first exit to another element. */
function along(drawing: Drawing, here: Element, from: Part): Element | null {
  const leaving = (item: string): boolean => holderOf(drawing, item) === here;
  const edges = [...drawing.edges.values()].filter((edge) => leaving(edge.from));
  const supervises = from.item !== here.item && from.item.includes(".");
  const own = supervises ? edges.filter((edge) => edge.from === from.item) : from.part?.kind === "exit" ? edges.filter((edge) => edge.from === from.item && edge.part.name === from.part?.name) : edges;
  const order = [...own].sort((one, two) => (one.points[0]?.[0] ?? 0) - (two.points[0]?.[0] ?? 0));
  const edge = order.find((edge) => edge.to !== here.item) ?? order[0];
  const target = edge && drawing.elements.get(edge.to);
  return target ?? nearest(drawing, here, (away) => away[1] > 0 && away[1] >= Math.abs(away[0]));
}

/** The origin of an incoming edge, the nearest one above if possible. */
function back(drawing: Drawing, here: Element): Element | null {
  const sources = [...drawing.edges.values()].filter((edge) => edge.to === here.item).map((edge) => holderOf(drawing, edge.from));
  const others = sources.filter((source): source is Element => source !== undefined && source !== here);
  const height = (source: Element): number => {
    const above = centre(here.rect)[1] - centre(source.rect)[1];
    return above > 0 ? above : 1e6 - above;
  };
  others.sort((one, two) => height(one) - height(two));
  return others[0] ?? nearest(drawing, here, (away) => away[1] < 0 && -away[1] >= Math.abs(away[0]));
}

const beside = (drawing: Drawing, here: Element, direction: "left" | "right"): Element | null =>
  nearest(drawing, here, ([dx, dy]) => (direction === "left" ? dx < 0 : dx > 0) && Math.abs(dy) <= 2 * Math.abs(dx) + 60);

function nearest(drawing: Drawing, here: Element, fits: (away: [number, number]) => boolean): Element | null {
  const [x, y] = centre(here.rect);
  let best: Element | null = null;
  let least = Infinity;
  for (const element of drawing.elements.values()) {
    const [cx, cy] = centre(element.rect);
    const away: [number, number] = [cx - x, cy - y];
    const far = Math.hypot(...away);
    if (element !== here && far < least && fits(away)) [best, least] = [element, far];
  }
  return best;
}

/** All elements in reading order: rows from the top, each from the left. */
export function reading(drawing: Drawing): Element[] {
  const row = (element: Element): number => Math.round(element.rect[1] / 40);
  return [...drawing.elements.values()].sort((one, two) => row(one) - row(two) || one.rect[0] - two.rect[0]);
}
