// The robot between its last two poses: updates come twenty times a second, and every frame
// interpolates.
import type { Pose } from "./geometry";

/** From where to where, and between which moments of the page's clock, milliseconds. */
export interface Motion {
  from: Pose;
  to: Pose;
  begin: number;
  end: number;
}

/** Milliseconds that a motion takes at most; poses come more often. */
const LONGEST = 120;

/** A pose on the way from one to another; it turns the shorter way. */
export function between(from: Pose, to: Pose, share: number): Pose {
  const turn = to[2] - from[2];
  const shorter = Math.atan2(Math.sin(turn), Math.cos(turn));
  return [from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share, from[2] + shorter * share];
}

/** Where the robot is shown at a moment. */
export function shown({ from, to, begin, end }: Motion, now: number): Pose {
  const share = end > begin ? Math.min(1, Math.max(0, (now - begin) / (end - begin))) : 1;
  return share < 1 ? between(from, to, share) : to;
}

/** The motion to a new pose: from the displayed one, over the time between the last two updates. */
export function towards(before: Motion | null, to: Pose, now: number, still: boolean): Motion {
  if (!before || still) return { from: to, to, begin: now, end: now };
  return { from: shown(before, now), to, begin: now, end: now + Math.min(LONGEST, now - before.begin) };
}
