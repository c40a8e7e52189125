// Interaction with the world: in an empty folder, moving the robot, dropping and moving objects,
// the camera's picture.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import AxeBuilder from "@axe-core/playwright";
import type { Page } from "playwright-core";
import { inBrowser } from "./browser";
import { middle } from "./spots";

const PAPER = readFileSync(new URL("../../plans/wall_following.afp", import.meta.url), "utf8");

const poseOf = async (page: Page): Promise<[number, number]> => {
  // The robot may appear a moment before its position.
  const robot = await page.waitForSelector('.floor .robot[transform^="translate("]', { state: "attached" });
  const found = /translate\((\S+) (\S+)\)/.exec((await robot.getAttribute("transform"))!)!;
  return [Number(found[1]), Number(found[2])];
};

async function drag(page: Page, from: string, by: [number, number]): Promise<void> {
  const [x, y] = await middle(page, from);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + by[0] / 2, y + by[1] / 2);
  await page.mouse.move(x + by[0], y + by[1]);
  await page.mouse.up();
}

inBrowser("an empty folder shows the world; the robot and dropped objects can be dragged before a run", {}, async ({ page }) => {
  const robot = page.locator(".floor .robot");
  await robot.waitFor();
  const [x, y] = await poseOf(page);
  await drag(page, ".floor .robot polygon", [40, -30]);
  await page.waitForFunction((before) => document.querySelector(".floor .robot")!.getAttribute("transform") !== before, `translate(${x} ${y}) rotate(0)`);
  const [right, up] = await poseOf(page);
  assert.ok(right > x + 0.1 && up > y + 0.1, `${right} ${up}`);
  const things = await page.locator(".floor .thing").count();
  await page.getByRole("button", { name: "crate" }).click();
  assert.equal(await page.locator(".floor .thing").count(), things + 1);
  const crate = page.locator(".floor .loose").last();
  const before = await crate.getAttribute("points");
  await crate.focus();
  await page.keyboard.press("ArrowUp");
  await page.waitForFunction((before) => [...document.querySelectorAll(".floor .loose")].at(-1)!.getAttribute("points") !== before, before);
  const { violations } = await new AxeBuilder({ page }).include(".around").analyze();
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`), []);
  await page.getByRole("button", { name: "Reset the world" }).click();
  assert.equal(await page.locator(".floor .thing").count(), things);
});

inBrowser("during a run the robot and a crate can be dragged, and the camera shows it", { "wall_following.afp": PAPER }, async ({ page }) => {
  await page.locator(".floor .robot").waitFor();
  await page.keyboard.press("F10");
  await page.locator(".clock.held").waitFor();
  const [x] = await poseOf(page);
  await drag(page, ".floor .robot polygon", [-20, 0]);
  await page.keyboard.press("F5");
  await page.locator(".clock.running").waitFor();
  const button = await middle(page, ".drops button >> nth=0");
  const floor = (await page.locator(".floor .ground").boundingBox())!;
  await page.mouse.move(...button);
  await page.mouse.down();
  await page.mouse.move(floor.x + floor.width * 0.4, floor.y + floor.height * 0.85);
  await page.mouse.up();
  await page.locator(".floor .loose").waitFor();
  const [where] = await middle(page, ".floor .loose");
  await drag(page, ".floor .loose", [12, 0]);
  await page.waitForFunction((x) => document.querySelector(".floor .loose")!.getBoundingClientRect().x > x, where - 2);
  await page.waitForTimeout(300);
  assert.ok((await poseOf(page))[0] < x - 0.05);
  await page.getByRole("button", { name: "Camera" }).click();
  await page.waitForFunction(() => document.querySelector<HTMLCanvasElement>(".camera canvas")!.width > 20);
  const seen = await page.evaluate(() => {
    const canvas = document.querySelector<HTMLCanvasElement>(".camera canvas")!;
    return new Set(canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height).data).size;
  });
  assert.ok(seen > 4, `${seen} shades`);
  await page.getByRole("button", { name: "Camera" }).click();
  await page.keyboard.press("Shift+F5");
  await page.locator(".end-card").waitFor();
});
