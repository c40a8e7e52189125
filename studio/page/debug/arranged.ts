// Initial poses set by hand, for the next run.
import { signal } from "@preact/signals";
import type { Pose } from "../world/geometry";

/** Poses by id. */
export type Moves = Readonly<Record<string, Pose>>;

/** Start of the robot; null for the world's start. */
export const start = signal<Pose | null>(null);
export const things = signal<Moves>({});
export const drops = signal<readonly { shape: string; at: Pose }[]>([]);

/** Resets all poses to the world's. */
export function putBack(): void {
  [start.value, things.value, drops.value] = [null, {}, []];
}

/** Requests that a run needs before its first step. */
export const requests = (): { command: string; args: object }[] => [
  ...Object.entries(things.peek()).map(([thing, to]) => ({ command: "afp/move", args: { thing, to } })),
  ...drops.peek().map(({ shape, at }) => ({ command: "afp/drop", args: { shape, to: at } })),
];
