// Messages: in the page's terms, at their place, and only as long as the problem exists.
import assert from "node:assert/strict";
import { test } from "node:test";
import { nameFor } from "../page/drawing/first";
import { inBrowser, settled, shows } from "./browser";
import { middle, name } from "./spots";

const PLAN = `use std

plan Inner {
    in pause: duration

    start first

    actor first: Wait(duration = pause) { Elapsed -> terminate }
}

plan Outer {
    start work

    subplan work: Inner(pause = 30 s) { OK -> terminate }
}
`;

inBrowser("a plan that needs a value names it before the run, while the plan is shown", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator('.node [data-item="Inner.first"]').first().waitFor();
  await page.keyboard.press("F5");
  const banner = page.locator(".banner.error");
  await shows(banner, /Inner needs a value for 'pause'\. Give it one here \(`= 1 s`\), or run the plan that uses it\./);
  await page.locator(".marks .ring").first().waitFor();
  assert.equal(await page.locator(".clock").count(), 0);
  await page.getByRole("button", { name: "Plans of this file" }).click();
  await page.getByRole("menuitemradio", { name: "Outer" }).click();
  await banner.waitFor({ state: "detached" });
});

inBrowser("a reloaded page shows its last plan and reports that its run has ended", { "plan.afp": PLAN }, async ({ page }) => {
  const shown = page.locator(".crumbs [aria-current]");
  await page.getByRole("button", { name: "Plans of this file" }).click();
  await page.getByRole("menuitemradio", { name: "Outer" }).click();
  await page.locator('.node [data-item="Outer.work"]').first().waitFor();
  await page.keyboard.press("F5");
  await page.locator(".clock.running").waitFor();
  await page.reload();
  await page.locator('.node [data-item="Outer.work"]').first().waitFor();
  assert.equal(await shown.innerText(), "Outer");
  await shows(page.locator(".banner.error"), /The run has ended: the page was reloaded/);
  await page.reload();
  await page.locator('.node [data-item="Outer.work"]').first().waitFor();
  assert.equal(await page.locator(".banner.error").count(), 0);
});

inBrowser("an error does not move the cursor, and its message disappears with the error", { "plan.afp": PLAN.replace("start work", "start best") }, async (studio) => {
  const { page } = studio;
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".count", { hasText: "error" }).waitFor();
  await page.locator(".cm-line", { hasText: "use std" }).click();
  await page.keyboard.press("End");
  await page.keyboard.press("F5");
  const banner = page.locator(".banner.error", { hasText: "Nothing was run: the plan has 1 error" });
  await banner.waitFor();
  await page.locator(".cm-shown", { hasText: "best" }).waitFor();
  await page.keyboard.type(" // here");
  await studio.becomes("plan.afp", /^use std \/\/ here\n/);
  await page.locator(".cm-line", { hasText: "start best" }).click();
  await page.keyboard.press("End");
  for (const _ of "best") await page.keyboard.press("Backspace");
  await page.keyboard.type("work");
  await banner.waitFor({ state: "detached" });
});

inBrowser("an observer can also run the plan", { "plan.afp": PLAN.replace("pause: duration", "pause: duration = 30 s") }, async ({ page }) => {
  await page.locator('.node [data-item="Inner.first"]').first().waitFor();
  const other = await page.context().newPage();
  const wrong: string[] = [];
  other.on("pageerror", (why) => wrong.push(String(why)));
  await other.goto(new URL("/", page.url()).href);
  await other.getByText("Another window edits this folder. This one is read-only.").waitFor();
  await other.locator('.node [data-item="Inner.first"]').first().waitFor();
  await other.keyboard.press("F5");
  await other.locator(".clock.running").waitFor();
  assert.deepEqual(wrong, []);
});

inBrowser("the list of keys is complete from the start", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator('.node [data-item="Inner.first"]').first().waitFor();
  await page.keyboard.press("?");
  await page.locator(".keys h2:focus").waitFor();
  assert.equal(await page.locator(".keys").evaluate((dialog) => dialog.scrollTop), 0);
  await page.keyboard.press("Escape");
  await page.locator(".keys").waitFor({ state: "detached" });
});

inBrowser("an invalid name is explained and stays for correction wherever the focus moves", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await page.locator('.node [data-item="Inner.first"]').first().waitFor();
  await page.mouse.dblclick(...(await middle(page, name("Inner.first"))));
  const field = page.locator("input.rename");
  await field.fill("größe");
  await page.keyboard.press("Enter");
  await shows(page.locator(".board-notice"), /'größe' cannot be a name/);
  await page.mouse.click(...(await middle(page, ".count")));
  assert.equal(await field.inputValue(), "größe");
  await field.fill("groesse");
  await page.keyboard.press("Enter");
  await studio.becomes("plan.afp", /actor groesse: Wait/);
  // Escape cancels it, wherever the focus is.
  await page.mouse.dblclick(...(await middle(page, name("Inner.groesse"))));
  await field.fill("1x");
  await page.mouse.click(...(await middle(page, ".count")));
  await page.locator(".board").focus();
  await page.keyboard.press("Escape");
  await field.waitFor({ state: "detached" });
  // Also for an entry.
  await page.locator(".board").focus();
  await page.keyboard.press("e");
  await page.locator("dialog").getByLabel("Name").fill("größe");
  await shows(page.locator("dialog .wrong"), /'größe' cannot be a name/);
  assert.ok(await page.locator("dialog").getByRole("button", { name: "Add an entry" }).isDisabled());
  await page.keyboard.press("Escape");
});

inBrowser("a file without a plan gets one by a button or by its first element", { "wall_following.afp": "use std\n" }, async (studio) => {
  const { page } = studio;
  await page.getByRole("button", { name: "Start a plan" }).click();
  await studio.holds("wall_following.afp", "use std\n\nplan WallFollowing {}\n");
  await page.locator(".first-place").waitFor();
  await page.locator(".board").focus();
  await page.keyboard.press("Control+z");
  await page.getByRole("button", { name: "Start a plan" }).waitFor();
  await page.locator("[data-template=Wait]").click();
  await studio.becomes("wall_following.afp", /^use std\n\nplan WallFollowing \{\n    start wait\n\n    actor wait: Wait \{\}\n\}\n$/);
  assert.match(await settled(() => page.locator(".crumbs").innerText(), (now) => now !== ""), /WallFollowing/);
});

test("a plan has the name of its file", () => {
  assert.deepEqual(["wall_following.afp", "plans/my-first plan.afp", "2nd.afp", "größe.afp", "A.afp"].map(nameFor), ["WallFollowing", "MyFirstPlan", "2nd", "Größe", "A"]);
});
