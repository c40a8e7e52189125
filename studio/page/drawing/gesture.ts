// Pointer gestures as a state machine: `(state, event) -> [state, effects]`. It is independent of
// the page; `pointer.ts` feeds it and performs the effects.
import type { Hit } from "./hit";
import type { Part, Point } from "./shapes";

export type Event =
  | { type: "down"; id: number; at: Point; hit: Hit | null; shift: boolean; middle: boolean; touch: boolean; selection: readonly string[] }
  | { type: "move"; id: number; at: Point; free: boolean }
  | { type: "up"; id: number; at: Point; free: boolean }
  /** A finger has rested on its place. */
  | { type: "rest"; id: number }
  /** `Escape`, or the pointer is lost. */
  | { type: "cancel" };

/** Points are in pixels of the pane. */
export type Effect =
  | { do: "click"; hit: Hit | null; at: Point; add: boolean }
  | { do: "menu"; hit: Hit | null; at: Point }
  | { do: "pan"; by: Point }
  | { do: "zoom"; factor: number; at: Point }
  | { do: "lift"; elements: readonly string[] }
  | { do: "drag"; by: Point; free: boolean; at: Point }
  | { do: "drop"; by: Point; free: boolean; at: Point }
  | { do: "putBack" }
  | { do: "box"; from: Point; to: Point }
  | { do: "boxed"; from: Point; to: Point }
  | { do: "unbox" }
  | { do: "draw"; from: Part; head: boolean }
  | { do: "lead"; at: Point }
  | { do: "connect"; at: Point }
  | { do: "undraw" };

interface Pressed {
  is: "pressed";
  id: number;
  at: Point;
  hit: Hit | null;
  shift: boolean;
  middle: boolean;
  touch: boolean;
  elements: readonly string[];
}

export type State =
  | { is: "idle" }
  | Pressed
  | { is: "panning"; id: number; last: Point }
  | { is: "moving"; id: number; from: Point }
  | { is: "boxing"; id: number; from: Point }
  | { is: "drawing"; id: number }
  | { is: "pinching"; fingers: readonly [Finger, Finger] };

interface Finger {
  id: number;
  at: Point;
}

export const IDLE: State = { is: "idle" };

/** Distance that turns a press into a drag, pixels. */
export const DECIDES = 4;
/** Time that turns a press of a finger into a rest, milliseconds. */
export const RESTS = 500;

const minus = ([ax, ay]: Point, [bx, by]: Point): Point => [ax - bx, ay - by];
const middle = ([ax, ay]: Point, [bx, by]: Point): Point => [(ax + bx) / 2, (ay + by) / 2];

export function next(state: State, event: Event): [State, Effect[]] {
  if (event.type === "cancel") return [IDLE, undone(state)];
  if (event.type === "down") return down(state, event);
  if (event.type === "rest") return rest(state, event.id);
  switch (state.is) {
    case "idle":
      return [state, []];
    case "pinching":
      return pinching(state.fingers, event);
    case "pressed":
      return event.id === state.id ? pressed(state, event) : [state, []];
    default:
      return event.id === state.id ? dragging(state, event) : [state, []];
  }
}

/** The effects that revert everything. */
function undone(state: State): Effect[] {
  if (state.is === "moving") return [{ do: "putBack" }];
  if (state.is === "boxing") return [{ do: "unbox" }];
  return state.is === "drawing" ? [{ do: "undraw" }] : [];
}

type Down = Extract<Event, { type: "down" }>;
type Later = Extract<Event, { type: "move" | "up" }>;

/** A resting finger opens the menu, and is ignored until it is lifted. */
function rest(state: State, id: number): [State, Effect[]] {
  if (state.is !== "pressed" || state.id !== id || !state.touch) return [state, []];
  return [IDLE, [{ do: "menu", hit: state.hit, at: state.at }]];
}

