// Plans that are renamed or removed while they are shown.
import assert from "node:assert/strict";
import { inBrowser, shows } from "./browser";

const plan = (name: string, element: string): string => `\nplan ${name} {\n    start ${element}\n    actor ${element}: Wait { Elapsed -> terminate }\n}\n`;
const TEXT = `use std\n${plan("A", "one")}${plan("B", "two")}`;

inBrowser("renaming or removing a shown plan updates its drawing", { "plan.afp": TEXT }, async ({ page, write, isSaved, becomes }) => {
  const board = page.locator(".board");
  const crumbs = page.locator(".crumbs");
  await page.locator('.node [data-item="A.one"]').first().waitFor();
  await page.locator(".rail button", { hasText: "Text" }).click();
  await crumbs.getByRole("button", { name: "A" }).click();
  await page.getByRole("menuitemradio", { name: "B" }).click();
  await page.locator('.node [data-item="B.two"]').first().waitFor();
  await page.locator(".cm-line", { hasText: "plan B" }).click();
  await page.keyboard.press("End");
  for (const key of ["ArrowLeft", "ArrowLeft", "Backspace", "C"]) await page.keyboard.press(key);
  await page.locator('.node [data-item="C.two"]').first().waitFor();
  await shows(crumbs, /C/);
  // The requested plan is shown.
  await board.focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("f");
  await becomes("plan.afp", /plan C/);
  await page.getByRole("button", { name: /^Undo: (typing|deleting)/ }).click();
  await page.getByRole("button", { name: /^(Undo: (typing|deleting)|Nothing to undo)/ }).click({ timeout: 1000 }).catch(() => {});
  await page.locator('.node [data-item="B.two"]').first().waitFor();
  // Another program removes it: the first plan is shown.
  await isSaved();
  await write("plan.afp", `use std\n${plan("A", "one")}`);
  await page.locator('.node [data-item="A.one"]').first().waitFor();
  assert.equal(await page.locator('.node [data-item="B.two"]').count(), 0);
  await page.locator(".cm-line", { hasText: "start one" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type("x");
  await page.locator(".count", { hasText: "error" }).waitFor();
});
