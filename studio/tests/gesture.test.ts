// The drawing's state machines for pointers and arrow keys, without a page.
import assert from "node:assert/strict";
import { test } from "node:test";
import { pressed } from "../page/drawing/carry";
import { DECIDES, IDLE, next, type Effect, type Event, type State } from "../page/drawing/gesture";
import type { Hit } from "../page/drawing/hit";
import type { Point } from "../page/drawing/shapes";

const ELEMENT: Hit = { on: "element", part: { item: "P.go" }, element: "P.go" };
const EXIT: Hit = { on: "exit", part: { item: "P.go", part: { kind: "exit", name: "Done" } }, element: "P.go" };
const HEAD: Hit = { on: "head", part: { item: "P.go", part: { kind: "exit", name: "Done" } }, edge: "P.go!Done" };
const EDGE: Hit = { ...HEAD, on: "edge" };

const down = (hit: Hit | null, at: Point = [100, 100], more: Partial<Extract<Event, { type: "down" }>> = {}): Event => ({ type: "down", id: 1, at, hit, shift: false, middle: false, touch: false, selection: [], ...more });
const move = (at: Point, id = 1, free = false): Event => ({ type: "move", id, at, free });
const up = (at: Point, id = 1): Event => ({ type: "up", id, at, free: false });

/** The state and all effects after some events. */
function run(...events: Event[]): [State, Effect[]] {
  let state: State = IDLE;
  const all: Effect[] = [];
  for (const event of events) {
    const [after, effects] = next(state, event);
    state = after;
    all.push(...effects);
  }
  return [state, all];
}
const done = (effects: Effect[]): string[] => effects.map((effect) => effect.do);

test("a press that does not move is a click", () => {
  const [state, effects] = run(down(ELEMENT), move([102, 101]), up([102, 102]));
  assert.equal(state.is, "idle");
  assert.deepEqual(effects, [{ do: "click", hit: ELEMENT, at: [102, 102], add: false }]);
});

test("the first pixels select the gesture, and the motion before them is not lost", () => {
  const [state, effects] = run(down(ELEMENT), move([100 + DECIDES - 1, 100]));
  assert.deepEqual([state.is, effects], ["pressed", []]);
  const [moving, lifted] = run(down(ELEMENT), move([100 + DECIDES, 100]));
  assert.equal(moving.is, "moving");
  assert.deepEqual(lifted, [{ do: "lift", elements: ["P.go"] }, { do: "drag", by: [DECIDES, 0], free: false, at: [104, 100] }]);
});

test("a drag of a selected element moves the selection; a drag of another element moves only that element", () => {
  const [, all] = run(down(ELEMENT, [0, 0], { selection: ["P.go", "P.turn"] }), move([9, 0]));
  assert.deepEqual(all[0], { do: "lift", elements: ["P.go", "P.turn"] });
  const [, one] = run(down(ELEMENT, [0, 0], { selection: ["P.turn"] }), move([9, 0]));
  assert.deepEqual(one[0], { do: "lift", elements: ["P.go"] });
});

test("a drop happens once; Escape restores the positions without a drop", () => {
  const [state, effects] = run(down(ELEMENT), move([120, 100]), up([130, 90]));
  assert.equal(state.is, "idle");
  assert.deepEqual(effects.at(-1), { do: "drop", by: [30, -10], free: false, at: [130, 90] });
  const [after, undone] = run(down(ELEMENT), move([120, 100]), { type: "cancel" }, move([150, 100]), up([150, 100]));
  assert.equal(after.is, "idle");
  assert.deepEqual(done(undone), ["lift", "drag", "putBack"]);
});

test("the ground pans, with Shift it draws a box, with the middle button everything pans", () => {
  assert.deepEqual(done(run(down(null), move([110, 100]), up([120, 100]))[1]), ["pan", "pan"]);
  assert.deepEqual(run(down(null), move([110, 100]), up([120, 100]))[1], [{ do: "pan", by: [10, 0] }, { do: "pan", by: [10, 0] }]);
  assert.deepEqual(done(run(down(null, [0, 0], { shift: true }), move([30, 30]), up([40, 50]))[1]), ["box", "boxed"]);
  assert.deepEqual(done(run(down(null, [0, 0], { shift: true }), move([30, 30]), { type: "cancel" })[1]), ["box", "unbox"]);
  assert.deepEqual(done(run(down(ELEMENT, [0, 0], { middle: true }), move([30, 30]), up([40, 50]))[1]), ["pan", "pan"]);
  assert.deepEqual(done(run(down(EDGE), move([110, 100]))[1]), ["pan"]);
  // A middle click selects nothing.
  assert.deepEqual(run(down(ELEMENT, [0, 0], { middle: true }), up([0, 0]))[1], []);
});

