// A start with free floor ahead, for a first run that ends well.
import { placed, type Point, type Pose, type World } from "./geometry";

/** Free distance ahead, metres: a first plan drives less than this. */
const AHEAD = 1.3;
const STEP = 0.05;
/** The body is tried a little larger than it is. */
const LARGER = 1.1;
/** Headings to try, in eighths of a circle: along the sides of a room first. */
const TURNS = [0, 2, -2, 4, 1, -1, 3, -3].map((nth) => (nth * Math.PI) / 4);

/** The world's start, turned to the first heading with free floor ahead. */
export function freeStart(world: World): Pose {
  const [x, y, heading] = world.start;
  const turned = TURNS.map((turn): Pose => [x, y, heading + turn]);
  return turned.find((pose) => isFree(world, pose)) ?? world.start;
}

function isFree(world: World, [x, y, heading]: Pose): boolean {
  const larger = world.body.map(([u, v]): Point => [LARGER * u, LARGER * v]);
  for (let far = 0; far <= AHEAD; far += STEP) {
    const body = placed(larger, [x + far * Math.cos(heading), y + far * Math.sin(heading), heading]);
    if (world.things.some(({ outline }) => touch(body, outline))) return false;
  }
  return true;
}

const sides = (outline: readonly Point[]): [Point, Point][] => outline.map((point, at) => [point, outline[(at + 1) % outline.length]!]);

/** Whether two outlines cross. */
const touch = (one: readonly Point[], other: readonly Point[]): boolean => sides(one).some((a) => sides(other).some((b) => cross(a, b)));

function cross([a, b]: [Point, Point], [c, d]: [Point, Point]): boolean {
  const side = (p: Point, q: Point, r: Point): number => (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}
