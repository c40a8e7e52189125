// The room editor: a new room, boxes and walls of any size and the robot's start with only the mouse, in a world file for runs.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser, settled } from "./browser";

const PLAN = `use carbot

plan P {
    start go

    actor go: Forward(distance = 3 m) { ForwardSuccessful -> terminate }
}
`;

/** The place of a point of the floor on the screen. */
const spot = (page: Page, x: number, y: number): Promise<[number, number]> =>
  page.locator(".floor .metres").evaluate((floor, [x, y]) => {
    const { x: left, y: top } = new DOMPoint(x, y).matrixTransform((floor as SVGGraphicsElement).getScreenCTM()!);
    return [left, top] as [number, number];
  }, [x, y]);

async function drag(page: Page, from: [number, number], to: [number, number]): Promise<void> {
  await page.mouse.move(...(await spot(page, ...from)));
  await page.mouse.down();
  await page.mouse.move(...(await spot(page, ...to)), { steps: 6 });
  await page.mouse.up();
}

inBrowser("a room is created, furnished and run with only the mouse; undo removes a box", { "plan.afp": PLAN }, async (studio) => {
  const { page, read } = studio;
  const things = page.locator(".floor .thing");
  await page.locator(".floor .robot").waitFor();
  await page.getByRole("button", { name: "New room" }).click();
  await studio.becomes("worlds/room1.toml", /name = "room1"/);
  const tools = page.getByRole("group", { name: "Edit room" });
  await tools.waitFor();
  await page.waitForFunction(() => document.querySelectorAll(".floor .thing").length === 4);
  await drag(page, [2, 1], [2.5, 2.2]);
  await studio.becomes("worlds/room1.toml", /\[\[box\]\]\npose_m_deg = \[2\.25, 1\.6, 0\.0\]\nsize_m = \[0\.5, 1\.2\]/);
  await page.waitForFunction(() => document.querySelectorAll(".floor .thing").length === 5);
  await tools.getByRole("button", { name: "Wall" }).click();
  await drag(page, [3, 0.2], [3, 1]);
  await studio.becomes("worlds/room1.toml", /points_m = \[\[3\.0, 0\.2\], \[3\.0, 1\.0\]\]/);
  await page.waitForFunction(() => document.querySelectorAll(".floor .thing").length === 6);
  await tools.getByRole("button", { name: "Move", exact: true }).click();
  await drag(page, [0.8, 1.5], [0.5, 0.5]);
  assert.match(await settled(() => read("worlds/room1.toml"), (now) => !now.includes("0.8, 1.5")), /\[robot\]\npose_m_deg = \[0\.[45]\d*, 0\.[45]\d*, 0\.0\]/);
  // A box is moved by its middle.
  await drag(page, [2.25, 1.6], [1.75, 2.1]);
  await studio.becomes("worlds/room1.toml", /\[\[box\]\]\npose_m_deg = \[1\.7\d*, 2\.\d*, 0\.0\]/);
  await tools.getByRole("button", { name: "Remove" }).click();
  await page.mouse.click(...(await spot(page, 3, 0.6)));
  await page.waitForFunction(() => document.querySelectorAll(".floor .thing").length === 5);
  assert.doesNotMatch(await read("worlds/room1.toml"), /\[\[3\.0, 0\.2\]/);
  await page.locator(".board").focus();
  await page.keyboard.press("Control+z");
  await page.waitForFunction(() => document.querySelectorAll(".floor .thing").length === 6);
  await page.getByRole("button", { name: "Done" }).click();
  await page.keyboard.press("F5");
  await page.locator(".clock.running").waitFor();
  await page.waitForFunction(() => /\.toml$/.test((document.querySelector(".where select") as HTMLSelectElement).value));
  assert.equal(await things.count(), 6);
  assert.equal(await read("plan.afp"), PLAN);
});