function down(state: State, event: Down): [State, Effect[]] {
  const { id, at, hit, shift, touch, selection } = event;
  if (state.is !== "idle") return second(state, event);
  const held = hit && "element" in hit && hit.on !== "exit" && hit.on !== "entry" ? hit.element : null;
  // Dragged items: the selection if it was pressed, otherwise only the element.
  const elements = held === null ? [] : selection.includes(held) ? selection : [held];
  return [{ is: "pressed", id, at, hit, shift, middle: event.middle, touch, elements }, []];
}

/** A second finger zooms. */
function second(state: State, event: Down): [State, Effect[]] {
  const first = state.is === "pressed" ? state.at : state.is === "panning" ? state.last : null;
  if (!event.touch || first === null || state.is === "idle" || state.is === "pinching") return [state, []];
  return [{ is: "pinching", fingers: [{ id: state.id, at: first }, { id: event.id, at: event.at }] }, undone(state)];
}

function pinching(fingers: readonly [Finger, Finger], event: Later): [State, Effect[]] {
  const [one, two] = fingers;
  const other = event.id === one.id ? two : event.id === two.id ? one : null;
  if (!other) return [{ is: "pinching", fingers }, []];
  // The remaining finger pans.
  if (event.type === "up") return [{ is: "panning", id: other.id, last: other.at }, []];
  const moved: readonly [Finger, Finger] = event.id === one.id ? [{ id: one.id, at: event.at }, two] : [one, { id: two.id, at: event.at }];
  const before = middle(one.at, two.at);
  const after = middle(moved[0].at, moved[1].at);
  const factor = Math.hypot(...minus(moved[0].at, moved[1].at)) / (Math.hypot(...minus(one.at, two.at)) || 1);
  return [{ is: "pinching", fingers: moved }, [{ do: "pan", by: minus(after, before) }, { do: "zoom", factor, at: after }]];
}

function pressed(state: Pressed, event: Later): [State, Effect[]] {
  const { id, at, hit } = state;
  if (event.type === "up") {
    return [IDLE, state.middle ? [] : [{ do: "click", hit, at: event.at, add: state.shift }]];
  }
  if (Math.hypot(...minus(event.at, at)) < DECIDES) return [state, []];
  const [begun, effects] = decided(state);
  const [after, more] = next(begun, event);
  return begun.is === "idle" ? [IDLE, []] : [after.is === "idle" ? { is: "panning", id, last: at } : after, [...effects, ...more]];
}

/** Whether the hit is a supervisor, which is drawn with its owner. */
const isInner = (hit: Hit): boolean => hit.on === "element" && hit.part.item !== hit.element;

/** The gesture of a press that has moved far enough. */
function decided(state: Pressed): [State, Effect[]] {
  const { id, at, hit } = state;
  const ground: [State, Effect[]] = state.shift ? [{ is: "boxing", id, from: at }, []] : [{ is: "panning", id, last: at }, []];
  if (state.middle || hit === null || hit.on === "edge") return state.middle ? [{ is: "panning", id, last: at }, []] : ground;
  if (hit.on === "exit" || hit.on === "head" || hit.on === "entry" || isInner(hit)) return [{ is: "drawing", id }, [{ do: "draw", from: hit.part, head: hit.on === "head" }]];
  return [{ is: "moving", id, from: at }, [{ do: "lift", elements: state.elements }]];
}

function dragging(state: Exclude<State, { is: "idle" } | Pressed | { is: "pinching" }>, event: Later): [State, Effect[]] {
  const over = event.type === "up";
  const { at, free } = event;
  switch (state.is) {
    case "panning":
      return [over ? IDLE : { ...state, last: at }, [{ do: "pan", by: minus(at, state.last) }]];
    case "moving":
      return [over ? IDLE : state, [{ do: over ? "drop" : "drag", by: minus(at, state.from), free, at }]];
    case "boxing":
      return [over ? IDLE : state, [{ do: over ? "boxed" : "box", from: state.from, to: at }]];
    case "drawing":
      return [over ? IDLE : state, [{ do: over ? "connect" : "lead", at }]];
  }
}
