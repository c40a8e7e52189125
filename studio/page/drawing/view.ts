// Pan and zoom: the position of the plan in its pane. Pure; the canvas writes the result to one
// transform.
import type { Point, Rect } from "./shapes";

/** A point p of the plan is at `p * zoom + (x, y)` of the pane, in CSS pixels. */
export interface View {
  x: number;
  y: number;
  zoom: number;
}

export interface Size {
  width: number;
  height: number;
}

export const LEAST = 0.1;
export const MOST = 4;
/** Margin around a fitted drawing. */
export const MARGIN = 24;
/** Below this, templates and ports are hidden; below the second, only boxes and lines are shown. */
export const NEAR = 0.8;
export const FAR = 0.35;

const clamp = (value: number, least: number, most: number): number => Math.max(least, Math.min(most, value));

export const toPlan = (view: View, [x, y]: Point): Point => [(x - view.x) / view.zoom, (y - view.y) / view.zoom];

export const toPane = (view: View, [x, y]: Point): Point => [x * view.zoom + view.x, y * view.zoom + view.y];

export const panned = (view: View, dx: number, dy: number): View => ({ ...view, x: view.x + dx, y: view.y + dy });

/** Zooms around the point `at`. */
export function zoomed(view: View, factor: number, at: Point): View {
  const zoom = clamp(view.zoom * factor, LEAST, MOST);
  const [x, y] = toPlan(view, at);
  return { zoom, x: at[0] - x * zoom, y: at[1] - y * zoom };
}

/** Fits a rectangle into the middle of the pane, at most 1:1. */
export function fitted(rect: Rect, size: Size, least = LEAST, margin = MARGIN): View {
  const [x, y, width, height] = rect;
  const room = Math.min((size.width - 2 * margin) / Math.max(width, 1), (size.height - 2 * margin) / Math.max(height, 1));
  const zoom = clamp(Math.min(room, 1), least, MOST);
  const left = (size.width - width * zoom) / 2;
  const top = (size.height - height * zoom) / 2;
  return { zoom, x: Math.max(left, margin) - x * zoom, y: Math.max(top, margin) - y * zoom };
}

/** Centres a point of the plan at the same zoom. */
export const centred = (view: View, [x, y]: Point, size: Size): View => ({
  zoom: view.zoom,
  x: size.width / 2 - x * view.zoom,
  y: size.height / 2 - y * view.zoom,
});

/** The parts of a drawing that decide the first view. */
interface Shown {
  bounds: Rect;
  plan: string | null;
  elements: ReadonlyMap<string, { rect: Rect }>;
}

/**
 * The first view of a plan: fitted, but legible, and otherwise from its top with the start in view.
 */
export function first({ bounds, plan, elements }: Shown, size: Size): View {
  const view = fitted(bounds, size, Math.min(NEAR, 1));
  const start = elements.get(`${plan}.start`);
  return start ? shown(view, start.rect, size) : view;
}

/** Reveals a rectangle with the smallest move. */
export function shown(view: View, rect: Rect, size: Size): View {
  const [left, top] = toPane(view, [rect[0], rect[1]]);
  const [right, bottom] = toPane(view, [rect[0] + rect[2], rect[1] + rect[3]]);
  const by = (from: number, to: number, room: number): number => {
    if (from < MARGIN) return MARGIN - from;
    if (to > room - MARGIN) return Math.max(room - MARGIN - to, MARGIN - from);
    return 0;
  };
  const dx = by(left, right, size.width);
  const dy = by(top, bottom, size.height);
  return dx === 0 && dy === 0 ? view : panned(view, dx, dy);
}

/** The visible part of the plan. */
export function sight(view: View, size: Size): Rect {
  const [x, y] = toPlan(view, [0, 0]);
  return [x, y, size.width / view.zoom, size.height / view.zoom];
}

/** The zoom factor of `+` and `-`. */
export const STEP = 1.25;

/** The zoom factor of the wheel; pinches of touchpads arrive as small turns with `Ctrl`. */
export const wheelFactor = (deltaY: number): number => Math.exp(-clamp(deltaY, -14, 14) / 120);
