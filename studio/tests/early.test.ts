// First appearance: the page is painted in its final state and accepts typing immediately.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import type { Page } from "playwright-core";
import { inBrowser } from "./browser";

const PAPER = await readFile(new URL("../../plans/wall_following.afp", import.meta.url), "utf8");
const PLAN = "use carbot\n\nplan P {\n    start go\n\n    actor go: Forward {\n        ForwardSuccessful -> terminate\n    }\n}\n";

/** Types into a field as soon as it exists, and presses `Enter` a while later. */
const typeAtOnce = (page: Page, selector: string, text: string): Promise<void> =>
  page.evaluate(([selector, text]) => {
    const watch = new MutationObserver(() => {
      const field = document.querySelector<HTMLInputElement>(selector!);
      if (!field) return;
      watch.disconnect();
      field.value = text!;
      field.dispatchEvent(new Event("input", { bubbles: true }));
      setTimeout(() => field.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true })), 500);
    });
    watch.observe(document.body, { childList: true, subtree: true });
  }, [selector, text] as const);

inBrowser("a name typed as soon as its field opens is accepted", { "plan.afp": PLAN }, async ({ page, becomes }) => {
  await page.locator('.node [data-item="P.go"]').waitFor();
  await page.locator(".inspector-head strong", { hasText: /^P$/ }).waitFor();
  await typeAtOnce(page, ".inspector:has(button.field) .line input", "roll");
  await page.locator('.node [data-item="P.go"] rect.box.actor').click({ force: true });
  await becomes("plan.afp", /actor roll: Forward/);
});

inBrowser("the robot is first shown at its start", { "wall_following.afp": PAPER }, async ({ page }) => {
  await page.locator(".floor .robot").waitFor();
  await page.addInitScript(() => {
    const watch = new MutationObserver(() => {
      const robot = document.querySelector(".floor .robot");
      if (!robot) return;
      watch.disconnect();
      document.documentElement.dataset.early = robot.getAttribute("transform") ?? "nowhere";
    });
    watch.observe(document, { childList: true, subtree: true });
  });
  await page.reload();
  await page.locator("[data-early]").waitFor();
  assert.match((await page.locator("html").getAttribute("data-early"))!, /^translate\(.+\) rotate/);
});
