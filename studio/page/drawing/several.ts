// Multiple selection by touch: while on, taps add to the selection and dragging the ground draws a
// box.
import { signal } from "@preact/signals";
import { say } from "./say";
import { words } from "./words";

export const several = signal(false);

export function toggle(on = !several.peek()): void {
  several.value = on;
  say(on ? words.severalOn : words.severalOff);
}
