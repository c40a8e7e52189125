// What stands elsewhere in the next run than its world says: put there by hand before it.
import { signal } from "@preact/signals";
import type { Pose } from "../world/geometry";

/** Where things are put, by their ids. */
export type Moves = Readonly<Record<string, Pose>>;

/** Where the robot starts; null leaves it to the world. */
export const start = signal<Pose | null>(null);
export const things = signal<Moves>({});
export const drops = signal<readonly { shape: string; at: Pose }[]>([]);

/** Everything stands again where the world says. */
export function putBack(): void {
  [start.value, things.value, drops.value] = [null, {}, []];
}

/** What a run is asked for before its first step. */
export const requests = (): { command: string; args: object }[] => [
  ...Object.entries(things.peek()).map(([thing, to]) => ({ command: "afp/move", args: { thing, to } })),
  ...drops.peek().map(({ shape, at }) => ({ command: "afp/drop", args: { shape, to: at } })),
];
