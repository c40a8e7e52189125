// Types of the engine's messages about a drawing, and their geometry. It has no imports, so that
// editors can check it without the page's packages.

/** An item of a plan, or a part of it. */
export interface Part {
  /** Path of an item, such as `WallFollowing.followWall`. */
  item: string;
  part?: { kind: string; name?: string; nth?: number };
}

export type Point = readonly [x: number, y: number];
/** Left, top, width and height, in units of the plan. */
export type Rect = readonly [x: number, y: number, width: number, height: number];

/** A part of an item, as the engine names it. */
export type PartOf = NonNullable<Part["part"]>;

export interface Piece {
  item: string;
  part: PartOf;
  rect: Rect;
  severity: "error" | "warning" | null;
  /** Tag of an unconnected exit. */
  tag: Rect | null;
}

export interface Element {
  item: string;
  /** The box itself. */
  rect: Rect;
  /** The box with its supervisors, ports and exits. */
  outer: Rect;
  svg: string;
  pieces: Piece[];
  /** Null for the start with the entries. */
  kind: string | null;
  template: string | null;
  /** The plan of a sub-plan. */
  plan: string | null;
  /** Address of its file, if that is another one. */
  file: string | null;
  help: string | null;
  note: string | null;
}

export interface Edge {
  id: string;
  from: string;
  part: PartOf;
  to: string;
  kind: string;
  points: Point[];
  svg: string;
  severity: "error" | "warning" | null;
}

export interface Entry {
  item: string;
  name: string | null;
  kind: "in" | "out" | "var" | "const";
  type: string | null;
  value: string | null;
  help: string;
}

export interface SymbolOf {
  id: string;
  svg: string;
}

/** `afp/drawing` */
export interface Answer {
  version: number | null;
  plan: string | null;
  plans: string[];
  bounds: Rect | null;
  elements: Element[];
  edges: Edge[];
  entries: Entry[] | null;
  symbols: SymbolOf[];
}

/** `afp/drawingChanged` */
export interface Changed extends Answer {
  textDocument: { uri: string };
  gone: string[];
}

/** A drawing in the page; immutable. */
export interface Drawing {
  uri: string;
  plan: string | null;
  plans: string[];
  bounds: Rect;
  elements: ReadonlyMap<string, Element>;
  edges: ReadonlyMap<string, Edge>;
  entries: Entry[];
  symbols: SymbolOf[];
}

/** The last name of a path: `touch` of `P.go.touch`. */
export const nameOf = (item: string): string => item.slice(item.lastIndexOf(".") + 1);

export const planOf = (item: string): string => item.split(".", 1)[0] ?? "";

/**
 * The element that an item is drawn with: itself, or a supervisor's owner; the start holds the
 * plan, its entries and its supervisors.
 */
export function holderOf(drawing: Drawing, item: string): Element | undefined {
  const own = drawing.elements.get(item);
  if (own) return own;
  const names = item.split(".");
  const owner = drawing.elements.get(names.slice(0, 2).join("."));
  return owner ?? drawing.elements.get(`${names[0] ?? ""}.start`);
}

/** The key of a part, for comparison. */
export function keyOf(part: Part): string {
  const { kind = "whole", name = "", nth = 1 } = part.part ?? {};
  return `${part.item} ${kind} ${name} ${nth}`;
}

export const same = (one: Part, two: Part): boolean => keyOf(one) === keyOf(two);

export const inside = ([x, y, width, height]: Rect, [px, py]: Point, more = 0): boolean =>
  px >= x - more && px <= x + width + more && py >= y - more && py <= y + height + more;

export const touches = (one: Rect, two: Rect): boolean =>
  one[0] <= two[0] + two[2] && two[0] <= one[0] + one[2] && one[1] <= two[1] + two[3] && two[1] <= one[1] + one[3];

export const centre = ([x, y, width, height]: Rect): Point => [x + width / 2, y + height / 2];

/** The bounding rectangle; null for none. */
export function around(rects: Iterable<Rect>): Rect | null {
  let found: [number, number, number, number] | null = null;
  for (const [x, y, width, height] of rects) {
    found = found
      ? [Math.min(found[0], x), Math.min(found[1], y), Math.max(found[2], x + width), Math.max(found[3], y + height)]
      : [x, y, x + width, y + height];
  }
  return found && [found[0], found[1], found[2] - found[0], found[3] - found[1]];
}

const boxes = new WeakMap<Edge, Rect>();

/** The bounding rectangle of an edge, cached since edges are immutable. */
export function boxOf(edge: Edge): Rect {
  const known = boxes.get(edge);
  if (known) return known;
  const box = around(edge.points.map(([x, y]) => [x, y, 0, 0] as const)) ?? [0, 0, 0, 0];
  boxes.set(edge, box);
  return box;
}

/** Distance of a point from a polyline. */
export function distance(points: readonly Point[], [px, py]: Point): number {
  let least = Infinity;
  for (let i = 1; i < points.length; i++) {
    const [ax, ay] = points[i - 1]!;
    const [bx, by] = points[i]!;
    const length = (bx - ax) ** 2 + (by - ay) ** 2;
    const along = length === 0 ? 0 : Math.max(0, Math.min(1, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length));
    least = Math.min(least, Math.hypot(px - ax - along * (bx - ax), py - ay - along * (by - ay)));
  }
  return least;
}

/** The rectangle of a part: its piece, or its item's; null if not drawn yet. */
export function rectOf(drawing: Drawing, part: Part): Rect | null {
  const holder = holderOf(drawing, part.item);
  if (!holder) return null;
  const key = keyOf(part);
  const piece = holder.pieces.find((piece) => keyOf(piece) === key);
  const whole = piece ?? holder.pieces.find((piece) => piece.item === part.item && piece.part.kind === "whole");
  return whole?.rect ?? (holder.item === part.item ? holder.rect : null);
}
