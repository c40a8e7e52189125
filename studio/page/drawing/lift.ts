// Dragged elements: their groups get a transform, edge ends follow, and no request is made before
// the drop.
import { signal } from "@preact/signals";
import { bent, road } from "./bend";
import { holderOf, nameOf, planOf, type Drawing, type Edge, type Point } from "./shapes";
import type { Stage } from "./stage";

/** Grid of dragged elements, in units of the plan. */
export const GRID = 12;

const NONE: Point = [0, 0];

/** Elements shown elsewhere until the engine answers, and their edges. */
export interface Carried {
  elements: ReadonlySet<string>;
  by: Point;
  followers: readonly Follower[];
}

export const carried = signal<Carried | null>(null);

/**
 * The offset of moved elements that puts the first one on the grid; `free` ignores the grid and
 * uses whole units.
 */
export function snapped(drawing: Drawing, elements: readonly string[], [dx, dy]: Point, free: boolean): Point {
  const first = drawing.elements.get(elements[0] ?? "");
  const step = free ? 1 : GRID;
  if (!first) return [dx, dy];
  const to = (from: number, by: number): number => Math.round((from + by) / step) * step - from;
  return [to(first.rect[0], dx), to(first.rect[1], dy)];
}

export function carry(stage: Stage, drawing: Drawing, elements: readonly string[], by: Point): void {
  const followers = follow(drawing, elements);
  carried.value = { elements: new Set(elements), by, followers };
  const groups = [...elements.map((item) => stage.nodes.get(item)), stage.rings, stage.marks];
  for (const group of groups) group?.setAttribute("transform", `translate(${by[0]} ${by[1]})`);
  for (const { edge, start, end } of followers) {
    const group = stage.edges.get(edge.id);
    if (group && !group.hasAttribute("display")) draw(stage, group, bent(edge.points, start ? by : NONE, end ? by : NONE));
  }
}

export interface Follower {
  edge: Edge;
  /** Whether the start or the end is moved. */
  start: boolean;
  end: boolean;
}

let last: { drawing: Drawing; elements: readonly string[]; found: Follower[] } | null = null;

/** The edges of moved elements; found once per drag. */
function follow(drawing: Drawing, elements: readonly string[]): readonly Follower[] {
  if (last?.drawing === drawing && last.elements === elements) return last.found;
  const carried = new Set(elements);
  const held = (item: string): boolean => carried.has(holderOf(drawing, item)?.item ?? "");
  const all = [...drawing.edges.values()].map((edge) => ({ edge, start: held(edge.from), end: held(edge.to) }));
  last = { drawing, elements, found: all.filter(({ start, end }) => start || end) };
  return last.found;
}

function draw(stage: Stage, group: SVGGElement, points: Point[]): void {
  const { line, tip } = road(points);
  stage.filled.delete(group);
  for (const path of group.querySelectorAll("path")) path.setAttribute("d", path.classList.contains("tip") ? tip : line);
}

/** The positions of moved elements, for `afp/place`. */
export function places(drawing: Drawing, elements: readonly string[], by: Point): Record<string, Point> {
  const found: Record<string, Point> = {};
  for (const item of elements) {
    const element = drawing.elements.get(item);
    if (element) found[item] = [Math.round(element.rect[0] + by[0]), Math.round(element.rect[1] + by[1])];
  }
  return found;
}

/** The elements of selected parts; the start counts as one. */
export function movable(drawing: Drawing, items: readonly string[]): string[] {
  const found = items.map((item) => holderOf(drawing, item)?.item);
  return [...new Set(found.filter((item): item is string => item !== undefined))];
}

/** The announcement for moved elements. */
export const named = (elements: readonly string[]): string =>
  elements.map((item) => (nameOf(item) === "start" ? planOf(item) : nameOf(item))).join(", ");
