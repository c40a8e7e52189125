// The world without a page: the content of a picture, the path in pieces, the robot between two
// poses.
import assert from "node:assert/strict";
import { test } from "node:test";
import { freeStart } from "../page/world/free";
import { extended, frame, middle, placed, placeOf, points, scaleIn, viewBox, type Path, type Point, type World } from "../page/world/geometry";
import { dragged, nudged } from "../page/world/grab";
import { poseOf, put, seen } from "../page/world/hand";
import { between, shown, towards } from "../page/world/motion";

const BODY: Point[] = [[0.2, 0.1], [-0.2, 0.1], [-0.2, -0.1], [0.2, -0.1]];
const thing = (outline: Point[], path: Point[] = []) => ({ id: "0 box", name: "box", outline, low: false, movable: false, labelled: true, path });
const world = (change: Partial<World>): World => ({ start: [0, 0, 0], body: BODY, things: [], patches: [], lights: [], ...change });
const near = (found: number, wanted: number): void => assert.ok(Math.abs(found - wanted) < 1e-9, `${found} is not ${wanted}`);

test("a body is drawn at its pose, turned counter-clockwise", () => {
  const [front] = placed(BODY, [1, 2, Math.PI / 2]);
  near(front![0], 0.9);
  near(front![1], 2.2);
});

test("a picture has the robot, objects with their paths, patches and lights, with a margin; y points up", () => {
  const all = frame(world({ things: [thing([[1, 0], [2, 0], [2, 1]], [[2, 1], [2, 3]])], patches: [{ corners: [[-1, 0], [0, -2]], color: [1, 2, 3] }], lights: [[4, 0]] }));
  near(all.x, -1.15);
  near(all.y, -2.15);
  near(all.width, 5.3);
  near(all.height, 5.3);
  assert.equal(viewBox(all), "-1.15 -3.15 5.3 5.3");
  near(scaleIn(all, 530, 265), 50);
});

test("an almost empty picture is at least half a metre wide", () => {
  const small = frame(world({ body: [[0, 0]] }));
  near(small.width, 0.53);
  near(small.height, 0.53);
  assert.ok(frame(world({ body: [] })).width > 0);
});

test("outlines have their points and their middle", () => {
  assert.equal(points([[0.123456, -1], [2, 0]]), "0.1235,-1 2,0");
  assert.deepEqual(middle([[0, 0], [2, 0], [2, 2], [0, 2]]), [1, 1]);
});

test("a name is inside its object, or below it if it would hide it, and always inside the picture", () => {
  const box = { x: 0, y: 0, width: 4, height: 4 };
  const square = (x: number, y: number, size: number): Point[] => [[x, y], [x + size, y], [x + size, y + size], [x, y + size]];
  assert.deepEqual(placeOf(square(1, 1, 2), box, [1, 0.2]), [2, 2]);
  assert.deepEqual(placeOf([[1, 0], [1.4, 0], [1.4, 2], [1, 2]], box, [1, 0.2]), [1.2, 1]);
  const [x, y] = placeOf(square(1, 1, 0.5), box, [1, 0.2]);
  near(x, 1.25);
  near(y, 0.86);
  assert.deepEqual(placeOf(square(3.6, 0, 0.4), box, [1, 0.2]), [3.5, 0.1]);
});

test("a path grows with the robot's motion, in connected pieces", () => {
  let path: Path = [];
  for (let at = 0; at <= 450; at++) path = extended(path, [at / 10, 0, 0], at);
  assert.deepEqual(path.map((piece) => piece.length), [200, 200, 53]);
  assert.deepEqual(path[1]![0], path[0]!.at(-1));
  assert.equal(path.flat().length - path.length + 1, 451);
  assert.equal(extended(path, [45, 0.001, 1], 451), path);
});

test("a run that goes back shortens its path", () => {
  let path: Path = [];
  for (let at = 0; at <= 250; at++) path = extended(path, [at / 10, 0, 0], at);
  const back = extended(path, [10, 0, 0], 100);
  assert.equal(back.length, 1);
  assert.deepEqual(back[0]!.at(-1), [10, 0, 100]);
  assert.deepEqual(extended(path, [3, 4, 0], 0), [[[3, 4, 0]]]);
});

