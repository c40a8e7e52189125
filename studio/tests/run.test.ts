// Runs in the page: the plan drives the simulated robot, the drawing shows its state, a card shows
// its end.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import AxeBuilder from "@axe-core/playwright";
import type { WebSocket } from "playwright-core";
import { moved } from "../page/debug/breakpoints";
import { explained, inBrowser, shows } from "./browser";

const PAPER = readFileSync(new URL("../../plans/wall_following.afp", import.meta.url), "utf8");

const PLAN = `use std

plan Inner {
    in  pause: duration
    out done:  bool = false

    start first

    actor first: Wait(duration = pause) { Elapsed -> mark }
    computation mark: Assign(value = true, result => done) { Done -> second }
    actor second: Wait(duration = pause) { Elapsed -> terminate }
}

plan Outer {
    var worked: bool = false

    start rest

    supervise limit: CheckTimeout(duration = 60 s) { TimedOut -> terminate }

    actor rest: Wait(duration = 500 ms) { Elapsed -> work }
    subplan work: Inner(pause = 3 s, done => worked) { OK -> terminate }
}
`;

inBrowser("runs, shows the active element through sub-plans, pauses, steps and ends with a card", { "plan.afp": PLAN }, async ({ page }) => {
  const runs = new Set<WebSocket>();
  page.on("websocket", (socket) => socket.on("framesent", ({ payload }) => void (/"launch"/.test(String(payload)) && runs.add(socket))));
  await page.locator(".count", { hasText: "warning" }).or(page.locator(".count", { hasText: "ready" })).waitFor();
  await page.getByRole("button", { name: "Plans of this file" }).click();
  await page.getByRole("menuitemradio", { name: "Outer" }).click();
  await page.locator(".crumbs [aria-current]", { hasText: "Outer" }).waitFor();
  await page.keyboard.press("F5");
  await page.locator(".run-active.inside").waitFor();
  await page.locator(".run-eye").first().waitFor();
  await page.keyboard.press("F8");
  await page.getByRole("button", { name: "Continue" }).waitFor();
  await page.locator(".run-active.held").waitFor();
  await page.locator(".count").click();
  await page.getByRole("tab", { name: "Run" }).click();
  await page.locator(".run-pane dt", { hasText: "worked" }).waitFor();
  await page.locator(".run-pane li", { hasText: "work.first started" }).waitFor();
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-content").waitFor();
  for (const [word, wanted] of [
    ["pause", /in the run: 3 s/],
    ["done", /in the run: false/],
    ["first", /in the run: active since 0\.500 s/],
  ] as const) {
    await explained(page, word, wanted);
    await page.mouse.move(2, 2);
    await page.locator(".cm-tooltip-hover").waitFor({ state: "detached" });
  }
  await page.getByLabel("Speed").selectOption("20");
  await page.getByRole("button", { name: "Continue" }).click();
  const card = page.locator(".end-card");
  await card.waitFor();
  await shows(card, /Outer finished normally after 6\.5/);
  await card.locator("summary").click();
  await shows(card, /afpc run \S*plan\.afp:Outer/);
  await card.getByRole("button", { name: "Show where" }).click();
  await page.locator(".marks .ring").first().waitFor();
  // Slowly, so that it still runs when it is stopped.
  await page.getByLabel("Speed").selectOption("1");
  await card.getByRole("button", { name: "Run again" }).click();
  await page.locator(".run-active").first().waitFor();
  assert.deepEqual([...runs].map((run) => run.isClosed()), [true, false], "a run that is over is let go");
  await page.keyboard.press("Shift+F5");
  await card.waitFor();
  await shows(card, /interrupted/);
  await card.getByRole("button", { name: "OK" }).click();
  await card.waitFor({ state: "detached" });
});

inBrowser("a plan with errors does not run and shows its first error; a run of an older text is marked", { "plan.afp": PLAN.replace("start rest", "start best") }, async ({ page }) => {
  await page.locator(".count", { hasText: "error" }).waitFor();
  await page.keyboard.press("F5");
  await page.getByText("Nothing was run: the plan has").waitFor();
  assert.equal(await page.locator(".clock").count(), 0);
});

