// Pointers on the floor: drag the pressed object after the first pixels, turn it with Shift, drop
// it on release.
import { held, poseNow, putDown, reach, type Held } from "./hand";
import type { Pose } from "./geometry";
import type { Surroundings } from "./surroundings";

/** Pixels that distinguish a press from a drag. */
const DECIDES = 4;

/** The pose of a dragged object: moved with the pointer, or turned towards it. */
export function dragged(begun: Pose, from: readonly [number, number], to: readonly [number, number], turns: boolean): Pose {
  const [x, y, heading] = begun;
  if (!turns) return [x + to[0] - from[0], y + to[1] - from[1], heading];
  const turn = Math.atan2(to[1] - y, to[0] - x) - Math.atan2(from[1] - y, from[0] - x);
  const wanted = heading + turn;
  return [x, y, Math.atan2(Math.sin(wanted), Math.cos(wanted))];
}

/** The floor position under a pointer, metres. */
export function placeOn(floor: SVGGraphicsElement, event: { clientX: number; clientY: number }): readonly [number, number] {
  const matrix = floor.getScreenCTM()?.inverse();
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
  return [x, y];
}

/** Follows a pointer pressed on an object; `turning` if its rotation handle was pressed. */
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
/** Step of an arrow key: metres, and radians with `Shift`. */
const STEP = 0.05;
const TURN = Math.PI / 12;

/** The pose after a key; null for other keys. */
export function nudged([x, y, heading]: Pose, key: string, shift: boolean): Pose | null {
  const step = STEPS[key];
  if (!step) return null;
  return shift ? [x, y, heading - step[0] * TURN] : [x + step[0] * STEP, y + step[1] * STEP, heading];
}
