// The floor from above, in metres, x to the right and y up: positions, bounds of the picture, the
// path driven.

export type Point = readonly [number, number];
/** Metres and radians, counter-clockwise from x. */
export type Pose = readonly [number, number, number];

export interface Thing {
  /** Id in the run. */
  id: string;
  name: string;
  outline: readonly Point[];
  /** Whether it is below the range sensors. */
  low: boolean;
  /** Whether the user can move it. */
  movable: boolean;
  labelled: boolean;
  /** Path of its middle; empty if stationary. */
  path: readonly Point[];
}

export interface World {
  start: Pose;
  /** Outline of the robot at the origin, facing along x. */
  body: readonly Point[];
  things: readonly Thing[];
  patches: readonly { corners: readonly Point[]; color: readonly [number, number, number] }[];
  lights: readonly Point[];
}

/** A rectangle: lower left corner and size. */
export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** Margin, relative to the longer side. */
const MARGIN = 0.03;
/** Minimum size of a picture, metres. */
const LEAST = 0.5;
/** Distance between two points of the path, metres. */
const APART = 0.01;
/** Points per piece of the path; only the last piece is redrawn when the robot moves. */
const PIECE = 200;
/** Maximum number of pieces. */
const PIECES = 100;

/** The outline of a body at a pose. */
export function placed(body: readonly Point[], [x, y, heading]: Pose): Point[] {
  const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
  return body.map(([u, v]) => [x + u * cos - v * sin, y + u * sin + v * cos]);
}

/** The bounds of a world's picture with a margin. */
export function frame(world: World): Box {
  const things = world.things.flatMap(({ outline, path }) => [...outline, ...path]);
  const all = [...things, ...world.patches.flatMap(({ corners }) => corners), ...world.lights, ...placed(world.body, world.start)];
  const bound = (axis: 0 | 1): [number, number] => {
    const [low, high] = all.reduce(([low, high], point) => [Math.min(low, point[axis]), Math.max(high, point[axis])], [Infinity, -Infinity]);
    const [middle, half] = [(low + high) / 2, Math.max(high - low, LEAST) / 2];
    return [middle - half, middle + half];
  };
  if (!all.length) return { x: -LEAST, y: -LEAST, width: 2 * LEAST, height: 2 * LEAST };
  const [[left, right], [bottom, top]] = [bound(0), bound(1)];
  const margin = MARGIN * Math.max(right - left, top - bottom);
  return { x: left - margin, y: bottom - margin, width: right - left + 2 * margin, height: top - bottom + 2 * margin };
}

/** The same for SVG, with y down. */
export const viewBox = ({ x, y, width, height }: Box): string => [x, -(y + height), width, height].map(short).join(" ");

/** Pixels per metre for a picture in a rectangle of pixels. */
export const scaleIn = (box: Box, width: number, height: number): number => Math.min(width / box.width, height / box.height);

/** A length for SVG, rounded to a tenth of a millimetre. */
export const short = (metres: number): string => String(Math.round(metres * 1e4) / 1e4);

export const points = (all: readonly (readonly number[])[]): string => all.map(([x, y]) => `${short(x!)},${short(y!)}`).join(" ");

/** The view of a range sensor up to its echo, as a sector. */
export function sector([x, y, heading]: Pose, half: number, range: number): string {
  const end = (angle: number): string => `${short(x + range * Math.cos(angle))} ${short(y + range * Math.sin(angle))}`;
  return `M${short(x)} ${short(y)}L${end(heading - half)}A${short(range)} ${short(range)} 0 ${half > Math.PI / 2 ? 1 : 0} 1 ${end(heading + half)}Z`;
}

export function middle(outline: readonly Point[]): Point {
  const sum = outline.reduce(([x, y], [u, v]) => [x + u, y + v] as const, [0, 0] as const);
  return [sum[0] / outline.length, sum[1] / outline.length];
}

/**
 * The place of a name: inside its object or, if that would hide it, below; never outside the
 * picture.
 */
export function placeOf(outline: readonly Point[], box: Box, [width, height]: readonly [number, number]): Point {
  const [x, y] = middle(outline);
  const [across, up] = ([0, 1] as const).map((axis) => outline.map((point) => point[axis]));
  const hides = Math.max(...across!) - Math.min(...across!) < width && Math.max(...up!) - Math.min(...up!) < 3 * height;
  const level = hides ? Math.min(...up!) - 0.7 * height : y;
  const within = (at: number, low: number, size: number, half: number): number => Math.min(Math.max(at, low + half), low + size - half);
  return [within(x, box.x, box.width, width / 2), within(level, box.y, box.height, height / 2)];
}

/**
 * Robot positions with the run's seconds, in pieces that each begin at the end of the previous one.
 */
export type Path = readonly (readonly (readonly [number, number, number])[])[];

/** Appends a pose. Later points are cut, since a run may have gone back. */
export function extended(path: Path, [x, y]: Pose, at: number): Path {
  const later = (path.at(-1)?.at(-1)?.[2] ?? 0) > at;
  const before = later ? path.map((piece) => piece.filter((point) => point[2] <= at)).filter((piece) => piece.length > 1) : path;
  const last = before.at(-1);
  const end = last?.at(-1);
  const step = [x, y, at] as const;
  if (!last || !end) return [[step]];
  if (Math.hypot(x - end[0], y - end[1]) < APART) return before;
  if (last.length < PIECE) return [...before.slice(0, -1), [...last, step]];
  return [...before, [end, step]].slice(-PIECES);
}