test("an exit, an arrow's head and an entry draw a line; Escape sends nothing", () => {
  const entry: Hit = { on: "entry", part: { item: "P.gap" }, element: "P.start" };
  for (const [hit, head] of [[EXIT, false], [HEAD, true], [entry, false]] as const) {
    const [, effects] = run(down(hit), move([130, 100]), up([200, 200]));
    assert.deepEqual(effects, [{ do: "draw", from: hit.part, head }, { do: "lead", at: [130, 100] }, { do: "connect", at: [200, 200] }]);
  }
  assert.deepEqual(done(run(down(EXIT), move([130, 100]), { type: "cancel" }, up([200, 200]))[1]), ["draw", "lead", "undraw"]);
});

test("two fingers zoom around their middle and pan with it; one remaining finger continues", () => {
  const touch = { touch: true };
  const second: Event = { ...(down(null, [200, 100], touch) as Extract<Event, { type: "down" }>), id: 2 };
  const [state, effects] = run(down(null, [100, 100], touch), second, move([300, 100], 2));
  assert.equal(state.is, "pinching");
  assert.deepEqual(effects, [{ do: "pan", by: [50, 0] }, { do: "zoom", factor: 2, at: [200, 100] }]);
  const [after, more] = next(state, up([300, 100], 2));
  assert.deepEqual([after, more], [{ is: "panning", id: 1, last: [100, 100] }, []]);
});

test("an unknown pointer changes nothing", () => {
  const [state] = run(down(ELEMENT), move([120, 100]));
  assert.deepEqual(next(state, up([0, 0], 7)), [state, []]);
  assert.deepEqual(next(IDLE, move([5, 5])), [IDLE, []]);
});

test("a drag ends once for random events", () => {
  let seed = 20;
  const random = (below: number): number => ((seed = (seed * 1103515245 + 12345) & 0x7fffffff) >> 8) % below;
  let state: State = IDLE;
  let open = 0;
  for (let round = 0; round < 20_000; round++) {
    const at: Point = [random(60), random(60)];
    const hits = [null, ELEMENT, EXIT, HEAD, EDGE];
    const events: Event[] = [down(hits[random(5)]!, at, { id: 1 + random(2), touch: random(2) === 0, shift: random(3) === 0 }), move(at, 1 + random(2)), up(at, 1 + random(2)), { type: "cancel" }];
    const [after, effects] = next(state, events[random(4)]!);
    state = after;
    for (const effect of effects) {
      if (effect.do === "lift" || effect.do === "draw") open += 1;
      if (effect.do === "drop" || effect.do === "putBack" || effect.do === "connect" || effect.do === "undraw") open -= 1;
      assert.ok(open === 0 || open === 1, `${effect.do} in round ${round}`);
    }
    assert.equal(open === 1, state.is === "moving" || state.is === "drawing");
  }
});

test("arrow keys move the selection, Shift moves it farther, Enter drops it and Escape restores it", () => {
  const start = { elements: ["P.go"], by: [0, 0] as Point };
  const [one] = pressed(start, { key: "ArrowRight", shiftKey: false })!;
  assert.deepEqual(one!.by, [12, 0]);
  const [two] = pressed(one!, { key: "ArrowUp", shiftKey: true })!;
  assert.deepEqual(two!.by, [12, -60]);
  assert.deepEqual(pressed(two!, { key: "Enter", shiftKey: false }), [null, { do: "drop", by: [12, -60] }]);
  assert.deepEqual(pressed(two!, { key: "Escape", shiftKey: false }), [null, { do: "putBack" }]);
  assert.equal(pressed(two!, { key: "a", shiftKey: false }), null);
});

test("only a resting finger opens the menu, and then does nothing else", () => {
  const [state, effects] = run(down(ELEMENT, [100, 100], { touch: true }), { type: "rest", id: 1 }, move([160, 100]), up([160, 100]));
  assert.equal(state.is, "idle");
  assert.deepEqual(effects, [{ do: "menu", hit: ELEMENT, at: [100, 100] }]);
  const [, panned] = run(down(null, [100, 100], { touch: true }), move([160, 100]), { type: "rest", id: 1 });
  assert.deepEqual(done(panned), ["pan"]);
  const [pressed, none] = run(down(ELEMENT), { type: "rest", id: 1 });
  assert.deepEqual([pressed.is, none], ["pressed", []]);
});

test("a drag moves a supervisor to another element, and its element to another place", () => {
  const touch: Hit = { on: "element", part: { item: "P.go.touch" }, element: "P.go" };
  const [, drawn] = run(down(touch), move([160, 100]), up([200, 100]));
  assert.deepEqual(done(drawn), ["draw", "lead", "connect"]);
  const [, moved] = run(down(ELEMENT), move([160, 100]), up([200, 100]));
  assert.deepEqual(done(moved), ["lift", "drag", "drop"]);
});

test("in selection mode, a finger draws a box and a tap adds an element", () => {
  const [, boxed] = run(down(null, [100, 100], { touch: true, shift: true }), move([160, 100]), up([200, 100]));
  assert.deepEqual(done(boxed), ["box", "boxed"]);
  const [, tapped] = run(down(ELEMENT, [100, 100], { touch: true, shift: true }), up([100, 100]));
  assert.deepEqual(tapped, [{ do: "click", hit: ELEMENT, at: [100, 100], add: true }]);
});
