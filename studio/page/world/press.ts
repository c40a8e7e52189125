// Controls of the robot: a press lasts while the pointer holds it, and at least until the plan has polled it.
import { effect } from "@preact/signals";
import { active, order, state } from "../debug/run";

/** Minimum duration of a press, seconds of the run. */
const HOLD = 0.2;

/** Presses and releases. */
export const tap = (control: string): void => void order("afp/press", { control });

/** Presses; returns a function that releases. */
export function press(control: string): () => void {
  const begun = state.peek()?.at ?? 0;
  void order("afp/press", { control, held: true });
  let over = false;
  return () => {
    if (over) return;
    over = true;
    const waits = effect(() => {
      // A finished run holds nothing.
      const long = (state.value?.at ?? 0) >= begun + HOLD;
      if (active.value && !long) return;
      if (active.value) void order("afp/press", { control, held: false });
      queueMicrotask(() => waits());
    });
  };
}
