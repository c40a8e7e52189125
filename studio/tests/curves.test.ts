// Curves without a page: parsing, order, thinning, drawing as steps.
import assert from "node:assert/strict";
import { test } from "node:test";
import { cut, extended, valueAt, type Curve } from "../page/debug/curves";
import { drawn } from "../page/panes/plots";
import { sector } from "../page/world/geometry";

const plain = (text: string) => ({ number: Number(text), unit: "" });
const told = (...all: [number, string][]): Curve => all.reduce<Curve | undefined>((curve, [at, text]) => extended(curve, at, plain(text)), undefined)!;

test("a value lasts until the next value, for any order of moments", () => {
  const curve = told([0, "1"], [1, "1"], [2, "3"]);
  assert.deepEqual(curve.points, [[0, 1], [2, 3]]);
  assert.deepEqual([-1, 0, 1.9, 2, 9].map((at) => valueAt(curve, at)), [null, 1, 1, 3, 3]);
  const back = extended(curve, 1.5, plain("2"))!;
  assert.deepEqual(back.points, [[0, 1], [1.5, 2], [2, 3]]);
  assert.deepEqual(extended(back, 1.5, plain("7"))!.points, [[0, 1], [1.5, 7], [2, 3]]);
  assert.deepEqual(cut(back, 1.7).points, [[0, 1], [1.5, 2]]);
});

test("a long curve is simplified and keeps its shape", () => {
  let curve: Curve | undefined;
  for (let nth = 0; nth < 20_000; nth++) curve = extended(curve, nth, plain(String(nth)));
  assert.ok(curve!.points.length <= 2000);
  for (const at of [0, 5000, 12_000, 19_990]) assert.ok(Math.abs(valueAt(curve!, at)! - at) < 80, String(at));
});

test("a curve is drawn as steps within its window, up to now", () => {
  const x = (at: number): number => at * 10;
  assert.deepEqual(drawn(told([0, "0"], [2, "4"], [6, "2"]), { from: 1, to: 5 }, x, 4), { line: "M10 58H20V8H40", least: 0, most: 4 });
  assert.deepEqual(drawn(told([0, "3"]), { from: 1, to: 5 }, x, 9), { line: "M10 33H50", least: 3, most: 3 });
  assert.equal(drawn({ unit: "", points: [] }, { from: 0, to: 1 }, x, 0).line, "");
});

test("a range sensor's view is a sector around its bearing", () => {
  assert.equal(sector([1, 2, 0], Math.PI / 2, 2), "M1 2L1 0A2 2 0 0 1 1 4Z");
});
