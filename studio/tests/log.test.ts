// Logs and jobs in the page: a log is shown like a run; programs of the folder run only after a
// question.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdir } from "node:fs/promises";
import { join } from "node:path";
import { promisify } from "node:util";
import AxeBuilder from "@axe-core/playwright";
import type { Page } from "playwright-core";
import { inBrowser, shows } from "./browser";

const PLAN = `use carbot

plan P {
    start go

    actor go: Forward(distance = 20 cm) { ForwardSuccessful -> turn }
    actor turn: Turn(angle = 90 deg) { TurnSuccessful -> terminate }
}
`;

async function clean(page: Page): Promise<void> {
  const { violations } = await new AxeBuilder({ page }).include(".bottom").analyze();
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(" ")}`), []);
}

inBrowser("a log is shown like a run and cannot be changed", { "plan.afp": PLAN }, async ({ page, folder }) => {
  await mkdir(join(folder, "logs"));
  await promisify(execFile)(process.env.AFPC!, ["run", "plan.afp", "--log", "logs/one.mcap"], { cwd: folder });
  await page.getByRole("button", { name: "Files" }).click();
  await page.getByRole("menuitem", { name: "logs/one.mcap" }).click();
  await page.locator(".lane.flow rect").nth(1).waitFor();
  const robot = page.locator(".floor .robot");
  const begun = await robot.getAttribute("transform");
  await page.locator(".lane.flow rect").nth(1).click();
  await page.waitForFunction((before) => document.querySelector(".floor .robot")!.getAttribute("transform") !== before, begun);
  await page.locator(".run-active").waitFor({ state: "attached" });
  await page.getByText("Sensor values").click();
  await shows(page.locator(".sensors"), /ultrasonic\.echo\s+[\dn][^]*rotator\.bearing\s+-?\d/);
  await page.keyboard.press("Control+Shift+U");
  assert.equal(await page.getByRole("button", { name: /^Force/ }).count(), 0);
});

inBrowser("a log continues in the simulator from a moment, with a changed plan", { "plan.afp": PLAN }, async ({ page, folder, write }) => {
  await promisify(execFile)(process.env.AFPC!, ["run", "plan.afp", "--log", "one.mcap"], { cwd: folder });
  await write("plan.afp", PLAN.replace("90 deg", "45 deg"));
  await page.getByRole("button", { name: "Files" }).click();
  await page.getByRole("menuitem", { name: "one.mcap" }).click();
  // The second element of the log.
  await page.locator(".lane.flow rect").nth(1).click();
  await page.locator('.run-active[data-item="P.turn"], .run-active').first().waitFor({ state: "attached" });
  const begun = await page.locator(".clock").innerText();
  await page.getByRole("button", { name: "Continue in the simulator" }).click();
  await page.locator(".timeline line.forked").waitFor({ state: "attached" });
  await page.getByRole("button", { name: "Continue (F5)" }).or(page.locator("button.run")).first().waitFor();
  assert.equal(await page.locator(".clock").innerText(), begun);
  // The recorded element, and the one that started again.
  await page.waitForFunction(() => document.querySelectorAll(".lane.flow rect").length === 3);
  await page.keyboard.press("F5");
  await shows(page.locator(".end-card"), /finished normally/);
  assert.equal(await page.locator(".end-card code").count(), 0);
});

inBrowser("a new project is created in its own folder, and its plan is shown", {}, async ({ page, read }) => {
  await page.getByRole("button", { name: "Files" }).click();
  await page.getByRole("menuitem", { name: "New project" }).click();
  await page.locator("dialog input").fill("rounds");
  await page.getByRole("button", { name: "Create" }).click();
  await page.locator(".node").first().waitFor();
  assert.notEqual(await read("rounds/afp.toml"), "");
});

inBrowser("jobs that build programs ask once for trust in the folder; panes of jobs are accessible", { "plan.afp": PLAN }, async ({ page, read }) => {
  await page.locator(".count", { hasText: /ready|warning/ }).waitFor();
  await page.locator(".count").click();
  await page.getByRole("tab", { name: "Scenarios" }).click();
  await clean(page);
  await page.getByRole("tab", { name: "Build and sweep" }).click();
  await page.getByRole("button", { name: "Build", exact: true }).click();
  await page.locator("dialog", { hasText: "Do you trust" }).waitFor();
  await page.getByRole("button", { name: "Cancel" }).click();
  assert.equal(await read(".config/afp/trusted"), "");
  await page.getByLabel("Seeds").fill("0..3");
  await page.getByRole("button", { name: "Run many times" }).click();
  await page.locator(".map td button").nth(2).waitFor({ timeout: 30_000 });
  await clean(page);
}, { timeout: 90_000 });

inBrowser("errors of a build are shown at their elements and lead to their text", { "plan.afp": PLAN.replace("TurnSuccessful", "TurnDone") }, async ({ page, write }) => {
  await page.locator(".count", { hasText: "error" }).click();
  await page.getByRole("tab", { name: "Build and sweep" }).click();
  await page.getByRole("button", { name: "Build", exact: true }).click();
  await page.getByRole("button", { name: "Trust it" }).click();
  const wrong = page.getByRole("list", { name: "Errors of the build" }).getByRole("listitem");
  await wrong.filter({ hasText: "TurnDone" }).waitFor({ timeout: 30_000 });
  await wrong.filter({ hasText: "plan.afp 7:" }).first().waitFor();
  const [frame, box] = [await page.locator(".failed-frame").boundingBox(), await page.locator('[aria-label*="turn"]').first().boundingBox()];
  assert.ok(frame && box && frame.x < box.x + box.width && box.x < frame.x + frame.width, JSON.stringify([frame, box]));
  await clean(page);
  await wrong.first().getByRole("button").first().click();
  await page.locator(".marks .ring").first().waitFor({ state: "attached" });
  await wrong.first().getByRole("button", { name: /^Explain E\d+/ }).click();
  await page.getByRole("dialog", { name: /^Explain E\d+/ }).waitFor();
  // A changed text has other errors.
  await write("plan.afp", PLAN);
  await page.locator(".failed-frame").waitFor({ state: "detached" });
}, { timeout: 90_000 });
