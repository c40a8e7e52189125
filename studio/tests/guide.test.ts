// The guide: the next step follows from the plan.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Element } from "../page/drawing/shapes";
import { facts, next, progress, STEPS, type Facts } from "../page/plan/guide";
import { inBrowser, shows } from "./browser";

const NOTHING: Facts = { actors: 0, errors: 1, watched: 0, stoppers: 0, crates: 0, runs: 0 };

test("each step follows from what the plan has", () => {
  const way: [Partial<Facts>, ReturnType<typeof next>][] = [
    [{}, "drive"],
    [{ actors: 1 }, "connect"],
    [{ actors: 1, errors: 0 }, "run"],
    [{ actors: 1, errors: 0, runs: 1 }, "crate"],
    [{ actors: 1, errors: 0, crates: 1, runs: 1 }, "notice"],
    [{ actors: 1, watched: 1, runs: 1 }, "react"],
    [{ actors: 2, watched: 1, runs: 1 }, "follow"],
    [{ actors: 2, errors: 0, watched: 1, runs: 1 }, "stop"],
    [{ actors: 2, errors: 1, watched: 1, stoppers: 1, runs: 1 }, "lead"],
    [{ actors: 2, errors: 0, watched: 1, stoppers: 1, runs: 1 }, "again"],
    [{ actors: 2, errors: 0, watched: 1, stoppers: 1, runs: 2 }, null],
  ];
  for (const [given, step] of way) assert.equal(next({ ...NOTHING, ...given }), step);
  assert.deepEqual(way.slice(0, -1).map(([, step]) => step), [...STEPS]);
  assert.deepEqual(progress("drive"), [0, STEPS.length]);
  assert.deepEqual(progress("done"), [STEPS.length, STEPS.length]);
});

test("a drawing is read: elements, supervisors of an element and of the plan", () => {
  const piece = (item: string, kind: string) => ({ item, part: { kind, name: "x" }, rect: [0, 0, 1, 1] as const, severity: null, tag: null });
  const element = (item: string, kind: string | null, pieces: Element["pieces"]): [string, Element] => [
    item,
    { item, kind, pieces, rect: [0, 0, 1, 1], outer: [0, 0, 1, 1], svg: "", template: null, file: null, plan: null, help: null, note: null },
  ];
  const elements = new Map([
    element("P.start", null, [piece("P", "whole"), piece("P.gap", "whole"), piece("P.escape", "exit")]),
    element("P.go", "actor", [piece("P.go", "exit"), piece("P.go.touch", "exit"), piece("P.go.touch", "whole")]),
  ]);
  assert.deepEqual(facts({ plan: "P", elements }, { errors: 2, crates: 3, runs: 1 }), { actors: 1, errors: 2, watched: 1, stoppers: 1, crates: 3, runs: 1 });
});

inBrowser("the first plan: from nothing to a robot that drives, by the mouse alone", {}, async ({ page, read, isSaved }) => {
  const card = page.locator(".guide-card");
  const says = (words: string) => card.getByRole("heading", { name: words }).waitFor();
  await page.getByRole("button", { name: /Your first plan/ }).click();
  await says("Make it drive");
  await page.locator(".palette-group").getByText("Forward", { exact: true }).click();
  await says("Choose what comes next");
  await page.locator(".stage").getByText("ForwardSuccessful").click({ force: true });
  await page.getByRole("option", { name: /end the plan/ }).click();
  await says("Let it run");
  await isSaved();
  assert.match(await read("plan.afp"), /start forward[\s\S]*actor forward: Forward \{\s*ForwardSuccessful -> terminate/);
  await page.getByLabel("Speed").selectOption("null");
  await page.locator("button.run").click();
  // It drives freely, ends well, and timeline and explanation show the run.
  await shows(page.locator(".end-card"), /The plan has ended/);
  await page.locator(".lane").first().waitFor();
  await shows(page.locator(".why-card h2"), /forward/);
  const [end, why] = [(await page.locator(".end-card").boundingBox())!, (await page.locator(".why-card").boundingBox())!];
  assert.ok(why.x + why.width <= end.x, JSON.stringify({ end, why }));
  await page.locator(".end-card").getByRole("button", { name: "OK" }).click();
  await says("Put something in its way");
  await card.getByRole("button", { name: "Close" }).click();
  await card.waitFor({ state: "detached" });
});
