// Two users in one folder: one edits, the other watches, and may take over.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser } from "./browser";

const PLAN = "use carbot\n\nplan P {\n    start go\n    actor go: Forward { ForwardSuccessful -> terminate }\n}\n";

const openText = async (page: Page): Promise<void> => {
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-content").waitFor();
};

const type = async (page: Page, words: string): Promise<void> => {
  // A background page draws no frames.
  await page.bringToFront();
  await page.locator(".cm-line", { hasText: "start go" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(words);
};

inBrowser("one page edits and the other watches; taking the edit lock starts a new history", { "plan.afp": PLAN }, async ({ page, holds }) => {
  await openText(page);
  const other = await page.context().newPage();
  await other.goto(new URL("/", page.url()).href);
  // The browser remembers the open panes.
  await other.locator(".cm-content").waitFor();
  const banner = (who: Page) => who.getByText("Another window edits this folder. This one is read-only.");
  await banner(other).waitFor();
  await type(page, " // one");
  await other.locator(".cm-line", { hasText: "start go // one" }).waitFor();
  await type(other, " // two");
  await holds("plan.afp", PLAN.replace("start go", "start go // one"));
  assert.equal(await other.locator(".cm-line", { hasText: "two" }).count(), 0);

  await other.getByRole("button", { name: "Edit here" }).click();
  await banner(page).waitFor();
  await banner(other).waitFor({ state: "detached" });
  await other.getByRole("button", { name: "Nothing to undo" }).waitFor();
  await type(other, " // two");
  await holds("plan.afp", PLAN.replace("start go", "start go // one // two"));
  await page.locator(".cm-line", { hasText: "// two" }).waitFor();
  await type(page, " // three");
  assert.equal(await page.locator(".cm-line", { hasText: "three" }).count(), 0);
  // A reloaded page keeps the edit lock.
  await other.reload();
  await other.locator(".cm-line", { hasText: "// two" }).waitFor();
  assert.deepEqual([await banner(page).count(), await banner(other).count()], [1, 0]);
  await other.close();
  await banner(page).waitFor({ state: "detached" });
  await type(page, " // four");
  await holds("plan.afp", PLAN.replace("start go", "start go // one // two // four"));
});
