// The page in use: opening, typing, errors, saved state, undo, changes by others.
import assert from "node:assert/strict";
import AxeBuilder from "@axe-core/playwright";
import type { Page } from "playwright-core";
import { inBrowser, shows } from "./browser";

const PLAN = `use carbot

plan P {
    start go
    actor go: Forward { ForwardSuccessful -> terminate }
}
`;

const openText = async (page: Page): Promise<void> => {
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-content").waitFor();
};

const lines = (page: Page): Promise<string[]> => page.locator(".cm-line").allInnerTexts();

inBrowser("a user opens, types, sees errors and 'saved'; undo restores the bytes", { "plan.afp": PLAN }, async ({ page, holds, isSaved }) => {
  await openText(page);
  assert.equal(await page.title(), "plan.afp · AFP Studio");
  await page.locator(".count", { hasText: "ready" }).waitFor();
  await page.locator(".cm-line", { hasText: "start go" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type("ne");
  await page.locator(".cm-lintRange-error").waitFor();
  await page.locator(".count", { hasText: "1 error" }).waitFor();
  await holds("plan.afp", PLAN.replace("start go", "start gone"));
  await isSaved();
  await page.locator(".count").click();
  await page.locator(".problems li", { hasText: "gone" }).waitFor();
  await page.getByRole("button", { name: "Undo: typing" }).click();
  await holds("plan.afp", PLAN);
  await page.locator(".count", { hasText: "ready" }).waitFor();
  await page.locator(".cm-content").focus();
  await page.keyboard.press("Control+Shift+z");
  await holds("plan.afp", PLAN.replace("start go", "start gone"));
  await page.keyboard.press("Control+z");
  await holds("plan.afp", PLAN);
});

inBrowser("the history survives a reload, but not a change of another program", { "plan.afp": PLAN }, async ({ page, write, holds, isSaved }) => {
  await openText(page);
  await page.locator(".cm-line", { hasText: "start go" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type("ne");
  const typed = PLAN.replace("start go", "start gone");
  await holds("plan.afp", typed);
  await page.reload();
  await page.getByRole("button", { name: "Undo: typing" }).click();
  await holds("plan.afp", PLAN);
  await page.getByRole("button", { name: "Redo: typing" }).click();
  await holds("plan.afp", typed);
  await isSaved();
  await page.goto("about:blank");
  await write("plan.afp", PLAN);
  // The folder is checked twice a second.
  await page.waitForTimeout(1200);
  await page.goBack();
  await page.locator(".count", { hasText: "ready" }).waitFor();
  await page.getByRole("button", { name: "Nothing to undo" }).waitFor();
});

inBrowser("opening a file changes no byte for any line endings", { "plan.afp": `\ufeff${PLAN.replaceAll("\n", "\r\n")}` }, async ({ page, holds, isSaved }) => {
  await openText(page);
  await isSaved();
  await holds("plan.afp", `\ufeff${PLAN.replaceAll("\n", "\r\n")}`);
  await page.locator(".cm-line", { hasText: "start go" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(" // first");
  await holds("plan.afp", `\ufeff${PLAN.replace("start go", "start go // first").replaceAll("\n", "\r\n")}`);
});

inBrowser("a change of another program arrives; undoing it asks first", { "plan.afp": PLAN }, async ({ page, write, holds, isSaved }) => {
  await openText(page);
  const theirs = PLAN.replace("plan P {", "/// Theirs.\nplan P {");
  await write("plan.afp", theirs);
  await page.locator(".cm-line", { hasText: "Theirs." }).waitFor();
  await isSaved();
  await page.keyboard.press("Control+z");
  await page.getByRole("dialog").getByRole("button", { name: "Cancel" }).click();
  assert.ok((await lines(page)).some((line) => line.includes("Theirs.")));
  await page.keyboard.press("Control+z");
  await page.getByRole("dialog").getByRole("button", { name: "Undo it" }).click();
  await holds("plan.afp", PLAN);
});

inBrowser("completion inserts an element, a fix removes an error, a name is changed everywhere", { "plan.afp": PLAN.replace("Forward {", "Forwrad {") }, async ({ page, holds }) => {
  await openText(page);
  await page.locator(".count", { hasText: "error" }).click();
  await page.locator(".problems .fix", { hasText: "Forward" }).first().click();
  await holds("plan.afp", PLAN);
  await page.locator(".cm-line", { hasText: "actor go" }).getByText("go", { exact: true }).click();
  await page.keyboard.press("F2");
  await page.getByRole("dialog").getByRole("textbox").fill("drive");
  await page.keyboard.press("Enter");
  await holds("plan.afp", PLAN.replaceAll("go", "drive"));
  await page.locator(".cm-line", { hasText: "actor drive" }).click();
  await page.keyboard.press("End");
  await page.keyboard.press("Enter");
  await page.keyboard.type("Tur");
  await page.locator(".cm-tooltip-autocomplete li", { hasText: "Turn" }).first().click();
  await page.locator(".cm-line", { hasText: "TurnSuccessful ->" }).waitFor();
  await shows(page.locator(".cm-content"), /\n    actor turn: Turn \{\n        TurnSuccessful -> /);
  // The element, then the line with the typed text.
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await holds("plan.afp", PLAN.replaceAll("go", "drive"));
});

inBrowser("an empty folder stays empty until the user creates a plan by name or from an example", {}, async ({ page, read, holds }) => {
  await page.getByRole("heading", { name: /^No plan in/ }).waitFor();
  assert.equal(await read("plan.afp"), "");
  await page.getByRole("button", { name: /Your first plan/ }).click();
  await holds("plan.afp", "use carbot\n\nplan Plan {\n}\n");
  await page.locator(".bar .file", { hasText: "plan.afp" }).waitFor();
  await page.getByRole("button", { name: "Files" }).click();
  await page.getByRole("menuitem", { name: "New plan" }).click();
  await page.getByRole("dialog").getByRole("textbox").fill("plan");
  assert.ok(await page.getByRole("button", { name: "Create" }).isDisabled());
  await page.getByRole("dialog").getByRole("textbox").fill("night_watch");
  await page.keyboard.press("Enter");
  await holds("night_watch.afp", "use carbot\n\nplan NightWatch {\n}\n");
  await page.locator(".bar .file", { hasText: "night_watch.afp" }).waitFor();
});

for (const colorScheme of ["light", "dark"] as const) {
  const files = { "plan.afp": PLAN.replace("start go", "start gone") };
  inBrowser(`axe finds no serious problem, ${colorScheme}`, files, async ({ page }) => {
    const clean = async (where: string): Promise<void> => {
      const axe = new AxeBuilder({ page });
      // Light and dark mode differ only in colours.
      const { violations } = await (colorScheme === "dark" ? axe.withRules(["color-contrast"]) : axe).analyze();
      const bad = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
      assert.deepEqual(bad.map(({ id, nodes }) => `${where}: ${id}: ${nodes.map((node) => node.html).join(" ")}`), []);
    };
    await openText(page);
    await page.locator(".count", { hasText: "error" }).click();
    await page.locator(".problems li").first().waitFor();
    await clean("text and problems");
    await page.getByRole("button", { name: /^Explain E\d+/ }).first().click();
    await page.locator("dialog.book").waitFor();
    await clean("a page of the book");
    await page.keyboard.press("Escape");
    await page.locator("dialog.book").waitFor({ state: "detached" });
    await page.locator(".rail button", { hasText: "Inspector" }).click();
    await clean("inspector");
    await page.getByRole("button", { name: "Files" }).click();
    await clean("files");
    await page.keyboard.press("Escape");
    await page.keyboard.press("Control+k");
    await page.getByRole("combobox", { name: "Type the name of a command" }).waitFor();
    await clean("commands");
    await page.keyboard.press("Escape");
    await page.keyboard.press("?");
    await page.getByRole("heading", { name: "Keys" }).waitFor();
    await clean("keys");
  }, { colorScheme });
}

inBrowser("an error code opens its page, with both examples", { "plan.afp": PLAN.replace("start go", "start gone") }, async ({ page }) => {
  await page.locator(".count", { hasText: "error" }).click();
  const button = page.getByRole("button", { name: /^Explain E\d+/ }).first();
  const code = await button.textContent();
  await button.click();
  const book = page.getByRole("dialog", { name: `Explain ${code}` });
  await book.getByRole("heading", { name: new RegExp(`^${code}:`) }).waitFor();
  assert.ok((await book.locator("pre").count()) >= 2);
  await book.getByRole("button", { name: "Close" }).click();
  await book.waitFor({ state: "detached" });
  await page.waitForFunction((text) => document.activeElement?.textContent === text, code);
});

inBrowser("a template has a page with all of its ports and states", { "plan.afp": PLAN.replace("Forward {", "Forward(\n        // : Turn\n        distance = 1 m\n    ) {") }, async ({ page }) => {
  await page.locator('.node [data-item$=".go"] text.name').first().click({ force: true });
  await page.getByRole("button", { name: "All about Forward" }).click();
  const book = page.getByRole("dialog", { name: "All about Forward" });
  await book.getByText("Drive straight ahead").waitFor();
  await book.getByRole("listitem").filter({ hasText: "ForwardSuccessful" }).waitFor();
  await page.keyboard.press("Escape");
  await book.waitFor({ state: "detached" });
});

/** The focused element after a key and before the next frame. */
const focusAfter = (page: Page, init: { key: string; ctrlKey?: boolean }): Promise<string | null> =>
  page.evaluate(async (init) => {
    document.activeElement!.dispatchEvent(new KeyboardEvent("keydown", { ...init, bubbles: true, cancelable: true }));
    await new Promise((done) => queueMicrotask(() => queueMicrotask(() => done(null))));
    return document.activeElement!.getAttribute("role");
  }, init);

inBrowser("a dialog opened by a key receives the next key", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator(".count", { hasText: "ready" }).waitFor();
  assert.equal(await focusAfter(page, { key: "k", ctrlKey: true }), "combobox");
  await page.keyboard.press("Escape");
  await page.locator(".board").focus();
  assert.equal(await focusAfter(page, { key: "a" }), "combobox");
});

inBrowser("keys reach every pane; commands are found by name", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator(".count", { hasText: "ready" }).waitFor();
  await page.keyboard.press("Control+k");
  await page.keyboard.type("text");
  await page.keyboard.press("Enter");
  await page.locator(".cm-content:focus").waitFor();
  await page.keyboard.press("Control+Shift+M");
  await page.locator(".pane.bottom").waitFor();
  const reached = new Set<string>();
  // The full circle: bar, palette, drawing, world, text and problems.
  for (let step = 0; step < 6; step++) {
    await page.keyboard.press("F6");
    reached.add(await page.evaluate(() => document.activeElement?.closest("[data-pane], .bar")?.getAttribute("aria-label") ?? "bar"));
  }
  assert.ok(["bar", "Palette", "Drawing", "World", "Text", "Problems"].every((pane) => reached.has(pane)), [...reached].join());
});

inBrowser("an invalid name is explained in the drawing and the inspector, and stays there for correction", { "plan.afp": PLAN }, async ({ page, read }) => {
  const node = page.locator('.node [data-item="P.go"] text.name').first();
  const { x, y } = (await node.boundingBox())!;
  await page.mouse.click(x + 5, y + 5);
  for (const wrong of ["größe", "a b", "1x"]) {
    await page.locator("[role=application]").focus();
    await page.keyboard.press("F2");
    const field = page.locator("input.rename");
    await field.fill(wrong);
    await page.keyboard.press("Enter");
    await page.locator(".board-notice", { hasText: "cannot be a name" }).waitFor();
    assert.equal(await field.inputValue(), wrong, "it can be mended");
    await page.keyboard.press("Escape");
    await field.waitFor({ state: "detached" });
  }
  const line = page.locator(".inspector .line", { hasText: "Name" }).locator("input");
  await line.fill("1x");
  await page.keyboard.press("Enter");
  await line.and(page.locator("[aria-invalid=true]")).waitFor();
  assert.equal(await line.inputValue(), "1x");
  await page.keyboard.press("Escape");
  assert.equal(await line.inputValue(), "go");
  assert.equal(await read("plan.afp"), PLAN);
});
