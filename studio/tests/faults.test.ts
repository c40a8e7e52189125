// Problems of beginners, reproduced with real mouse and keys.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser, shows } from "./browser";
import { middle, name } from "./spots";

const PLAN = `use carbot

plan P {
    start go

    actor go: Forward {
    }

    actor turn: Turn(angle = 90 deg) {
        TurnSuccessful -> terminate
    }
}
`;

const ready = (page: Page, item: string): Promise<void> => page.locator(`.node [data-item="${item}"]`).first().waitFor();

inBrowser("the question mark of an open exit offers targets", { "plan.afp": PLAN }, async ({ page }) => {
  await ready(page, "P.go");
  await page.mouse.click(...(await middle(page, '.node [data-item="P.go"] text.nowhere')));
  await shows(page.locator(".chooser-title"), /ForwardSuccessful/);
});

const OUTER = `use "parts.afp"

plan Outer {
    start inner
    subplan inner: Inner { OK -> terminate }
}
`;
const PARTS = `use carbot

plan Inner {
    start go
    actor go: Forward { ForwardSuccessful -> terminate }
}
`;

inBrowser("a sub-plan of another file is entered by a double click, and left by Backspace or Back", { "outer.afp": OUTER, "parts.afp": PARTS }, async ({ page, read }) => {
  await ready(page, "Outer.inner");
  await page.mouse.dblclick(...(await middle(page, name("Outer.inner"))));
  await ready(page, "Inner.go");
  await shows(page.locator(".crumbs"), /Outer/);
  await page.locator(".board").focus();
  await page.keyboard.press("Backspace");
  await ready(page, "Outer.inner");
  await page.locator(".board").focus();
  for (const key of ["Home", "ArrowDown", "Control+Enter"]) await page.keyboard.press(key);
  await ready(page, "Inner.go");
  await page.goBack();
  await ready(page, "Outer.inner");
  assert.deepEqual([await read("outer.afp"), await read("parts.afp")], [OUTER, PARTS]);
}, { open: "outer.afp" });

inBrowser("errors in an imported file are errors of the plan, which does not run", { "outer.afp": OUTER, "parts.afp": PARTS.replace("-> terminate", "-> nowhere") }, async ({ page }) => {
  await ready(page, "Outer.inner");
  await shows(page.locator(".count"), /1 error/);
  await page.keyboard.press("F5");
  await shows(page.locator(".banner.error"), /error/);
  assert.doesNotMatch(await page.locator(".banners").innerText(), /-->|\^\^/);
}, { open: "outer.afp" });

inBrowser("a new plan has an unused name, and an invalid name is explained", { "plan.afp": PLAN }, async ({ page }) => {
  await ready(page, "P.go");
  await page.keyboard.press("Control+k");
  await page.keyboard.type("new plan");
  await page.keyboard.press("Enter");
  const field = page.locator("dialog input");
  assert.equal(await field.inputValue(), "plan_2");
  await field.fill("plan");
  await shows(page.locator("dialog .wrong"), /plan\.afp/);
});

const LONG = "APlanWithANameThatIsSoLongThatNobodyWouldEverWantToReadAllOfItInABarOfAnyStudioAtAll";

inBrowser("a long name of a plan leaves room for the button that runs it", { "plan.afp": PLAN.replace("plan P", `plan ${LONG}`) }, async ({ page }) => {
  await ready(page, `${LONG}.go`);
  const run = await page.locator(".bar .controls button").first().boundingBox();
  assert.ok(run && run.x + run.width <= 1366, JSON.stringify(run));
  const top = await page.evaluate(([x, y]) => document.elementFromPoint(x!, y!)?.closest(".controls") !== null, [run.x + run.width / 2, run.y + run.height / 2]);
  assert.ok(top, "nothing lies over it");
});

inBrowser("the menu of an element does not cover the element and is completely visible", { "plan.afp": PLAN }, async ({ page }) => {
  await ready(page, "P.turn");
  await page.mouse.click(...(await middle(page, name("P.turn"))), { button: "right" });
  const menu = (await page.locator(".context-menu").boundingBox())!;
  const box = (await page.locator('.node [data-item="P.turn"] rect').first().boundingBox())!;
  const board = (await page.locator(".board").boundingBox())!;
  assert.ok(menu.x >= box.x + box.width || menu.x + menu.width <= box.x, JSON.stringify({ menu, box }));
  assert.ok(menu.y >= board.y && menu.y + menu.height <= board.y + board.height, JSON.stringify({ menu, board }));
});

