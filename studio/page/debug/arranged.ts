// Places that differ from the world's in the next run, set by hand.
import { signal } from "@preact/signals";
import type { Pose } from "../world/geometry";

/** Where things are put, by their ids. */
export type Moves = Readonly<Record<string, Pose>>;

/** Where the robot starts; null leaves it to the world. */
export const start = signal<Pose | null>(null);
export const things = signal<Moves>({});
export const drops = signal<readonly { shape: string; at: Pose }[]>([]);

/** Resets all places to the world's. */
export function putBack(): void {
  [start.value, things.value, drops.value] = [null, {}, []];
}

/** The requests of a run before its first step. */
export const requests = (): { command: string; args: object }[] => [
  ...Object.entries(things.peek()).map(([thing, to]) => ({ command: "afp/move", args: { thing, to } })),
  ...drops.peek().map(({ shape, at }) => ({ command: "afp/drop", args: { shape, to: at } })),
];