test("between two poses the robot turns in the shorter direction", () => {
  const [x, y, heading] = between([0, 0, 3], [1, 2, -3], 0.5);
  near(x, 0.5);
  near(y, 1);
  near(Math.cos(heading), -1);
});

test("a motion continues from the shown pose until the next pose, and ends", () => {
  const first = towards(null, [0, 0, 0], 1000, false);
  assert.deepEqual(shown(first, 1000), [0, 0, 0]);
  const second = towards(first, [1, 0, 0], 1050, false);
  near(shown(second, 1075)[0], 0.5);
  const third = towards(second, [1, 1, 0], 1075, false);
  near(shown(third, 1075)[0], 0.5);
  assert.deepEqual(shown(third, 1100), [1, 1, 0]);
  assert.equal(towards(third, [0, 0, 0], 9000, false).end, 9120);
  assert.deepEqual(shown(towards(second, [5, 5, 0], 1060, true), 1060), [5, 5, 0]);
});

test("a dragged object follows the pointer or turns around its middle", () => {
  assert.deepEqual(dragged([1, 2, 0.5], [1, 2], [1.5, 1], false), [1.5, 1, 0.5]);
  const [x, y, heading] = dragged([1, 2, 0], [2, 2], [1, 3], true);
  assert.deepEqual([x, y], [1, 2]);
  near(heading, Math.PI / 2);
  assert.deepEqual(nudged([1, 2, 0], "ArrowUp", false), [1, 2.05, 0]);
  near(nudged([1, 2, 0], "ArrowLeft", true)![2], Math.PI / 12);
  assert.equal(nudged([1, 2, 0], "a", false), null);
});

test("an object is placed with its middle at a pose, and the pose is read back", () => {
  const square: Point[] = [[1, 0], [2, 0], [2, 1], [1, 1]];
  const [x, y, turn] = poseOf(put(square, [5, 6, 0.7]), square);
  near(x, 5);
  near(y, 6);
  near(turn, 0.7);
});

test("objects are at the user's places before a run and at the run's places during it", () => {
  const one = world({ things: [thing([[1, 0], [2, 0], [2, 1], [1, 1]])] });
  const shapes = [{ shape: "can", outline: BODY }];
  const before = seen(one, null, { "0 box": [0, 0, 0] }, [{ shape: "can", at: [3, 3, 0] }], shapes);
  assert.deepEqual(before[0]!.outline, [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]);
  assert.deepEqual(before.map(({ id, movable }) => [id, movable]), [["0 box", false], ["drop 0", true]]);
  const during = seen(one, [{ id: "0 box", outline: BODY }, { id: "1 can 1", outline: BODY }], {}, [], shapes);
  assert.deepEqual(during.map(({ id, outline }) => [id, outline === BODY]), [["0 box", true], ["1 can 1", true]]);
});

test("a first start faces free floor, at the world's own heading if that is free", () => {
  const square = (x: number, y: number, half: number): Point[] => [[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]];
  const thing = (id: string, outline: Point[]) => ({ id, name: id, outline, low: false, movable: false, labelled: false, path: [] });
  const world = (...things: ReturnType<typeof thing>[]) => ({ start: [0, 0, 0] as const, body: square(0, 0, 0.15), things: [thing("room", square(0, 0, 2.5)), ...things], patches: [], lights: [] });
  const heading = (...things: ReturnType<typeof thing>[]): number => freeStart(world(...things))[2];
  assert.equal(heading(), 0);
  assert.equal(heading(thing("step", square(1, 0, 0.15))), Math.PI / 2);
  assert.equal(heading(thing("step", square(1, 0, 0.15)), thing("table", square(0, 1, 0.3))), -Math.PI / 2);
  assert.equal(heading(thing("cell", square(0, 0, 0.5))), 0);
});
