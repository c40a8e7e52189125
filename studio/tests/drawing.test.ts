// Drawings as values: differences, hits, keyboard navigation, bent edges, views, values, lists.
import assert from "node:assert/strict";
import { test } from "node:test";
import { bent, road } from "../page/drawing/bend";
import { filtered } from "../page/drawing/choose";
import { calledNow, changed, itemsNow, whole } from "../page/drawing/differences";
import { hit } from "../page/drawing/hit";
import { movable, places, snapped } from "../page/drawing/lift";
import { home, step } from "../page/drawing/navigate";
import { added, between, freeName } from "../page/drawing/offers";
import { spoken } from "../page/drawing/say";
import { rectOf } from "../page/drawing/shapes";
import type { Answer, Drawing, Edge, Element, Point, Rect } from "../page/drawing/shapes";
import { first, fitted, shown, toPane, toPlan, zoomed } from "../page/drawing/view";

const piece = (item: string, kind: string, rect: Rect, name = "") => ({ item, part: { kind, name, nth: 1 }, rect, severity: null, tag: null });
const element = (item: string, [x, y]: Point): Element => ({
  item, rect: [x, y, 120, 60], outer: [x, y, 240, 70], svg: "", kind: "actor", template: "Forward", plan: null, file: null, help: "", note: "",
  pieces: [piece(item, "whole", [x, y, 120, 60]), piece(item, "exit", [x + 20, y + 51, 80, 18], "Done"), piece(`${item}.touch`, "whole", [x + 120, y, 120, 44])],
});
const edge = (from: string, to: string, points: Point[]): Edge => ({ id: `${from}!Done`, from, to, points, kind: "state", part: { kind: "exit", name: "Done", nth: 1 }, svg: "", severity: null });

/** One element above, two side by side below. */
function example(): Drawing {
  const answer: Answer = {
    version: 1, plan: "P", plans: ["P", "Q"], bounds: [0, 0, 600, 400], entries: [], symbols: [],
    elements: [element("P.a", [100, 0]), element("P.b", [100, 200]), element("P.c", [400, 200]), { ...element("P.start", [400, 0]), kind: null, pieces: [piece("P", "whole", [400, 0, 120, 60])] }],
    edges: [edge("P.a", "P.b", [[160, 69], [160, 200]]), edge("P.b", "P.c", [[160, 269], [160, 300], [380, 300], [380, 180], [460, 180], [460, 200]])],
  };
  return whole("file:///p.afp", answer);
}

test("a difference replaces only its named parts", () => {
  const before = example();
  const moved = element("P.b", [112, 212]);
  const after = changed(before, {
    textDocument: { uri: before.uri }, version: 2, plan: "P", plans: ["P"], bounds: null, entries: null, symbols: [], elements: [moved], edges: [], gone: ["P.c", "P.b!Done"],
  });
  assert.deepEqual([...after.elements.keys()], ["P.a", "P.b", "P.start"]);
  assert.deepEqual([...after.edges.keys()], ["P.a!Done"]);
  assert.equal(after.elements.get("P.a"), before.elements.get("P.a"));
  assert.equal(after.elements.get("P.b"), moved);
  assert.equal(before.elements.size, 4);
});

test("a renamed plan is identified by its place", () => {
  const called = (name: string, ...now: string[]) => calledNow(name, ["A", "B", "C"], now);
  assert.deepEqual([called("B", "A", "B", "C"), called("B", "B"), called("B", "A", "X", "C")], ["B", "B", "X"]);
  assert.deepEqual([called("B", "A", "C"), called("B", "B2", "C", "A"), called("B", "A", "C", "D")], [null, null, null]);
  // Folded items follow a renamed plan, and stay for a removed one.
  assert.deepEqual(itemsNow(["A.go", "B.start"], ["A", "B"], ["A", "C"]), ["A.go", "C.start"]);
  assert.deepEqual(itemsNow(["A.go", "B.start"], ["A", "B"], ["A"]), ["A.go", "B.start"]);
});

