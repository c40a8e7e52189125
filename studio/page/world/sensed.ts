// Sensor values in the displayed run, sent about twenty times a second.
import { signal } from "@preact/signals";
import type { Plotted } from "../debug/told";
import type { Pose } from "./geometry";

export interface Sensed {
  /** Device and signal name. */
  signal: string;
  /** Formatted with a unit. */
  text: string;
  /** Null for another value than a number. */
  plotted: Plotted | null;
  /**
   * A range sensor's pose, half its opening in radians, and the range in metres; null without an
   * echo.
   */
  cone: { pose: Pose; half: number; range: number | null } | null;
}

/** The values and their time, in seconds of the run; null without a run. */
export const sensed = signal<{ at: number; sensed: readonly Sensed[] } | null>(null);
