// The first plan by mouse only: from an empty folder to a robot that bumps, backs up and turns, in
// few gestures.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser, shows } from "./browser";

/** Maximum number of gestures. */
const MOST = 20;
/** Maximum number of further gestures up to the moment of a failed scenario. */
const MORE = 10;

class Mouse {
  gestures = 0;
  constructor(private readonly page: Page) {}

  async middle(selector: string): Promise<[number, number]> {
    const found = this.page.locator(selector).first();
    await found.waitFor();
    await found.evaluate((node) => node.closest(".palette-list, .chooser, .inspector, .results") && node.scrollIntoView({ block: "center" }));
    // Waits for the end of animations.
    await this.page.evaluate(() => Promise.all(document.getAnimations().map((motion) => motion.finished.catch(() => {}))));
    const box = (await found.boundingBox())!;
    return [box.x + box.width / 2, box.y + box.height / 2];
  }

  async click(selector: string): Promise<void> {
    this.gestures++;
    await this.page.mouse.click(...(await this.middle(selector)));
  }

  async drag(from: string, to: string | [number, number]): Promise<void> {
    this.gestures++;
    const [x, y] = await this.middle(from);
    await this.page.mouse.move(x, y);
    await this.page.mouse.down();
    await this.page.mouse.move(x + 6, y + 6);
    await this.page.mouse.move(...(typeof to === "string" ? await this.middle(to) : to), { steps: 4 });
    await this.page.mouse.up();
  }

  /** Chooses from the list after a drop. */
  choose = (label: string): Promise<void> => this.click(`.chooser .choice-label:text-is("${label}")`);
}

const template = (name: string): string => `[data-template=${name}]`;
const name = (item: string): string => `.node [data-item="Plan.${item}"] text.name`;
const open = (item: string): string => `.node [data-item="Plan.${item}"] text.open`;

inBrowser("five gestures lead from an empty folder to a successful run", {}, async ({ page }) => {
  const mouse = new Mouse(page);
  await mouse.click(".card.main");
  await mouse.click(template("Forward"));
  await mouse.click('.node [data-item="Plan.forward"] text.nowhere');
  await mouse.choose("end the plan");
  await page.locator(".count", { hasText: "ready" }).waitFor();
  await mouse.click("button.run");
  await page.locator(".end-card").waitFor({ timeout: 30_000 });
  await shows(page.locator(".end-card"), /finished normally/);
  assert.equal(mouse.gestures, 5);
});

inBrowser("a first plan needs only the mouse", {}, async ({ page, becomes }) => {
  const mouse = new Mouse(page);
  await mouse.click(".card.main");
  await page.locator('.node [data-item="Plan.start"]').waitFor();
  await mouse.drag(template("Forward"), [480, 260]);
  await mouse.drag(open("forward"), [330, 560]);
  await mouse.choose("end the plan");
  await page.locator(".count", { hasText: "ready" }).waitFor();
  await mouse.drag(template("CheckTouchSensor"), name("forward"));
  await mouse.drag(open("forward"), [760, 200]);
  await mouse.choose("new: Forward");
  await becomes("plan.afp", /TouchSensorPressed -> forward2/);
  await mouse.click('.inspector .row:has-text("distance")');
  await mouse.click('.inspector .value [aria-label="flip the sign"]');
  await mouse.click('.inspector .value [aria-label="Set"]');
  await becomes("plan.afp", /forward2: Forward\(distance = -1 m\)/);
  await mouse.drag(open("forward2"), [440, 200]);
  await mouse.choose("new: Turn");
  await becomes("plan.afp", /actor turn: Turn/);
  await mouse.drag(open("turn"), name("forward"));
  await becomes("plan.afp", /TurnSuccessful -> forward\n/);
  await mouse.click('.node [data-item="Plan.forward"] text.state');
  await mouse.choose("forward");
  await mouse.drag(template("CheckEscapeButton"), '.node [data-item="Plan.start"] text.start');
  await mouse.click(open("start"));
  await mouse.choose("end the plan");
  await becomes("plan.afp", /supervise checkEscapeButton: CheckEscapeButton \{ EscapeButtonPressed -> terminate \}/);
  await page.locator(".count", { hasText: "ready" }).waitFor();
  assert.ok(mouse.gestures <= MOST, `${mouse.gestures} gestures`);

  const more = mouse.gestures + MORE;
  await mouse.click(".count");
  await mouse.click('.bottom [role=tab]:text-is("Scenarios")');
  await mouse.click('.jobs-pane button:text-is("Generate scenarios")');
  await page.locator(".jobs-pane .busy").waitFor({ state: "detached", timeout: 30_000 });
  await mouse.click('.jobs-pane button:text-is("Run scenarios")');
  await page.locator(".jobs-pane .sum", { hasText: "passed" }).waitFor({ timeout: 30_000 });
  await mouse.click('.node text:text-is("checkTouchSensor")');
  await mouse.click('.inspector .periods button:text-is("50 ms")');
  await becomes("plan.afp", /checkTouchSensor: CheckTouchSensor every 50 ms/);
  await mouse.click('.jobs-pane button:text-is("Run scenarios")');
  await page.locator(".jobs-pane .sum", { hasText: "failed" }).waitFor({ timeout: 30_000 });
  await page.locator(".failed-number").first().waitFor();
  await mouse.click(".results .failed .show");
  await page.locator(".clock.held").waitFor();
  await page.locator(".lane.flow rect").first().waitFor();
  await page.waitForFunction(() => Number.parseFloat(document.querySelector(".clock")!.textContent!) > 0);
  assert.ok(mouse.gestures <= more, `${mouse.gestures - more + MORE} more gestures`);
}, { timeout: 150_000 });
