// Three tasks of a user, each with real input in at most ten gestures: add a supervisor, find why
// the robot turned, slow the robot down while it runs.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser, settled, shows } from "./browser";
import { middle, name } from "./spots";

/** Maximum number of gestures of a task. */
const MOST = 10;

const PLAN = `use carbot

plan P {
    in slow: speed = 20 cm/s from 2 cm/s to 30 cm/s

    start go

    actor go: Forward(distance = 40 cm, speed = slow) { ForwardSuccessful -> turn }

    actor turn: Turn(angle = 90 deg) { TurnSuccessful -> go }
}
`;

/** A hand that counts its gestures. */
class Hand {
  gestures = 0;
  constructor(private readonly page: Page) {}

  async click(selector: string): Promise<void> {
    this.gestures++;
    await this.page.locator(selector).first().waitFor();
    await this.page.mouse.click(...(await middle(this.page, selector)));
  }

  async drag(from: string, to: string | [number, number]): Promise<void> {
    this.gestures++;
    await this.page.locator(from).first().waitFor();
    const [x, y] = await middle(this.page, from);
    await this.page.mouse.move(x, y);
    await this.page.mouse.down();
    await this.page.mouse.move(x + 6, y + 6);
    await this.page.mouse.move(...(typeof to === "string" ? await middle(this.page, to) : to), { steps: 4 });
    await this.page.mouse.up();
  }

  async scroll(to: string): Promise<void> {
    this.gestures++;
    await this.page.locator(to).first().evaluate((found) => found.scrollIntoView({ block: "center" }));
  }

  async press(key: string): Promise<void> {
    this.gestures++;
    await this.page.keyboard.press(key);
  }

  end(): void {
    assert.ok(this.gestures <= MOST, `${this.gestures} gestures`);
  }
}

inBrowser("a supervisor is added to an element, and leads to the end", { "plan.afp": PLAN }, async ({ page, becomes }) => {
  const hand = new Hand(page);
  await page.locator('.node [data-item="P.go"]').first().waitFor();
  await hand.scroll("[data-template=CheckTouchSensor]");
  await hand.drag("[data-template=CheckTouchSensor]", name("P.go"));
  await becomes("plan.afp", /supervise checkTouchSensor: CheckTouchSensor/);
  await hand.click('.node [data-item="P.go.checkTouchSensor"] text.open, .node [data-item="P.go"] text.open');
  await hand.click('.chooser .choice-label:text-is("end the plan")');
  await becomes("plan.afp", /TouchSensorPressed -> terminate/);
  await page.locator(".count", { hasText: "ready" }).waitFor();
  hand.end();
});

inBrowser("why the robot turned is found from the element", { "plan.afp": PLAN }, async ({ page }) => {
  const hand = new Hand(page);
  await page.locator('.node [data-item="P.go"]').first().waitFor();
  await hand.press("F5");
  await page.locator('.node.active [data-item="P.turn"]').first().waitFor({ timeout: 20_000 });
  await hand.press("F8");
  await page.locator(".clock.held").waitFor();
  await hand.click(name("P.turn"));
  await hand.press("w");
  await shows(page.locator(".why-card"), /go finished ForwardSuccessful -> turn/);
  hand.end();
});

inBrowser("the robot is slowed down while it runs", { "plan.afp": PLAN }, async ({ page, becomes }) => {
  const hand = new Hand(page);
  await page.locator('.node [data-item="P.go"]').first().waitFor();
  await hand.press("F5");
  await hand.click('.run-value-text[data-item="P.slow"]');
  const slider = page.locator(".live-popup input[type=range]");
  await slider.waitFor();
  const { x, y, width, height } = (await slider.boundingBox())!;
  await hand.drag(".live-popup input[type=range]", [x + width * 0.15, y + height / 2]);
  const chip = page.locator('.run-value-text[data-item="P.slow"]');
  const speed = async (): Promise<string> => (await chip.textContent()) ?? "";
  assert.match(await settled(speed, (now) => /^[2-9](\.\d+)? cm\/s$/.test(now)), /^[2-9](\.\d+)? cm\/s$/);
  await hand.click('.live-popup button:text-is("Keep")');
  await becomes("plan.afp", /slow: speed = [2-9](\.\d+)? cm\/s from/);
  hand.end();
});