inBrowser("a change of the text during a run marks it as older", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-line", { hasText: "plan Outer" }).click();
  await page.getByRole("button", { name: "Plans of this file" }).click();
  await page.getByRole("menuitemradio", { name: "Outer" }).click();
  await page.keyboard.press("F5");
  await page.locator(".clock").waitFor();
  await page.locator(".cm-line", { hasText: "plan Outer" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(" // now");
  const older = page.getByRole("button", { name: /The plan has changed since this run started/ });
  await shows(older, /plan changed/);
  // After undo, the text equals the running text.
  await page.keyboard.press("Control+z");
  await older.waitFor({ state: "detached" });
  await page.keyboard.press("Control+Shift+z");
  await older.click();
  await page.locator(".clock.running").waitFor();
  await page.getByRole("button", { name: /The plan has changed since this run started/ }).waitFor({ state: "detached" });
});

test("breakpoints move with their lines", () => {
  const at = (line: number, character: number) => ({ line, character });
  const lines = (...all: number[]) => all.map((line) => ({ line }));
  const change = (from: [number, number], to: [number, number], text: string) => ({ range: { start: at(...from), end: at(...to) }, text });
  assert.deepEqual(moved(lines(2, 5), change([0, 0], [0, 0], "a\n")), lines(3, 6));
  assert.deepEqual(moved(lines(2, 5), change([2, 0], [2, 0], "a\n")), lines(3, 6));
  assert.deepEqual(moved(lines(2, 5), change([2, 4], [2, 4], "\n")), lines(2, 6));
  assert.deepEqual(moved(lines(2, 5), change([1, 0], [2, 0], "")), lines(1, 4));
  assert.deepEqual(moved(lines(2, 3, 5), change([2, 1], [5, 1], "")), lines(2));
  assert.deepEqual(moved(lines(2, 3, 5), change([2, 1], [6, 0], "")), lines(2));
  assert.deepEqual(moved([{ line: 2, condition: "a > 1" }], change([0, 0], [0, 0], "a\n")), [{ line: 3, condition: "a > 1" }]);
  assert.deepEqual(moved(lines(2, 5), change([3, 0], [3, 2], "xyz")), lines(2, 5));
});

inBrowser("a run stops at a breakpoint, which moves with the text and is remembered", { "plan.afp": PLAN }, async ({ page, isSaved }) => {
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-line", { hasText: "actor first" }).click();
  await page.locator(".breakpoint").waitFor({ state: "detached" });
  // The selection follows the cursor.
  await page.waitForTimeout(400);
  await page.keyboard.press("F9");
  await page.locator(".cm-stops .cm-breakpoint:visible").waitFor();
  await page.locator("circle.breakpoint").waitFor();
  await page.locator(".cm-line", { hasText: "plan Inner" }).click();
  await page.keyboard.press("Home");
  await page.keyboard.type("// above\n");
  await isSaved();
  await page.reload();
  await page.locator(".cm-content").waitFor();
  await page.locator(".cm-stops .cm-breakpoint:visible").waitFor();
  await page.getByRole("button", { name: "Plans of this file" }).click();
  await page.getByRole("menuitemradio", { name: "Outer" }).click();
  await page.keyboard.press("F5");
  await page.getByRole("button", { name: "Continue" }).waitFor();
  await shows(page.locator(".clock"), /^0\.5 s/);
});

inBrowser("the world is shown before a run; a run moves the robot, and a press of a control ends the run", { "wall_following.afp": PAPER }, async ({ page }) => {
  const robot = page.locator(".floor .robot");
  await robot.waitFor();
  assert.ok((await page.locator(".floor .thing").count()) > 4);
  const begun = await robot.getAttribute("transform");
  const escape = page.locator(".stimuli .stops", { hasText: "escape" });
  assert.ok(await escape.isDisabled());
  await page.keyboard.press("F5");
  await page.locator(".floor .driven").first().waitFor({ state: "attached" });
  await page.waitForFunction((before) => document.querySelector(".floor .robot")!.getAttribute("transform") !== before, begun);
  await escape.click();
  const card = page.locator(".end-card");
  await card.waitFor();
  await shows(card, /WallFollowing was interrupted/);
  assert.notEqual(await robot.getAttribute("transform"), begun);
  await card.getByRole("button", { name: "OK" }).click();
  await page.waitForFunction((before) => document.querySelector(".floor .robot")!.getAttribute("transform") === before, begun);
  assert.equal(await page.locator(".floor .driven").count(), 0);
});

inBrowser("a new world and a new seed apply to the next run; failures are explained", { "wall_following.afp": PAPER }, async ({ page }) => {
  await page.locator(".floor .robot").waitFor();
  const before = await page.locator(".floor").getAttribute("viewBox");
  await page.getByLabel("World", { exact: true }).and(page.locator("select")).selectOption("random:1");
  await page.waitForFunction((before) => document.querySelector(".floor")?.getAttribute("viewBox") !== before, before);
  await page.getByLabel("Seed").fill("7");
  await page.keyboard.press("F5");
  await page.locator(".clock.running").waitFor();
  await page.getByText("Inject a fault").click();
  await page.getByLabel("Fault", { exact: true }).selectOption("battery.low");
  await page.getByLabel("share").waitFor();
  const { violations } = await new AxeBuilder({ page }).include(".world").analyze();
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`), []);
  await page.getByRole("button", { name: "Inject", exact: true }).click();
  await page.keyboard.press("Control+Shift+U");
  await page.locator(".run-pane li", { hasText: "battery.low" }).waitFor();
});

const ROOM = `version = 1\nname = "room"\n[robot]\npose_m_deg = [1.0, 1.0, 0.0]\n`;
const PROJECT = { "plan.afp": PAPER, "afp.toml": `[run]\nworld = "a.toml"\n`, "a.toml": ROOM, "b.toml": "version = 1\n" };

inBrowser("an invalid world keeps the old world and is explained", PROJECT, async ({ page }) => {
  const where = page.locator(".where select");
  await where.waitFor();
  const named = await where.inputValue();
  assert.match(named, /a\.toml$/);
  await where.selectOption({ label: "b.toml (a file)" });
  await page.locator(".banner.error", { hasText: "b.toml" }).waitFor();
  await page.locator(".floor .robot").waitFor();
  await page.waitForFunction((named) => document.querySelector<HTMLSelectElement>(".where select")!.value === named, named);
});

inBrowser("a missing world is explained and requested again", { ...PROJECT, "a.toml": "version = 1\n" }, async ({ page, write }) => {
  await page.locator(".world .empty", { hasText: "a.toml" }).waitFor();
  await write("a.toml", ROOM);
  await page.getByRole("button", { name: "Try again" }).click();
  await page.locator(".floor .robot").waitFor();
});
