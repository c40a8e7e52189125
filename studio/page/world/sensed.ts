// The robot's sensor values in the displayed run, sent by the debugger some twenty times a second.
import { signal } from "@preact/signals";
import type { Pose } from "./geometry";

export interface Sensed {
  /** Its device and its name. */
  signal: string;
  /** As people write it. */
  text: string;
  /** Where a range sensor looks, half its opening in radians, and metres to what it heard; null where no echo came back. */
  cone: { pose: Pose; half: number; range: number | null } | null;
}

/** The values and their time, in seconds of the run; null without a run. */
export const sensed = signal<{ at: number; sensed: readonly Sensed[] } | null>(null);
