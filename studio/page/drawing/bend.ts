// An edge during a drag of its end: only the end and its corner move.
import type { Point } from "./shapes";

const moved = ([x, y]: Point, [dx, dy]: Point): Point => [x + dx, y + dy];
const zero = ([dx, dy]: Point): boolean => dx === 0 && dy === 0;

/** The corners of an edge whose first point moves by `start` and last by `end`. */
export function bent(points: readonly Point[], start: Point, end: Point): Point[] {
  if (points.length < 2 || (zero(start) && zero(end))) return [...points];
  if (start[0] === end[0] && start[1] === end[1]) return points.map((point) => moved(point, start));
  const corners = points.length === 2 ? split(points[0]!, points[1]!) : [...points];
  const last = corners.length - 1;
  follow(corners, 0, 1, start);
  follow(corners, last, last - 1, end);
  return corners;
}

/** Splits a straight edge in the middle, so that its ends can move. */
function split(from: Point, to: Point): Point[] {
  const upright = Math.abs(from[0] - to[0]) <= Math.abs(from[1] - to[1]);
  const middle = upright ? (from[1] + to[1]) / 2 : (from[0] + to[0]) / 2;
  return upright
    ? [from, [from[0], middle], [to[0], middle], to]
    : [from, [middle, from[1]], [middle, to[1]], to];
}

/** Moves an end; the adjacent corner moves along its line, so that angles stay right. */
function follow(corners: Point[], end: number, beside: number, by: Point): void {
  if (zero(by)) return;
  const [x, y] = corners[end]!;
  const [cx, cy] = corners[beside]!;
  const upright = Math.abs(x - cx) < Math.abs(y - cy);
  corners[end] = moved([x, y], by);
  corners[beside] = upright ? [cx + by[0], cy] : [cx, cy + by[1]];
}

const RADIUS = 7;
const TIP = 9;

/** The path along corners, rounded like the engine's, and its arrowhead. */
export function road(points: readonly Point[]): { line: string; tip: string } {
  const last = points[points.length - 1];
  const before = points[points.length - 2];
  if (!last || !before) return { line: "", tip: "" };
  const length = Math.hypot(last[0] - before[0], last[1] - before[1]) || 1;
  const [ux, uy] = [(last[0] - before[0]) / length, (last[1] - before[1]) / length];
  const neck: Point = [last[0] - ux * Math.min(TIP, length), last[1] - uy * Math.min(TIP, length)];
  const [bx, by] = [last[0] - ux * (TIP + 1), last[1] - uy * (TIP + 1)];
  const wing = 5.5;
  const tip = `M${last[0]} ${last[1]}L${bx - uy * wing} ${by + ux * wing}L${bx + uy * wing} ${by - ux * wing}z`;
  let line = `M${points[0]![0]} ${points[0]![1]}`;
  for (let i = 1; i < points.length - 1; i++) line += corner(points[i - 1]!, points[i]!, points[i + 1]!);
  return { line: `${line}L${neck[0]} ${neck[1]}`, tip };
}

function corner(from: Point, at: Point, to: Point): string {
  const before = Math.hypot(at[0] - from[0], at[1] - from[1]);
  const after = Math.hypot(to[0] - at[0], to[1] - at[1]);
  const radius = Math.min(RADIUS, before / 2, after / 2);
  if (radius < 0.5) return `L${at[0]} ${at[1]}`;
  const [ix, iy] = [at[0] - ((at[0] - from[0]) / before) * radius, at[1] - ((at[1] - from[1]) / before) * radius];
  const [ox, oy] = [at[0] + ((to[0] - at[0]) / after) * radius, at[1] + ((to[1] - at[1]) / after) * radius];
  return `L${ix} ${iy}Q${at[0]} ${at[1]} ${ox} ${oy}`;
}
