// Live values: a slider writes an entry of the run at once, "Keep" writes it into the text; a number
// becomes a variable, and the run goes on with the new text.
import assert from "node:assert/strict";
import AxeBuilder from "@axe-core/playwright";
import type { Locator, Page } from "playwright-core";
import { inBrowser, settled } from "./browser";
import { middle } from "./spots";

const PLAN = `use std

plan P {
    in  pause: duration = 10 s from 1 s to 20 s
    var loud:  bool = false
    out count: int = 0

    start rest

    actor rest: Wait(duration = pause) { Elapsed -> sleep }
    actor sleep: Wait(duration = 60 s) { Elapsed -> rest }
}
`;

const OUTER = `use std

plan Inner {
    start first

    actor first: Wait(duration = 60 s) { Elapsed -> terminate }
}

plan Outer {
    start rest

    actor rest: Wait(duration = 1 s) { Elapsed -> work }
    subplan work: Inner { OK -> rest }
}
`;

/** Checks a part of the page with axe. */
async function isAccessible(page: Page, part: string): Promise<void> {
  const { violations } = await new AxeBuilder({ page }).include(part).analyze();
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`), []);
}

const text = async (part: Locator): Promise<string> => (await part.textContent({ timeout: 10_000 })) ?? "";

/** Waits until a text of the drawing matches. */
const reads = async (part: Locator, wanted: RegExp): Promise<void> => assert.match(await settled(() => text(part), (now) => wanted.test(now)), wanted);

inBrowser("a slider writes an entry of the run at once, keep writes it into the plan", { "plan.afp": PLAN }, async (studio) => {
  const { page, read } = studio;
  await page.locator('.node [data-item="P.rest"]').first().waitFor();
  await page.keyboard.press("F5");
  await page.locator('.run-value-text[data-item="P.pause"]').waitFor();
  await page.mouse.click(...(await middle(page, '.run-value-text[data-item="P.pause"]')));
  const popup = page.locator(".live-popup");
  const slider = popup.getByRole("slider");
  await slider.waitFor();
  await isAccessible(page, ".live-popup");
  assert.deepEqual(await slider.evaluate((one: HTMLInputElement) => [one.min, one.max, one.value]), ["1", "20", "10"]);
  // By mouse: to the right end.
  const { x, y, width, height } = (await slider.boundingBox())!;
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width - 1, y + height / 2, { steps: 8 });
  await page.mouse.up();
  await reads(page.locator('.run-value-text[data-item="P.pause"]'), /^20 s$/);
  assert.equal(await read("plan.afp"), PLAN);
  await popup.getByRole("button", { name: "Keep" }).click();
  await studio.becomes("plan.afp", /pause: duration = 20 s from/);
  await page.keyboard.press("Escape");
  await popup.waitFor({ state: "detached" });
  // An output of the plan has no control.
  await page.mouse.click(...(await middle(page, '.run-value-text[data-item="P.count"]')));
  assert.equal(await page.locator(".live").count(), 0);
  // The list has choices for a truth value.
  await page.keyboard.press("Escape");
  await page.getByRole("tab", { name: "Run" }).or(page.locator(".count")).first().click();
  const tab = page.getByRole("tab", { name: "Run" });
  await tab.click();
  await isAccessible(page, ".bottom");
  await page.locator(".run-pane .live select").selectOption("true");
  await reads(page.locator('.run-value-text[data-item="P.loud"]'), /^true$/);
});

inBrowser("a number becomes a variable, and the run goes on with the new text", { "plan.afp": PLAN.replace("from 1 s to 20 s", "").replace("= 10 s", "= 100 ms") }, async (studio) => {
  const { page } = studio;
  await page.locator('.node [data-item="P.rest"]').first().waitFor();
  await page.keyboard.press("F5");
  await page.locator('.node.active [data-item="P.sleep"]').first().waitFor();
  const clock = async (): Promise<number> => Number.parseFloat(await page.locator(".clock").innerText());
  const before = await clock();
  await page.mouse.click(...(await middle(page, '.node [data-item="P.sleep"] text.formula')));
  await page.getByRole("button", { name: "Make it a variable" }).click();
  await studio.becomes("plan.afp", /var duration = 60 s[^]*sleep: Wait\(duration = duration\)/);
  const chip = page.locator('.run-value-text[data-item="P.duration"]');
  await reads(chip, /^(60 s|1 min)$/);
  await page.locator(".older").waitFor({ state: "detached" });
  assert.ok((await clock()) >= before);
  await page.locator('.node.active [data-item="P.sleep"]').first().waitFor();
  await page.locator(".clock.running").waitFor();
  await page.mouse.click(...(await middle(page, '.run-value-text[data-item="P.duration"]')));
  const less = page.locator(".live-popup").getByRole("button", { name: "less" });
  await less.click();
  assert.notEqual(await settled(() => text(chip), (now) => !/60 s|1 min/.test(now)), "1 min");
});

inBrowser("the drawing follows a run into a sub-plan and out of it, or stays", { "plan.afp": OUTER.replace("duration = 60 s", "duration = 2 s") }, async ({ page }) => {
  await page.getByRole("button", { name: "Plans of this file" }).click();
  await page.getByRole("menuitemradio", { name: "Outer" }).click();
  await page.locator('.node [data-item="Outer.work"]').first().waitFor();
  await page.keyboard.press("F5");
  await page.locator('.node.active [data-item="Inner.first"]').first().waitFor();
  await page.locator('.node.active [data-item="Outer.rest"]').first().waitFor();
  await page.keyboard.press("Control+k");
  await page.keyboard.type("Follow the run");
  await page.keyboard.press("Enter");
  // The run may have entered the sub-plan before the command.
  await page.getByRole("button", { name: "Plans of this file" }).click();
  await page.getByRole("menuitemradio", { name: "Outer" }).click();
  await reads(page.locator(".run-place-text"), /▶ first/);
  await page.waitForTimeout(800);
  assert.equal(await page.locator('.node [data-item="Inner.first"]').count(), 0);
});
