// The drawing by touch: every drag has an alternative by taps, one finger pans, two zoom.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser } from "./browser";

const PLAN = `use carbot

plan P {
    start go

    actor go: Forward {
        ForwardSuccessful -> go
    }
}
`;

async function tap(page: Page, selector: string): Promise<void> {
  const box = await page.locator(selector).first().boundingBox();
  assert.ok(box, selector);
  await page.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
}

const fingers = { hasTouch: true, viewport: { width: 1024, height: 768 } };

inBrowser("taps add, connect and set values", { "plan.afp": PLAN }, async (studio) => {
  const { page, read } = studio;
  await page.locator('.node [data-item="P.go"]').waitFor();
  await tap(page, '.node [data-item="P.go"] text.name');
  await page.locator("[data-template=CheckTouchSensor]").scrollIntoViewIfNeeded();
  await tap(page, "[data-template=CheckTouchSensor]");
  await studio.becomes("plan.afp", /supervise checkTouchSensor: CheckTouchSensor/);
  await page.locator('.node [data-item="P.go"] text.open').waitFor();
  await tap(page, '.node [data-item="P.go"] text.open');
  await page.locator(".chooser li", { hasText: "new: Turn" }).first().waitFor();
  const height = (await page.locator(".chooser li").first().boundingBox())!.height;
  assert.ok(height >= 44, `a row is ${height} px high`);
  await page.locator(".choice-label", { hasText: /^new: Turn$/ }).tap();
  await studio.becomes("plan.afp", /TouchSensorPressed -> turn/);
  await page.locator('.node [data-item="P.turn"]').waitFor();
  await page.locator(".inspector .row", { hasText: "angle" }).tap();
  await page.locator(".inspector .value").getByRole("button", { name: "flip the sign" }).tap();
  await page.locator(".inspector .value").getByRole("button", { name: "Set", exact: true }).tap();
  await studio.becomes("plan.afp", /Turn\(angle = -90 deg\)/);
  assert.match(await read("plan.afp.layout"), /^P\.go -?\d+ -?\d+\nP\.start -?\d+ -?\d+\nP\.turn -?\d+ -?\d+\n$/);
}, fingers);

inBrowser("one finger pans and two fingers zoom without a change", { "plan.afp": PLAN }, async ({ page, read }) => {
  await page.locator('.node [data-item="P.go"]').waitFor();
  const client = await page.context().newCDPSession(page);
  const touch = (type: string, ...points: [number, number][]) => client.send("Input.dispatchTouchEvent", { type: type as "touchStart", touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const place = async (): Promise<number> => (await page.locator('.node [data-item="P.go"] text.name').boundingBox())!.x;
  const before = await place();
  await touch("touchStart", [300, 650]);
  await touch("touchMove", [330, 650]);
  await touch("touchMove", [370, 650]);
  await touch("touchEnd");
  assert.ok(Math.abs((await place()) - before - 70) < 3, `${await place()} after ${before}`);
  await touch("touchStart", [300, 640]);
  await touch("touchStart", [300, 640], [400, 640]);
  await touch("touchMove", [250, 640], [450, 640]);
  await touch("touchEnd");
  await page.locator(".board-zoom", { hasText: "200 %" }).waitFor();
  assert.deepEqual([await read("plan.afp"), await read("plan.afp.layout")], [PLAN, ""]);
}, fingers);
