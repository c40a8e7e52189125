// Inspecting a run: timeline, reasons, conditions, forced values, going back.
import assert from "node:assert/strict";
import { test } from "node:test";
import AxeBuilder from "@axe-core/playwright";
import type { Page } from "playwright-core";
import { beside, extended, rows, scale, within, zoomed, type Record } from "../page/debug/trace";
import { holding } from "../page/debug/values";
import { inBrowser, shows } from "./browser";

const PLAN = `use std

plan Blink {
    in  pause: duration = 1 s
    var left:  int = 0

    start dark

    actor dark: Wait(duration = pause) { Elapsed -> count }
    computation count: Count(value = left, limit = 3, next => left) {
        Again -> light
        Done  -> terminate
    }
    actor light: Wait(duration = 5 s) {
        Elapsed -> dark
        supervise tired: CheckTimeout(duration = 2 s) { TimedOut -> dark }
    }
}
`;

const record = (step: number, at: number, kind: string, path: string, more: Partial<Record> = {}): Record => ({ at, step, kind, path, text: `${path} ${kind}`, ...more });

test("records become rows: active elements, supervisors, writes", () => {
  const found = rows([
    record(1, 0, "started", "go"),
    record(1, 0, "started", "go.touch", { supervisor: true }),
    record(2, 1, "event", "go.touch", { supervisor: true }),
    record(2, 1, "interrupted", "go"),
    record(2, 1, "started", "work"),
    record(3, 1.5, "started", "work.first"),
    record(3, 1.5, "committed", "work", { entry: "left", value: "1" }),
    record(4, 2, "missed", "go.touch", { supervisor: true }),
  ]);
  assert.deepEqual(found.map(({ kind, name }) => `${kind} ${name}`), ["flow ", "flow work", "supervisor go.touch", "entry left", "misses "]);
  assert.deepEqual(found[0]!.bars, [{ from: 0, to: 1, label: "go" }, { from: 1, to: null, label: "work" }]);
  assert.deepEqual(found[2]!.bars, [{ from: 0, to: 1, label: "touch" }]);
  assert.deepEqual(found[2]!.marks.map(({ at }) => at), [1]);
  assert.deepEqual(found[3]!.marks, [{ at: 1.5, label: "1" }]);
});

test("a simulation that continues a log starts all rows again", () => {
  const found = rows([record(-3, 0, "started", "go"), record(-2, 0, "started", "go.touch", { supervisor: true }), record(-1, 2, "forked", ""), record(1, 2, "started", "go")]);
  assert.deepEqual(found.map(({ bars }) => bars.map(({ from, to }) => [from, to])), [[[0, 2], [2, null]], [[0, 2]]]);
});

test("events after a step back replace the earlier events", () => {
  const before = [record(1, 0, "started", "a"), record(2, 1, "finished", "a"), record(3, 1, "started", "b")];
  assert.equal(extended(before, []), before);
  assert.deepEqual(extended(before, [record(2, 1, "interrupted", "a")]).map(({ kind }) => kind), ["started", "interrupted"]);
  assert.equal(extended(before, [record(2, 1, "finished", "a")]), before);
  assert.equal(extended(before, [before[2]!, record(4, 2, "finished", "b")]).length, 4);
});

test("windows stay within the run; a scale has round seconds", () => {
  assert.deepEqual(within({ from: -2, to: 2 }, 10), { from: 0, to: 4 });
  assert.deepEqual(within({ from: 8, to: 12 }, 10), { from: 6, to: 10 });
  const half = zoomed({ from: 0, to: 10 }, 5, 0.5, 10);
  assert.deepEqual(half, { from: 2.5, to: 7.5 });
  assert.deepEqual(scale({ from: 0, to: 8 }), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
  assert.deepEqual(scale({ from: 0.05, to: 0.85 }), [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]);
  assert.equal(beside([0, 1, 2], 1, 1), 2);
  assert.equal(beside([0, 1, 2], 0, -1), null);
});

test("an entry of the shown plan has the value of the innermost plan of that name", () => {
  const frames = [{ path: "", plan: "Outer" }, { path: "work", plan: "Inner" }];
  const now = { at: 2.5, entries: { left: "1", "work.left": "2" }, forced: [{ path: "work.left", value: "3", until: 9 }] };
  assert.deepEqual(holding(frames, "Outer", now, "Outer.left"), { text: "1", left: null });
  assert.deepEqual(holding(frames, "Inner", now, "Inner.left"), { text: "3", left: 7 });
  assert.equal(holding(frames, "Other", now, "Other.left"), null);
  assert.equal(holding(frames, "Outer", now, "Outer.right"), null);
});

inBrowser("while a plan runs, its entries show their values", { "plan.afp": PLAN }, async ({ page }) => {
  // Slowly, so that each value is visible.
  await begun(page, "2");
  const held = async (): Promise<string[]> => page.locator(".run-value-text").allTextContents();
  await page.waitForFunction(() => document.querySelectorAll(".run-value-text").length === 2);
  assert.equal((await held())[0], "1 s");
  // The declaration is hidden during a run, and reappears afterwards.
  const declared = page.locator(".declared").first();
  assert.equal(await declared.evaluate((text) => getComputedStyle(text).visibility), "hidden");
  await page.waitForFunction(() => [...document.querySelectorAll(".run-value-text")].at(-1)?.textContent === "2");
  await page.keyboard.press("Shift+F5");
  await page.locator(".end-card").waitFor();
  await page.locator(".board").focus();
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.querySelectorAll(".run-value-text").length === 0);
  assert.equal(await declared.evaluate((text) => getComputedStyle(text).visibility), "visible");
});