test("the part under a point: exits before boxes, supervisors, edges, heads, ground", () => {
  const drawn = example();
  const at = (x: number, y: number): string | undefined => hit(drawn, [x, y], 1)?.on;
  assert.equal(at(110, 10), "element");
  assert.equal(at(160, 60), "exit");
  assert.equal(hit(drawn, [300, 20], 1)?.part.item, "P.a.touch");
  assert.equal(at(450, 20), "start");
  assert.equal(at(163, 120), "edge");
  assert.equal(at(160, 192), "head");
  assert.equal(at(300, 130), undefined);
  // At a smaller zoom, an edge is as easy to press.
  assert.equal(hit(drawn, [172, 120], 1), null);
  assert.equal(hit(drawn, [172, 120], 0.4)?.on, "edge");
});

test("arrow keys lead along exits, back, and to neighbours", () => {
  const drawn = example();
  assert.deepEqual(step(drawn, { item: "P.a" }, "down"), { item: "P.b" });
  assert.deepEqual(step(drawn, { item: "P.b" }, "up"), { item: "P.a" });
  assert.deepEqual(step(drawn, { item: "P.b" }, "right"), { item: "P.b.touch" });
  assert.deepEqual(step(drawn, { item: "P.b.touch" }, "right"), { item: "P.c" });
  assert.deepEqual(step(drawn, { item: "P.b.touch" }, "left"), { item: "P.b" });
  assert.deepEqual(step(drawn, { item: "P.b", part: { kind: "exit", name: "Done" } }, "up"), { item: "P.b" });
  assert.deepEqual(step(drawn, { item: "P.c" }, "left"), { item: "P.b" });
  assert.deepEqual(step(drawn, { item: "P.a", part: { kind: "exit", name: "Done" } }, "down"), { item: "P.b" });
  assert.deepEqual(home(drawn), { item: "P" });
});

test("a part that is not drawn has no place", () => {
  const drawn = example();
  assert.deepEqual(rectOf(drawn, { item: "P.a.touch" }), [220, 0, 120, 44]);
  assert.deepEqual(rectOf(drawn, { item: "P.a", part: { kind: "input", name: "distance" } }), [100, 0, 120, 60]);
  assert.equal(rectOf(drawn, { item: "P.a.lane" }), null);
  assert.equal(rectOf(drawn, { item: "P.d" }), null);
});

test("parts have names for screen readers", () => {
  const drawn = example();
  assert.equal(spoken(drawn, { item: "P.a" }), "actor a, Forward, 1 supervisor, 1 exit");
  assert.equal(spoken(drawn, { item: "P.a", part: { kind: "exit", name: "Done" } }), "exit Done of a, leads to b");
  assert.equal(spoken(drawn, { item: "P.a.touch" }), "supervisor touch");
  assert.equal(spoken(drawn, { item: "P" }), "plan P, 3 elements");
});

test("a bent edge keeps its right corners and its other end", () => {
  const upright = ([ax, ay]: Point, [bx, by]: Point): boolean => ax === bx || ay === by;
  const cases: Point[][] = [
    [[0, 0], [0, 100]],
    [[0, 0], [0, 50], [80, 50], [80, 100]],
    [[0, 0], [0, 50], [80, 50]],
    [[0, 0], [40, 0], [40, 90], [10, 90], [10, 120]],
  ];
  for (const points of cases) {
    for (const [start, end] of [[[7, 9], [0, 0]], [[0, 0], [-13, 5]], [[7, 9], [7, 9]]] as [Point, Point][]) {
      const found = bent(points, start, end);
      const [first, last] = [points[0]!, points.at(-1)!];
      assert.deepEqual(found[0], [first[0] + start[0], first[1] + start[1]]);
      assert.deepEqual(found.at(-1), [last[0] + end[0], last[1] + end[1]]);
      for (let i = 1; i < found.length; i++) assert.ok(upright(found[i - 1]!, found[i]!), JSON.stringify(found));
    }
  }
  assert.deepEqual(bent(cases[0]!, [0, 0], [0, 0]), cases[0]);
});

test("the line of an edge ends at its arrow's neck, and the arrow's tip at the end", () => {
  const { line, tip } = road([[0, 0], [0, 50], [80, 50]]);
  assert.equal(line, "M0 0L0 43Q0 50 7 50L71 50");
  assert.ok(tip.startsWith("M80 50L70 "));
});

