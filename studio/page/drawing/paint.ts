// Small pictures of plans with only boxes and lines, for the far view and the minimap.
import { bent } from "./bend";
import { svg } from "./fragment";
import type { Carried } from "./lift";
import { boxOf, touches, type Drawing, type Element, type Point, type Rect } from "./shapes";
import { sight, type Size, type View } from "./view";

/** Fill and border of boxes and the line of edges by kind, and colours of problems. */
export interface Colours {
  boxes: ReadonlyMap<string, { fill: string; stroke: string }>;
  lines: ReadonlyMap<string, string>;
  wrong: ReadonlyMap<string, string>;
}

const BOXES = ["actor", "computation", "subplan", "supervisor", "start"];
const LINES = ["start", "state", "event", "error", "missed"];
const WRONG = ["error", "warning"] as const;

/** The colours of the engine's style sheet, as computed in a drawing of the page. */
export function coloursIn(root: SVGSVGElement): Colours {
  const group = svg("g");
  root.append(group);
  const style = (name: string): CSSStyleDeclaration => getComputedStyle(group.appendChild(svg("path", { class: name })));
  const found: Colours = {
    boxes: new Map(BOXES.map((kind) => {
      const { fill, stroke } = style(`box ${kind}`);
      return [kind, { fill, stroke }];
    })),
    lines: new Map(LINES.map((kind) => [kind, style(`flow ${kind}`).stroke])),
    wrong: new Map(WRONG.map((severity) => [severity, style(`icon ${severity === "error" ? "wrong" : "doubtful"}`).color])),
  };
  group.remove();
  return found;
}

/** Widths of borders and lines at any zoom, and the minimum size of boxes, in screen pixels. */
const BORDER = 1.2;
const LINE = 1.2;
const LEAST = 2;

/** Paints the visible part. `size` is in CSS pixels, each with `density` canvas pixels. */
export function paint(canvas: HTMLCanvasElement, drawing: Drawing, view: View, size: Size, colours: Colours, carried: Carried | null = null): void {
  const context = canvas.getContext("2d");
  if (!context) return;
  const density = window.devicePixelRatio || 1;
  const [width, height] = [Math.round(size.width * density), Math.round(size.height * density)];
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, width, height);
  context.setTransform(view.zoom * density, 0, 0, view.zoom * density, view.x * density, view.y * density);
  const seen = sight(view, size);
  lines(context, drawing, seen, LINE / view.zoom, colours, carried);
  boxes(context, drawing, seen, view.zoom, colours, carried);
}

function lines(context: CanvasRenderingContext2D, drawing: Drawing, seen: Rect, width: number, { lines }: Colours, carried: Carried | null): void {
  const moved = new Map((carried?.followers ?? []).map((follower) => [follower.edge.id, follower]));
  const still: Point = [0, 0];
  context.lineWidth = width;
  for (const [kind, colour] of lines) {
    // All lines of a colour at once: this makes a thousand of them fast.
    context.beginPath();
    for (const edge of drawing.edges.values()) {
      if (edge.kind !== kind) continue;
      const ends = moved.get(edge.id);
      if (!ends && !touches(boxOf(edge), seen)) continue;
      const points = ends && carried ? bent(edge.points, ends.start ? carried.by : still, ends.end ? carried.by : still) : edge.points;
      points.forEach(([x, y], nth) => (nth === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
    }
    context.strokeStyle = colour;
    context.stroke();
  }
}

function boxes(context: CanvasRenderingContext2D, drawing: Drawing, seen: Rect, zoom: number, colours: Colours, carried: Carried | null): void {
  context.lineWidth = BORDER / zoom;
  for (const element of drawing.elements.values()) {
    const by: Point = carried?.elements.has(element.item) ? carried.by : [0, 0];
    const { rect, supervisors, wrong } = seenSmall(element);
    if (!touches([element.outer[0] + by[0], element.outer[1] + by[1], element.outer[2], element.outer[3]], seen)) continue;
    for (const each of supervisors) box(context, each, by, zoom, colours.boxes.get("supervisor")!);
    box(context, rect, by, zoom, colours.boxes.get(element.kind ?? "start") ?? colours.boxes.get("actor")!);
    if (!wrong) continue;
    context.fillStyle = colours.wrong.get(wrong)!;
    context.beginPath();
    context.arc(rect[0] + by[0] + rect[2], rect[1] + by[1], 3.5 / zoom, 0, 2 * Math.PI);
    context.fill();
  }
}

function box(context: CanvasRenderingContext2D, rect: Rect, [dx, dy]: Point, zoom: number, look: { fill: string; stroke: string }): void {
  const place = [rect[0] + dx, rect[1] + dy, Math.max(rect[2], LEAST / zoom), Math.max(rect[3], LEAST / zoom)] as const;
  [context.fillStyle, context.strokeStyle] = [look.fill, look.stroke];
  context.fillRect(...place);
  context.strokeRect(...place);
}

/** The reduced form of an element. */
interface Small {
  rect: Rect;
  supervisors: readonly Rect[];
  /** Its most severe problem; empty for none. */
  wrong: "error" | "warning" | "";
}

const small = new WeakMap<Element, Small>();

function seenSmall(element: Element): Small {
  const known = small.get(element);
  if (known) return known;
  const has = (what: string): boolean => element.pieces.some((piece) => piece.severity === what);
  const leaving = new Set(element.pieces.filter((piece) => piece.part.kind === "exit").map((piece) => piece.item));
  // Entries have no exits; other pieces that are not the element are supervisors.
  const watching = element.pieces.filter(({ item, part }) => part.kind === "whole" && item !== element.item && leaving.has(item));
  const found: Small = { rect: element.rect, supervisors: watching.map(({ rect }) => rect), wrong: has("error") ? "error" : has("warning") ? "warning" : "" };
  small.set(element, found);
  return found;
}
