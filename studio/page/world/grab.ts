// A pointer on the floor: it drags the pressed thing after the first pixels, turns it with Shift,
// and drops it on release.
import { held, poseNow, putDown, reach, type Held } from "./hand";
import type { Pose } from "./geometry";
import type { Surroundings } from "./surroundings";

/** Pixels that decide between a press and a drag. */
const DECIDES = 4;

/** Where something is while it is dragged: moved with the pointer, or turned around itself towards it. */
export function dragged(begun: Pose, from: readonly [number, number], to: readonly [number, number], turns: boolean): Pose {
  const [x, y, heading] = begun;
  if (!turns) return [x + to[0] - from[0], y + to[1] - from[1], heading];
  const turn = Math.atan2(to[1] - y, to[0] - x) - Math.atan2(from[1] - y, from[0] - x);
  const wanted = heading + turn;
  return [x, y, Math.atan2(Math.sin(wanted), Math.cos(wanted))];
}

/** The place of the floor under a pointer, metres. */
export function placeOn(floor: SVGGraphicsElement, event: { clientX: number; clientY: number }): readonly [number, number] {
  const matrix = floor.getScreenCTM()?.inverse();
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
  return [x, y];
}

/** Follows a pointer that was pressed on something; `turning` where it was pressed on the handle for that. */
export function grab(event: PointerEvent, what: Held, world: Surroundings, turning = false): void {
  if (event.button !== 0) return;
  const target = event.currentTarget as SVGGraphicsElement;
  const floor = target.ownerSVGElement!.querySelector<SVGGraphicsElement>(".metres")!;
  const [left, top] = [event.clientX, event.clientY];
  const from = placeOn(floor, event);
  reach();
  const begun = poseNow(what, world);
  target.setPointerCapture(event.pointerId);
  const move = (moved: PointerEvent): void => {
    if (!held.peek() && Math.hypot(moved.clientX - left, moved.clientY - top) < DECIDES) return;
    held.value = { what, at: dragged(begun, from, placeOn(floor, moved), turning || moved.shiftKey) };
  };
  const end = (put: boolean): void => {
    target.removeEventListener("pointermove", move);
    document.removeEventListener("keydown", cancel, true);
    const last = held.peek();
    held.value = null;
    if (put && last) putDown(what, last.at);
  };
  const cancel = (key: KeyboardEvent): void => {
    if (key.key !== "Escape") return;
    key.stopPropagation();
    end(false);
  };
  target.addEventListener("pointermove", move);
  target.addEventListener("pointerup", () => end(true), { once: true });
  target.addEventListener("pointercancel", () => end(false), { once: true });
  document.addEventListener("keydown", cancel, true);
}

const STEPS: Record<string, readonly [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
/** Metres, and radians with `Shift`, of one press of an arrow. */
const STEP = 0.05;
const TURN = Math.PI / 12;

/** Where a key puts something; null for a key that means nothing here. */
export function nudged([x, y, heading]: Pose, key: string, shift: boolean): Pose | null {
  const step = STEPS[key];
  if (!step) return null;
  return shift ? [x, y, heading - step[0] * TURN] : [x + step[0] * STEP, y + step[1] * STEP, heading];
}
