// Sensor values during a run: on the floor, as a list, as curves.
import AxeBuilder from "@axe-core/playwright";
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { inBrowser, shows } from "./browser";

const PAPER = await readFile(new URL("../../plans/wall_following.afp", import.meta.url), "utf8");

inBrowser("sensor readings are shown on the floor, in a list and as curves", { "wall_following.afp": PAPER }, async ({ page }) => {
  await page.locator(".floor .robot").waitFor();
  assert.equal(await page.locator(".sensors").count(), 0);
  await page.keyboard.press("F5");
  await page.locator(".floor .cone").waitFor({ state: "attached" });
  await page.getByText("Sensor values").click();
  await shows(page.locator(".sensors"), /ultrasonic\.echo\s+\d[\d.]* c?m[^]*touch\.touched\s+(true|false)/);
  assert.match((await page.locator(".sensors div", { hasText: "touch.touched" }).getAttribute("title")) ?? "", /pressed/);
  await page.keyboard.press("Control+Shift+Y");
  await page.getByLabel("Plot…").selectOption("ultrasonic.echo");
  await page.getByLabel("Plot…").selectOption("walldist");
  await shows(page.locator(".plot-name").first(), /ultrasonic\.echo\s+\d[\d.]* cm/);
  await shows(page.locator(".plot-name").nth(1), /walldist\s+30 cm/);
  await page.waitForFunction(() => document.querySelector(".plot-lane .curve")!.getAttribute("d")!.length > 60);
  const { violations } = await new AxeBuilder({ page }).include(".bottom").include(".world").analyze();
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`), []);
  await page.getByRole("button", { name: "Do not plot walldist" }).click();
  assert.equal(await page.locator(".plot-lane").count(), 1);
  // Another moment shows the values of that time.
  await page.keyboard.press("F8");
  await page.locator(".clock.held").waitFor();
  await page.locator(".ruler").focus();
  await page.keyboard.press("Home");
  await shows(page.locator(".clock"), /^0\.0 s/);
  await page.locator(".floor .cone").waitFor({ state: "detached" });
});
