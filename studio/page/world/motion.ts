// The robot between its last two poses: updates arrive twenty times a second, and every frame
// interpolates.
import type { Pose } from "./geometry";

/** Start and end pose, with their times on the page's clock in milliseconds. */
export interface Motion {
  from: Pose;
  to: Pose;
  begin: number;
  end: number;
}

/** Maximum duration of a motion, milliseconds; poses arrive more often. */
const LONGEST = 120;

/** Interpolates between poses; turns the shorter way. */
export function between(from: Pose, to: Pose, share: number): Pose {
  const turn = to[2] - from[2];
  const shorter = Math.atan2(Math.sin(turn), Math.cos(turn));
  return [from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share, from[2] + shorter * share];
}

/** The displayed pose at a moment. */
export function shown({ from, to, begin, end }: Motion, now: number): Pose {
  const share = end > begin ? Math.min(1, Math.max(0, (now - begin) / (end - begin))) : 1;
  return share < 1 ? between(from, to, share) : to;
}

/** The motion to a new pose: from the displayed one, over the time between the last two updates. */
export function towards(before: Motion | null, to: Pose, now: number, still: boolean): Motion {
  if (!before || still) return { from: to, to, begin: now, end: now };
  return { from: shown(before, now), to, begin: now, end: now + Math.min(LONGEST, now - before.begin) };
}