inBrowser("a drag with the space bar held pans, also over an element", { "plan.afp": PLAN }, async ({ page, read }) => {
  await ready(page, "P.turn");
  await page.locator(".board").focus();
  const [x, y] = await middle(page, name("P.turn"));
  await page.keyboard.down(" ");
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y + 40, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up(" ");
  const now = await middle(page, name("P.turn"));
  assert.ok(Math.hypot(now[0] - x - 60, now[1] - y - 40) < 3, `${now} from ${[x, y]}`);
  await page.waitForTimeout(400);
  assert.equal(await read("plan.afp.layout"), "");
});

inBrowser("a file is renamed, copied, removed and restored; Ctrl+S shows that it is saved", { "plan.afp": PLAN, "plan.afp.layout": "P.go 0 96\n" }, async ({ page, read, holds }) => {
  await ready(page, "P.go");
  const menu = async (item: string): Promise<void> => {
    await page.locator(".bar .file").click();
    await page.getByRole("menuitem", { name: item }).click();
  };
  await page.keyboard.press("Control+s");
  await shows(page.locator(".board-notice"), /saved/);
  await menu("Rename file");
  await page.locator("dialog input").fill("first");
  await page.keyboard.press("Enter");
  await holds("first.afp", PLAN);
  await holds("first.afp.layout", "P.go 0 96\n");
  assert.equal(await read("plan.afp"), "");
  await ready(page, "P.go");
  await menu("Duplicate file");
  await holds("first_2.afp", PLAN);
  await shows(page.locator(".bar .file"), /first_2/);
  await menu("Remove file");
  await shows(page.locator(".banners"), /first_2\.afp/);
  assert.equal(await read("first_2.afp"), "");
  await page.getByRole("button", { name: "Put it back" }).click();
  await holds("first_2.afp", PLAN);
  await holds("first_2.afp.layout", "P.go 0 96\n");
  const saved = page.waitForEvent("download");
  await menu("Download file");
  assert.equal((await saved).suggestedFilename(), "first_2.afp");
}, { acceptDownloads: true });

const TWO = `use carbot

plan P {
    start go
    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }
    actor go: Forward(distance = 2 cm) { ForwardSuccessful -> terminate }
}
`;

inBrowser("the end of a run belongs to its file, and the run has no observers afterwards", { "a.afp": TWO, "b.afp": TWO.replace("plan P", "plan B") }, async ({ page }) => {
  await ready(page, "P.go");
  await page.keyboard.press("F5");
  const card = page.locator(".end-card");
  await card.waitFor({ timeout: 30_000 });
  assert.equal(await page.locator(".run-eye").count(), 0);
  await page.locator(".bar .file").click();
  await page.getByRole("menuitemradio", { name: "b.afp" }).click();
  await ready(page, "B.go");
  await card.waitFor({ state: "detached" });
}, { open: "a.afp" });

inBrowser("a chain of few elements is drawn as a chain", { "plan.afp": PLAN.replace("actor go: Forward {\n    }", "actor go: Forward {\n        ForwardSuccessful -> turn\n    }") }, async ({ page }) => {
  await ready(page, "P.turn");
  const [, first] = await middle(page, name("P.go"));
  const [, second] = await middle(page, name("P.turn"));
  assert.ok(second > first + 60, `${first} ${second}`);
});

inBrowser("the drawing follows a step into a sub-plan and out of it; an active sub-plan is green", { "outer.afp": OUTER, "parts.afp": PARTS.replace("Forward {", "Forward(distance = 5 cm) {") }, async ({ page }) => {
  await ready(page, "Outer.inner");
  await page.locator(".board").focus();
  const inner = page.locator('.node [data-item="Inner.go"]').first();
  for (let steps = 0; steps < 4; steps++) {
    await page.keyboard.press("F11");
    if (await inner.waitFor({ timeout: 2500 }).then(() => true, () => false)) break;
  }
  await inner.waitFor();
  await page.locator(".crumbs button", { hasText: "Outer" }).click();
  await ready(page, "Outer.inner");
  await page.locator('.node.active [data-item="Outer.inner"]').first().waitFor();
}, { open: "outer.afp" });
