// A control of the robot under a finger: pressed as long as it is held, and long enough that a plan notices a short press.
import { effect } from "@preact/signals";
import { active, order, state } from "../debug/run";

/** Seconds of the run that a press lasts at least. */
const HOLD = 0.2;

/** Presses and lets go by itself. */
export const tap = (control: string): void => void order("afp/press", { control });

/** Presses; the answer lets go. */
export function press(control: string): () => void {
  const begun = state.peek()?.at ?? 0;
  void order("afp/press", { control, held: true });
  let over = false;
  return () => {
    if (over) return;
    over = true;
    const waits = effect(() => {
      // A run that is over holds nothing.
      const long = (state.value?.at ?? 0) >= begun + HOLD;
      if (active.value && !long) return;
      if (active.value) void order("afp/press", { control, held: false });
      queueMicrotask(() => waits());
    });
  };
}