async function clean(page: Page, within: string): Promise<void> {
  const { violations } = await new AxeBuilder({ page }).include(within).analyze();
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`), []);
}

const begun = async (page: Page, speed = "20"): Promise<void> => {
  await page.locator(".count", { hasText: /ready|warning/ }).waitFor();
  await page.getByLabel("Speed").selectOption(speed);
  await page.keyboard.press("F5");
};

inBrowser("a timeline shows the run; mouse and keys go to its moments", { "plan.afp": PLAN }, async ({ page }) => {
  await begun(page);
  await page.locator(".end-card").waitFor();
  await page.keyboard.press("Control+Shift+Y");
  await page.waitForFunction(() => document.querySelectorAll(".lane.flow rect").length >= 5);
  await page.waitForFunction(() => document.querySelectorAll(".lane.supervisor circle").length >= 2);
  await shows(page.locator(".timeline .names"), /the plan[^]*light\.tired[^]*left/);
  await clean(page, ".bottom");
  await page.locator(".timeline .tool").nth(4).click();
  const ruler = (await page.locator(".ruler").boundingBox())!;
  await page.mouse.click(ruler.x + ruler.width / 2, ruler.y + 12);
  await page.waitForFunction(() => {
    const middle = Number.parseFloat(document.querySelector(".clock.held")?.textContent ?? "0");
    return middle > 2 && middle < 6;
  });
  await page.locator(".ruler").focus();
  await page.keyboard.press("Home");
  await page.waitForFunction(() => document.querySelector(".clock")!.textContent === "0.0 s");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.querySelector(".clock")!.textContent === "1.0 s");
  await page.locator(".lane.supervisor circle").first().click();
  await page.waitForFunction(() => document.querySelector(".clock")!.textContent === "3.0 s");
  await page.keyboard.press("Shift+F10");
  await page.waitForFunction(() => Number.parseFloat(document.querySelector(".clock")!.textContent!) < 3);
});

inBrowser("the reason of an activation is shown; a forced value is shown until it ends", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator('.node [data-item="Blink.light"] text.name').first().click({ force: true });
  // Slowly, so that it pauses in the middle: entries have values after the start.
  await begun(page, "1");
  await page.waitForFunction(() => Number.parseFloat(document.querySelector(".clock.running")?.textContent ?? "0") > 0);
  await page.keyboard.press("F8");
  await page.locator(".clock.held").waitFor();
  await page.locator('.node [data-item="Blink.dark"] text.name').first().click({ force: true });
  await page.keyboard.press("w");
  const card = page.locator(".why-card");
  await card.waitFor();
  await shows(card, /Why dark\?[^]*Paths to this element[^]*light\.Elapsed[^]*light\.tired\.TimedOut/);
  await card.getByRole("button", { name: "Pretend it happens" }).last().click();
  await page.locator(".forced-bar", { hasText: "light.tired.TimedOut" }).waitFor();
  await page.keyboard.press("Control+Shift+U");
  await page.getByRole("button", { name: "Force pause" }).click();
  await page.getByLabel("Value of pause").fill("100 ms");
  await page.getByRole("button", { name: "Force", exact: true }).click();
  await page.locator(".forced-bar", { hasText: "pause = 100 ms" }).waitFor();
  await page.waitForFunction(() => /^100 ms, \d+ s$/.test(document.querySelector(".run-value-text")?.textContent ?? ""));
  await clean(page, ".studio");
  await page.getByRole("button", { name: "Release" }).first().click();
  await page.waitForFunction(() => document.querySelectorAll(".forced-bar .one").length === 1);
  await page.locator(".forced-bar .stop").click();
  await page.locator(".end-card").waitFor();
  assert.equal(await page.locator(".forced-bar").count(), 0);
});

inBrowser("a breakpoint may have a condition or a message, also at exits and supervisors", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator('.node [data-item="Blink.dark"] text.name').first().click({ force: true });
  await page.keyboard.press("F9");
  await page.locator("circle.breakpoint").waitFor();
  await page.locator('.node text:text-is("tired")').first().click({ force: true });
  await page.keyboard.press("F9");
  await page.waitForFunction(() => document.querySelectorAll("circle.breakpoint").length === 2);
  await page.keyboard.press("Control+Shift+U");
  await page.getByLabel("Condition at line 9").fill("left > 1");
  await page.keyboard.press("Tab");
  await page.locator(".breakpoint-sign").waitFor();
  await page.getByLabel("Message at line 16").fill("tired at {left}");
  await page.keyboard.press("Tab");
  await page.locator("path.breakpoint").waitFor();
  await begun(page);
  await page.locator(".clock.held").waitFor();
  await shows(page.locator(".run-pane dl"), /left\s+2/);
  await page.locator(".run-pane li", { hasText: "tired at 1" }).waitFor();
  await page.getByLabel("Breakpoint at line 9", { exact: true }).uncheck();
  await page.locator("circle.breakpoint.off").waitFor();
});

inBrowser("the outline has a button for every part, and marks the active element", { "plan.afp": PLAN }, async ({ page }) => {
  await page.getByRole("button", { name: "Outline" }).click();
  const outline = page.locator("[data-when=outline]");
  await outline.getByRole("button", { name: /^actor light/ }).waitFor();
  await shows(outline, /plan Blink[^]*pause[^]*dark[^]*Elapsed[^]*light[^]*tired/);
  await outline.getByRole("button", { name: /^actor light/ }).click();
  assert.equal(await outline.locator("[aria-pressed=true]").count(), 1);
  // Slowly, so that it still runs.
  await begun(page, "1");
  await outline.locator("button.active").first().waitFor();
  await clean(page, "[data-when=outline]");
});
