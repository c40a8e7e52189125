// Moving the robot and objects, and dropping new ones. During a run the world is changed
// immediately; before a run the change is kept for the next one.
import { computed, signal } from "@preact/signals";
import { active, dismiss, order, phase, state } from "../debug/run";
import { drops, start, things, type Moves } from "../debug/arranged";
import { middle, placed, type Point, type Pose, type Thing, type World } from "./geometry";
import * as room from "./room";
import { surroundings, type Surroundings } from "./surroundings";

/** The robot, or an object by id. */
export type Held = "robot" | { id: string };

/** The dragged object, and its new place. */
export const held = signal<{ what: Held; at: Pose } | null>(null);

/** An outline moved to a pose, with a rotation. */
export function put(outline: readonly Point[], to: Pose): Point[] {
  const [x, y] = middle(outline);
  return placed(outline.map(([u, v]) => [u - x, v - y]), to);
}

/** The pose of an outline relative to an earlier one of the same object. */
export function poseOf(now: readonly Point[], before: readonly Point[]): Pose {
  const angle = ([a, b]: readonly Point[]): number => (a && b ? Math.atan2(b[1] - a[1], b[0] - a[0]) : 0);
  const turn = angle(now) - angle(before);
  return [...middle(now), Math.atan2(Math.sin(turn), Math.cos(turn))];
}

/** Objects of a world: at their places in the run, or before it at those set by hand. */
export function seen(world: World, moving: readonly { id: string; outline: readonly Point[] }[] | null, moves: Moves, dropped: readonly { shape: string; at: Pose }[], shapes: readonly { shape: string; outline: readonly Point[] }[]): Thing[] {
  if (moving) {
    const now = new Map(moving.map(({ id, outline }) => [id, outline]));
    const known = world.things.map((thing) => ({ ...thing, outline: now.get(thing.id) ?? thing.outline }));
    const ids = new Set(world.things.map(({ id }) => id));
    const fresh = moving.filter(({ id }) => !ids.has(id));
    return [...known, ...fresh.map(({ id, outline }) => ({ id, name: id, outline, low: false, movable: true, path: [], labelled: false }))];
  }
  const known = world.things.map((thing) => (moves[thing.id] ? { ...thing, outline: put(thing.outline, moves[thing.id]!) } : thing));
  const fresh = dropped.flatMap(({ shape, at }, number) => {
    const outline = shapes.find((one) => one.shape === shape)?.outline;
    return outline ? [{ id: dropId(number), name: shape, outline: placed(outline, at), low: false, movable: true, path: [], labelled: false }] : [];
  });
  return [...known, ...fresh];
}

const DROP = "drop ";
const dropId = (number: number): string => `${DROP}${number}`;
const numberOf = (id: string): number => (id.startsWith(DROP) ? Number(id.slice(DROP.length)) : -1);

/** The current objects of the world. */
export const standing = computed<readonly Thing[]>(() => {
  const world = surroundings.value;
  return world ? seen(world, state.value?.moving ?? null, things.value, drops.value, world.drops) : [];
});

/** The robot's current pose. */
export const robotAt = (world: World): Pose => state.value?.pose ?? start.value ?? world.start;

/** Whether a pose differs from the world's. */
export const arranged = computed(() => start.value !== null || drops.value.length > 0 || Object.keys(things.value).length > 0);

/** The outline of an object without a rotation by hand. */
function straight(id: string, world: Surroundings): readonly Point[] {
  const known = world.things.find((thing) => thing.id === id)?.outline;
  const shape = state.peek() ? undefined : drops.peek()[numberOf(id)]?.shape;
  const dropped = world.drops.find((one) => one.shape === shape)?.outline;
  return known ?? dropped ?? standing.peek().find((thing) => thing.id === id)?.outline ?? [];
}

export function poseNow(what: Held, world: Surroundings): Pose {
  if (what === "robot") return robotAt(world);
  const now = standing.peek().find(({ id }) => id === what.id);
  return now ? poseOf(now.outline, straight(what.id, world)) : [0, 0, 0];
}

/** The preview outline of the dragged object. */
export const ghost = ({ what, at }: { what: Held; at: Pose }, world: Surroundings): Point[] =>
  what === "robot" ? placed(world.body, at) : put(straight(what.id, world), at);

/** Closes a recorded run when the user moves an object in its world. */
export function reach(): void {
  if (phase.peek() === "over") dismiss();
}

/** Drops the dragged object. */
export function putDown(what: Held, at: Pose): void {
  if (room.tool.peek()) room.put(what, at);
  else if (active.peek()) void order("afp/move", { ...(what === "robot" ? {} : { thing: what.id }), to: at });
  else if (what === "robot") start.value = at;
  else if (numberOf(what.id) >= 0) drops.value = drops.peek().map((one, number) => (dropId(number) === what.id ? { ...one, at } : one));
  else things.value = { ...things.peek(), [what.id]: at };
}

/** Drops a new object. */
export function drop(shape: string, [x, y]: Point): void {
  reach();
  const at: Pose = [x, y, 0];
  if (active.peek()) void order("afp/drop", { shape, to: at });
  else drops.value = [...drops.peek(), { shape, at }];
}

/** Removes an object that was dropped before a run. */
export function takeAway(what: Held): void {
  if (room.tool.peek()) return room.remove(what);
  if (active.peek() || what === "robot") return;
  drops.value = drops.peek().filter((_, number) => dropId(number) !== what.id);
}
