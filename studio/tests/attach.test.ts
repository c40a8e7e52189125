// The studio attached to a robot: the real driver on a pseudo-terminal, with a stand-in for the
// robot's controller.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import AxeBuilder from "@axe-core/playwright";
import type { Page } from "playwright-core";
import { nearest } from "../page/debug/attached";
import { inBrowser, shows } from "./browser";
import { DRIVE, Robot } from "./driven";
import { looksLike } from "./pictures";

async function ask(page: Page, place: string): Promise<void> {
  await page.getByRole("button", { name: "Files" }).click();
  await page.getByRole("menuitem", { name: "Attach to a robot" }).click();
  await page.locator("dialog input").fill(place);
}

async function attach(page: Page, place: string): Promise<void> {
  await ask(page, place);
  await page.getByRole("button", { name: "Attach", exact: true }).click();
}

const element = (page: Page, name: string) => page.locator(`.node [data-item="Drive.${name}"] text.name`).first();

test("the file whose path ends like the robot's is its file here", () => {
  const here = ["/home/me/a/plans/drive.afp", "/home/me/a/drive.afp", "/home/me/b.afp"];
  assert.equal(nearest("/var/lib/afp/1/plans/drive.afp", here), here[0]);
  assert.equal(nearest("/srv/drive.afp", here), here[0]);
  assert.equal(nearest("/srv/other.afp", here), null);
});

inBrowser("a breakpoint in the drawing holds a robot, the page explains it, and anybody stops the robot", { "plans/drive.afp": DRIVE }, async ({ page }) => {
  const robot = new Robot();
  try {
    await robot.begin();
    await robot.wheels("turn");
    await element(page, "rest").click({ force: true });
    await page.keyboard.press("F9");
    await page.locator("circle.breakpoint").waitFor();
    await attach(page, robot.socket);
    const bar = page.locator(".robot-bar");
    await shows(bar, /Attached to .*\.sock/);
    await page.locator(".robot-bar.held").waitFor({ timeout: 30_000 });
    await shows(bar, /is held \(.*rest/);
    await robot.wheels("stop");
    await page.locator(".run-active.held").first().waitFor({ state: "attached" });
    await page.waitForFunction(() => /[1-9]/.test(document.querySelector(".run-value-text")?.textContent ?? ""));
    await page.locator(".lane.flow rect").first().waitFor();
    await element(page, "rest").click({ force: true });
    await page.keyboard.press("w");
    await shows(page.locator(".why-card"), /Why rest\?[^]*count\.Again/);
    await shows(page.locator(".world"), /real world[^]*odometry/);
    // A robot has no speed, and cannot go back.
    assert.equal(await page.getByLabel("Speed").count(), 0);
    assert.equal(await page.getByRole("button", { name: /To the element before|Run again|Into the sub-plan/ }).count(), 0);
    const { violations } = await new AxeBuilder({ page }).include(".robot-bar").analyze();
    assert.deepEqual(violations.map(({ id }) => id), []);
    // The times of a real run differ, so that the picture of the book is only made.
    if (process.env.AFP_BLESS) {
      await bar.locator("strong").evaluate((node) => (node.textContent = "Attached to afp@robot.local:"));
      await looksLike(page, "docs/images/attached.png");
    }
    // Forced for a while, also while it drives.
    await page.keyboard.press("Control+Shift+U");
    await page.getByRole("button", { name: "Force rounds" }).click();
    await page.getByLabel("Value of rounds").fill("7");
    await page.getByRole("button", { name: "Force", exact: true }).click();
    await page.locator(".forced-bar", { hasText: "rounds = 7" }).waitFor();
    await page.getByRole("button", { name: "Release" }).click();
    await page.locator(".forced-bar").waitFor({ state: "detached" });
    // A step lasts while its key is pressed.
    await element(page, "rest").click({ force: true });
    await page.keyboard.press("F9");
    await page.locator("circle.breakpoint").waitFor({ state: "detached" });
    await page.keyboard.down("F10");
    await shows(bar, /is held \(.*ahead/);
    await page.keyboard.up("F10");
    await robot.wheels("stop");
    await bar.getByRole("button", { name: "Continue" }).click();
    await robot.wheels("turn");
    await page.locator(".robot-bar:not(.held)").waitFor();
    await bar.getByRole("button", { name: "Hold" }).click();
    await page.locator(".robot-bar.held").waitFor();
    await robot.wheels("stop");
    await bar.getByRole("button", { name: "Continue" }).click();
    await robot.wheels("turn");
    await bar.getByRole("button", { name: "Stop" }).click();
    await shows(page.locator(".end-card"), /was interrupted[^]*by the studio/);
    assert.equal(await bar.count(), 0);
    assert.equal(await robot.ends(), 0);
    await robot.wheels("stop");
  } finally {
    await robot.end();
  }
}, { viewport: { width: 1400, height: 880 }, timeout: 200_000 });

inBrowser("a robot drives on without the page, and one page operates it", { "plans/drive.afp": DRIVE }, async ({ page, folder }) => {
  const robot = new Robot();
  try {
    await attach(page, join(folder, "nothing.sock"));
    await shows(page.locator(".banner.error"), /cannot attach to .*nothing\.sock/);
    await ask(page, "exec:touch /tmp/x");
    await shows(page.locator("dialog"), /Write a host/);
    await page.getByRole("button", { name: "Cancel" }).click();
    await robot.begin();
    await attach(page, robot.socket);
    const bar = page.locator(".robot-bar");
    await bar.getByRole("button", { name: "Hold" }).click();
    await page.locator(".robot-bar.held").waitFor();
    await robot.wheels("stop");
    const other = await page.context().newPage();
    await other.goto(page.url());
    await element(other, "rest").waitFor();
    await attach(other, robot.socket);
    await shows(other.locator(".robot-bar.held"), /the studio operates it/);
    assert.equal(await other.getByRole("button", { name: "Continue" }).count(), 0);
    await other.getByRole("button", { name: "Take control" }).click();
    await shows(bar, /the studio operates it/);
    await other.getByRole("button", { name: "Continue" }).click();
    await robot.wheels("turn");
    await page.locator(".robot-bar:not(.held)").waitFor();
    await other.getByRole("button", { name: "Detach" }).click();
    await other.locator(".robot-bar").waitFor({ state: "detached" });
    await page.reload();
    await element(page, "rest").waitFor();
    assert.equal(await page.locator(".banner", { hasText: "has ended" }).count(), 0);
    await robot.wheels("turn");
    await attach(page, robot.socket);
    await bar.getByRole("button", { name: "Stop" }).click();
    assert.equal(await robot.ends(), 0);
  } finally {
    await robot.end();
  }
}, { timeout: 200_000, ignore: /cannot attach/ });