test("dragged elements keep to the grid, with the first element's corner on it", () => {
  const drawn = example();
  assert.deepEqual(snapped(drawn, ["P.a", "P.b"], [5, 5], false), [8, 0]);
  assert.deepEqual(snapped(drawn, ["P.a"], [5.4, 5], true), [5, 5]);
  assert.deepEqual(places(drawn, ["P.a", "P.b"], [8, 12]), { "P.a": [108, 12], "P.b": [108, 212] });
  assert.deepEqual(movable(drawn, ["P.a.touch", "P.a", "P"]), ["P.a", "P.start"]);
});

test("zooming keeps the point under the pointer, fitting shows everything, showing moves as little as possible", () => {
  const view = { x: 30, y: -20, zoom: 0.7 };
  const at: Point = [200, 100];
  assert.deepEqual(toPlan(zoomed(view, 1.5, at), at).map(Math.round), toPlan(view, at).map(Math.round));
  const size = { width: 500, height: 300 };
  const rect: Rect = [-50, 20, 900, 400];
  const fit = fitted(rect, size);
  const [left, top] = toPane(fit, [rect[0], rect[1]]);
  const [right, bottom] = toPane(fit, [rect[0] + rect[2], rect[1] + rect[3]]);
  assert.ok(left >= 0 && top >= 0 && right <= 500 && bottom <= 300);
  assert.equal(shown({ x: 0, y: 0, zoom: 1 }, [100, 100, 50, 50], size).x, 0);
  assert.equal(shown({ x: 0, y: 0, zoom: 1 }, [500, 100, 50, 50], size).x, -74);
});

test("templates become changes, and an element dropped between two others is connected", () => {
  const offer = { template: "Wait", name: "wait", kind: "actor" as const, toolbox: "std", icon: null, help: "", ports: [], exits: ["Elapsed"], missingUse: "std" };
  assert.equal(freeName(offer), "wait");
  assert.equal(freeName(offer, new Set(["wait", "wait2"])), "wait3");
  const from = { item: "P.a", part: { kind: "exit", name: "Done" } };
  assert.deepEqual(added("P", null, offer, from), [
    { addUse: { toolbox: "std" } },
    { addComponent: { plan: "P", owner: null, keyword: "actor", name: "wait", template: "Wait" } },
    { connect: { from: "P.a", outcome: "Done", to: "wait" } },
  ]);
  assert.deepEqual(between("P", offer, edge("P.a", "P.b", [])).at(-1), { connect: { from: "P.wait", outcome: "Elapsed", to: "b" } });
});

test("the first view of a plan includes its start, for plans of any size", () => {
  const size = { width: 800, height: 600 };
  const drawn = (bounds: Rect, start: Rect) => ({ bounds, plan: "P", elements: new Map([["P.start", { rect: start }]]) });
  const view = first(drawn([0, 0, 20_000, 9000], [9000, 40, 120, 50]), size);
  const [[left, top], [right, bottom]] = [toPane(view, [9000, 40]), toPane(view, [9120, 90])];
  assert.ok(left >= 0 && top >= 0 && right <= size.width && bottom <= size.height, JSON.stringify(view));
  const small = drawn([0, 0, 300, 200], [10, 10, 120, 50]);
  assert.deepEqual(first(small, size), first({ ...small, elements: new Map() }, size));
});

test("a list is filtered by all words: exact names first, then prefixes, refused items last", () => {
  const choice = (label: string, hint = "", refused: string | null = null) => ({ id: label, label, hint, refused });
  const all = [choice("goOn"), choice("turn", "goes round", "no"), choice("wait a go"), choice("go")];
  assert.deepEqual(filtered(all, "go").map(({ label }) => label), ["go", "goOn", "wait a go", "turn"]);
  assert.deepEqual(filtered(all, "go wa").map(({ label }) => label), ["wait a go"]);
  const made = [choice("new: Curve", "turns on the way"), choice("new: TurnBack"), choice("new: Turn")];
  assert.deepEqual(filtered(made, "new: Turn").map(({ label }) => label), ["new: Turn", "new: TurnBack", "new: Curve"]);
});
