// The guide: the next step follows from the plan.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Element } from "../page/drawing/shapes";
import { facts, next, progress, STEPS, type Facts } from "../page/plan/guide";
import { isDone, LATER, type Later, type Now } from "../page/plan/chapter";
import { inBrowser, shows } from "./browser";

const NOTHING: Facts = { actors: 0, errors: 1, watched: 0, stoppers: 0, crates: 0, runs: 0 };

test("each step depends on the contents of the plan", () => {
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

test("a drawing is searched for elements, local and global supervisors", () => {
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

const QUIET: Now = { isChanged: false, errors: 0, runs: 0, files: 0, isTested: false };

test("each step of the second chapter ends with its task", () => {
  const ends: Record<Later, Partial<Now>> = {
    change: { isChanged: true },
    rerun: { runs: 1 },
    break: { errors: 1 },
    mend: { errors: 0 },
    scenario: { files: 1 },
    test: { isTested: true },
  };
  for (const step of LATER) {
    assert.ok(isDone(step, { ...QUIET, ...ends[step] }), step);
    if (step !== "mend") assert.ok(!isDone(step, QUIET), step);
  }
  assert.ok(!isDone("change", { ...QUIET, isChanged: true, errors: 1 }));
  assert.ok(!isDone("mend", { ...QUIET, errors: 2 }));
});

const WHOLE = `use carbot

plan Plan {
    start forward

    supervise checkEscapeButton: CheckEscapeButton { EscapeButtonPressed -> terminate }

    actor forward: Forward(distance = 60 cm) {
        supervise checkTouchSensor: CheckTouchSensor { TouchSensorPressed -> forward2 }
        ForwardSuccessful -> terminate
    }

    actor forward2: Forward(distance = -10 cm) { ForwardSuccessful -> turn }

    actor turn: Turn(angle = 90 deg) { TurnSuccessful -> terminate }
}
`;

inBrowser("the second chapter: change a value, break it, repair it, write and run scenarios, and the last card", { "plan.afp": WHOLE }, async ({ page, becomes }) => {
  const card = page.locator(".guide-card");
  const says = (words: string) => card.getByRole("heading", { name: words }).waitFor();
  await page.locator('.node [data-item="Plan.turn"]').first().waitFor();
  await page.evaluate(() => sessionStorage.setItem("afp-studio-guide", JSON.parse(sessionStorage.getItem("afp-studio-plan")!).uri));
  await page.reload();
  await says("Run it again");
  await page.getByLabel("Speed").selectOption("null");
  const run = async (): Promise<void> => {
    await page.locator("button.run").click();
    await page.locator(".end-card").waitFor();
    await page.locator(".end-card").getByRole("button", { name: "OK" }).click();
  };
  await run();
  await run();
  await says("Your plan is complete");
  await card.getByRole("button", { name: "Next chapter" }).click();
  await says("Change a value");
  await page.locator('.node [data-item="Plan.forward"] text.formula').first().click({ force: true });
  await page.locator(".value-popup").getByRole("button", { name: "less" }).click();
  await page.locator(".value-popup").getByRole("button", { name: "Set", exact: true }).click();
  await becomes("plan.afp", /forward: Forward\(distance = (?!60)\d+ cm\)/);
  await says("See the difference");
  await run();
  await says("Break it on purpose");
  await page.locator('.node [data-item="Plan.turn"] text.name').first().click({ force: true });
  await page.keyboard.press("Delete");
  await says("Repair it");
  await page.keyboard.press("Control+z");
  await says("Write a test");
  await page.locator(".count").click();
  await page.getByRole("tab", { name: "Scenarios" }).click();
  await page.getByRole("button", { name: "Generate scenarios" }).click();
  await says("Test your plan");
  await page.getByRole("button", { name: "Run scenarios" }).click();
  await says("You did it!");
  assert.equal(await card.getByRole("progressbar").getAttribute("value"), "6");
  await card.getByRole("button").filter({ hasNotText: /Close/ }).first().click();
  await card.waitFor({ state: "detached" });
  await becomes("plan.afp", /Forward/);
});

inBrowser("the first plan: from an empty folder to a driving robot with only the mouse", {}, async ({ page, read, isSaved }) => {
  const card = page.locator(".guide-card");
  const says = (words: string) => card.getByRole("heading", { name: words }).waitFor();
  await page.getByRole("button", { name: /Your first plan/ }).click();
  await says("Make it drive");
  // The card covers nothing of the drawing.
  const [strip, board] = [(await card.boundingBox())!, (await page.locator(".board").boundingBox())!];
  assert.ok(strip.y + strip.height <= board.y + 1, JSON.stringify({ strip, board }));
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
