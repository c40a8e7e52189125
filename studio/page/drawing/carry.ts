// Moving the selection with keys, as a state machine: arrows move, `Enter` drops, `Escape` reverts.
import type { Point } from "./shapes";

export interface Carrying {
  elements: readonly string[];
  by: Point;
}

export type Outcome = { do: "carry"; by: Point } | { do: "drop"; by: Point } | { do: "putBack" };

/** Distance of an arrow key, and with `Shift`, in units of the plan. */
const STEPS = { fine: 12, far: 60 };

const ARROWS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** The next state and its effect; null for other keys. */
export function pressed(state: Carrying, key: { key: string; shiftKey: boolean }): [Carrying | null, Outcome] | null {
  const arrow = ARROWS[key.key];
  if (arrow) {
    const step = key.shiftKey ? STEPS.far : STEPS.fine;
    const by: Point = [state.by[0] + arrow[0] * step, state.by[1] + arrow[1] * step];
    return [{ ...state, by }, { do: "carry", by }];
  }
  if (key.key === "Enter") return [null, { do: "drop", by: state.by }];
  return key.key === "Escape" ? [null, { do: "putBack" }] : null;
}
