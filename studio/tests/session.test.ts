// The session of the book's page "Debug a plan", step by step, and its picture.
import type { Page } from "playwright-core";
import { explained, inBrowser, shows } from "./browser";
import { compared, looksLike } from "./pictures";

async function select(page: Page, name: string): Promise<void> {
  const { x, y } = (await page.locator(".node text.name", { hasText: name }).first().boundingBox())!;
  await page.mouse.click(x + 6, y + 6);
}

inBrowser("the session of the book works as described", {}, async ({ page }) => {
  await page.locator(".card", { hasText: "Wall following" }).click();
  await page.locator(".node text.name", { hasText: "backupCollision" }).first().waitFor();
  await page.locator(".floor .robot").waitFor({ state: "attached" });
  await select(page, "backupCollision");
  await page.keyboard.press("F9");
  await page.getByLabel("Speed").selectOption({ label: "5x" });
  await page.keyboard.press("F5");
  await page.locator(".clock.held").waitFor({ timeout: 90_000 });
  await shows(page.locator(".clock"), /^3\.0 s/);
  await page.keyboard.press("w");
  const why = page.locator("section, aside, div", { hasText: /^Why backupCollision\?/ }).first();
  await shows(why, /Active since 3\.010 s/);
  await shows(why, /searchFirstWall\.touch event TouchSensorPressed -> backupCollision/);
  await shows(why, /distance\s+-30 cm/);
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-content").waitFor();
  await explained(page, "LaneNotFree", /in the run: not taken yet/);
  if (compared) {
    await page.waitForTimeout(800);
    await looksLike(page, "docs/images/debug.png");
  }
  await page.mouse.move(2, 2);
  await page.keyboard.press("Shift+F10");
  await page.locator(".run-active.held").waitFor();
  await explained(page, "searchFirstWall", /in the run: active since 0\.000 s/);
}, { viewport: { width: 1400, height: 880 }, timeout: 120_000 });
