// What the robot's sensors say in the run that is shown, as the debugger tells it some twenty times a second.
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

/** What they say and when, in seconds of the run; null while nothing runs. */
export const sensed = signal<{ at: number; sensed: readonly Sensed[] } | null>(null);
