// Beginners with their first plan: each test with real mouse and keys.
import AxeBuilder from "@axe-core/playwright";
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser, settled, shows } from "./browser";
import { large } from "./large";
import { fillEntry, middle, name } from "./spots";

const PLAN = `use carbot

plan P {
    var gap: length = 20 cm
    var n: int = 0

    start go

    actor go: Forward(distance = 2 cm) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> again }
        ForwardSuccessful -> turn
    }

    actor turn: Turn(angle = 90 deg) {
        TurnSuccessful -> terminate
    }

    computation again: Next(value = n, next => n) {
        Again -> go
        Done  -> terminate
    }
}

computation Next {
    in  value: int = 0
    out next:  int
    state Again when value < 3 { next = value + 1 }
    state Done {}
}
`;

const ready = (page: Page, item: string): Promise<void> => page.locator(`.node [data-item="${item}"]`).first().waitFor();

/** Opens the value of a port in the inspector. */
async function value(page: Page, item: string, port: string): Promise<void> {
  await page.mouse.click(...(await middle(page, name(item))));
  await page.locator(".inspector .row", { hasText: port }).click();
  await page.locator(".inspector .value").waitFor();
}

inBrowser("a new plan is empty and has no errors", {}, async ({ page }) => {
  await page.getByRole("button", { name: /Your first plan/ }).click();
  await shows(page.locator(".count"), /^empty/);
  assert.equal(await page.locator(".bar .severity, .inspector .severity").count(), 0);
  await page.keyboard.press("F5");
  await shows(page.locator(".banner.error"), /empty/);
  // The card of the guide is above the drawing, and covers nothing of it.
  const [card, board] = [(await page.locator(".guide-card").boundingBox())!, (await page.locator(".board").boundingBox())!];
  assert.ok(card.y + card.height <= board.y + 0.5, JSON.stringify({ card, board }));
  await page.locator("[data-template=Forward]").click();
  await shows(page.locator(".count"), /1 error/);
  await page.locator(".banner.error").waitFor({ state: "detached" });
});

inBrowser("the map makes room for the selected element", { "plan.afp": large(30) }, async ({ page }) => {
  const map = page.locator(".minimap");
  await map.waitFor();
  const nodes = page.locator(".nodes .node .box");
  const box = (await map.boundingBox())!;
  await page.locator(".board").focus();
  const meets = (one: typeof box, two: typeof box): boolean => one.x < two.x + two.width && two.x < one.x + one.width && one.y < two.y + two.height && two.y < one.y + one.height;
  // Pans until an element is below the map, and selects it by its visible corner.
  for (let tries = 0; tries < 60; tries++) {
    for (const node of await nodes.all()) {
      const rect = await node.boundingBox();
      if (!rect || !meets(rect, box) || rect.x + 4 > box.x || rect.y < 60 || rect.x < 230) continue;
      await page.mouse.click(rect.x + 3, rect.y + rect.height / 2);
      await page.locator(".marks .ring").first().waitFor();
      const up = (await map.boundingBox())!;
      assert.ok(!meets(rect, up), JSON.stringify({ rect, up }));
      return;
    }
    await page.keyboard.press(tries % 2 ? "Shift+ArrowRight" : "Shift+ArrowDown");
  }
  assert.fail("no element was near the map");
});

inBrowser("a form adds an entry, and buttons add the sign and an operation of a formula", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await ready(page, "P.go");
  await page.locator(".inspector").getByRole("button", { name: "Add an entry" }).click();
  await page.locator("dialog.entry-form").waitFor();
  await fillEntry(page, "in far: length = 30 cm");
  await page.keyboard.press("Enter");
  await studio.becomes("plan.afp", /var n: int = 0\n    in +far: length = 30 cm\n/);
  await page.locator("dialog.entry-form").waitFor({ state: "detached" });
  // The name, the type and the value are checked, and the fields keep their content.
  await page.locator(".board").focus();
  await page.keyboard.press("e");
  await fillEntry(page, "var way: angle = 3 cm +");
  await page.keyboard.press("Enter");
  await page.locator("dialog .wrong", { hasText: "'3 cm +' is not a formula" }).waitFor();
  assert.equal(await page.getByRole("dialog").getByRole("textbox", { name: "Value" }).inputValue(), "3 cm +");
  await page.keyboard.press("Escape");
  await value(page, "P.go", "distance");
  await page.locator(".inspector .entry-chip", { hasText: "gap" }).click();
  await studio.becomes("plan.afp", /distance = gap\)/);
  await value(page, "P.go", "distance");
  const form = page.locator(".inspector .value");
  await form.getByRole("button", { name: "flip the sign" }).click();
  assert.equal(await settled(() => form.getByRole("textbox").inputValue(), (now) => now === "-gap"), "-gap");
  await form.getByRole("button", { name: "+ and an entry" }).click();
  assert.doesNotMatch((await page.locator(".board-notice").allInnerTexts()).join(), /gap/);
  await form.locator(".entry-chip", { hasText: "far" }).click();
  await form.getByRole("button", { name: "Set", exact: true }).click();
  await studio.becomes("plan.afp", /distance = -gap \+ far\)/);
});

inBrowser("a declared computation is changed by a form", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await ready(page, "P.again");
  await page.mouse.click(...(await middle(page, name("P.again"))));
  await page.locator(".inspector h3", { hasText: "Exits" }).waitFor();
  assert.deepEqual(await page.locator(".inspector h3").allInnerTexts(), ["Inputs", "Results", "Exits"]);
  const form = page.getByRole("group", { name: "Computation Next" });
  const condition = form.getByRole("region", { name: "Again" }).getByLabel("when");
  assert.equal(await condition.inputValue(), "value < 3");
  await condition.fill("value < 5 and value > 0 - 1");
  await condition.press("Enter");
  await studio.becomes("plan.afp", /state Again when value < 5 and value > 0 - 1 \{/);
  const written = form.getByRole("region", { name: "Done" }).getByLabel("next =");
  await written.fill("value - 1");
  await written.press("Tab");
  await studio.becomes("plan.afp", /state Done \{ next = value - 1 \}/);
  // Drawing and form follow. Unreadable text stays in its field and is not written.
  await page.locator(".node text", { hasText: /value < 5/ }).waitFor();
  await condition.fill("value <");
  await condition.press("Enter");
  await page.locator(".board-notice").waitFor();
  assert.equal(await condition.getAttribute("aria-invalid"), "true");
  assert.match(await studio.read("plan.afp"), /when value < 5 and/);
});

inBrowser("templates are found by other words", { "plan.afp": PLAN }, async ({ page }) => {
  await ready(page, "P.go");
  const search = page.getByRole("searchbox", { name: "Search templates" });
  for (const [typed, template] of [["rotate", "Turn"], ["turn left", "Turn"], ["sleep", "Wait"], ["camera", "FindObject"]] as const) {
    await search.fill(typed);
    await page.locator(`[data-template=${template}]`).waitFor();
    await page.locator("[data-template=SearchWall]").waitFor({ state: "detached" });
  }
});

const SLOW = `use std

plan P {
    start one
    actor one: Wait(duration = 60 s) { Elapsed -> two }
    actor two: Wait(duration = 1 s) { Elapsed -> terminate }
}
`;

inBrowser("a step takes no real time; the reason of an activation follows the selection, even after the end", { "plan.afp": SLOW }, async ({ page }) => {
  await ready(page, "P.one");
  await page.locator(".board").focus();
  for (const item of ["P.one", "P.two"]) {
    const active = page.locator(`.node.active [data-item="${item}"]`).first();
    for (let steps = 0; steps < 3 && !(await active.isVisible()); steps++) {
      await page.keyboard.press("F10");
      await active.waitFor({ timeout: 3000 }).catch(() => {});
    }
    await active.waitFor();
  }
  await page.mouse.click(...(await middle(page, name("P.two"))));
  await page.locator(".board").focus();
  await page.keyboard.press("w");
  await shows(page.locator(".why-card h2"), /two/);
  await page.mouse.click(...(await middle(page, name("P.one"))));
  await shows(page.locator(".why-card h2"), /one/);
  await page.keyboard.press("F5");
  await page.locator(".end-card").waitFor();
  await page.mouse.click(...(await middle(page, name("P.two"))));
  await shows(page.locator(".why-card h2"), /two/);
});

inBrowser("the value of an entry stays in its frame", { "plan.afp": SLOW.replace("start one", 'var words: string = "a rather long text that somebody wrote"\n    start one') }, async ({ page }) => {
  await ready(page, "P.one");
  await page.keyboard.press("F5");
  const chip = page.locator(".run-value").first();
  await chip.waitFor();
  const [value, start] = [(await chip.boundingBox())!, (await page.locator('.node [data-item="P.start"] .box.start, .node [data-item="P"] .box').first().boundingBox())!];
  assert.ok(value.x + value.width <= start.x || value.x >= start.x + start.width || value.y + value.height <= start.y || value.y >= start.y + start.height, JSON.stringify({ value, start }));
});

const tablet = { hasTouch: true, viewport: { width: 800, height: 1100 } };

inBrowser("on a tablet, a tap on a template shows the new element, and the start stays visible", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await ready(page, "P.go");
  await page.locator(".narrow").getByRole("button", { name: "Palette" }).tap();
  await page.locator("[data-template=Wait]").tap();
  await studio.becomes("plan.afp", /actor wait: Wait/);
  const added = page.locator('.node [data-item="P.wait"] text.name').first();
  await added.waitFor();
  for (const spot of [added, page.locator('.node [data-item="P.start"] text.start').first()]) {
    const box = (await spot.boundingBox())!;
    assert.ok(box.x >= 0 && box.x + box.width <= 800 && box.y >= 0 && box.y < 1100, JSON.stringify(box));
  }
}, tablet);

inBrowser("an invalid selection for a plan is refused before its name is requested", { "plan.afp": PLAN.replace("terminate", "go") }, async ({ page }) => {
  await ready(page, "P.again");
  await page.mouse.click(...(await middle(page, name("P.again"))));
  await page.keyboard.press("Control+g");
  const said = page.locator(".board-notice, dialog");
  await said.first().waitFor();
  assert.equal(await page.locator("dialog").count(), 0);
});

inBrowser("without a server, a change of the drawing is shown as waiting", { "plan.afp": PLAN }, async ({ page, crash }) => {
  await ready(page, "P.go");
  await page.mouse.click(...(await middle(page, name("P.go"))));
  await crash();
  await page.locator(".banner.warning").waitFor();
  await page.locator(".board").focus();
  await page.keyboard.press("Delete");
  await shows(page.locator(".board-notice"), /made after a reconnection/);
}, { ignore: /WebSocket|ERR_/ });

for (const colorScheme of ["light", "dark"] as const) {
  inBrowser(`axe finds no problem in any state of the page, ${colorScheme}`, { "plan.afp": PLAN }, async ({ page }) => {
    await ready(page, "P.go");
    const clean = async (state: string): Promise<void> => {
      await page.evaluate(() => Promise.all(document.getAnimations().map((motion) => motion.finished.catch(() => {}))));
      const { violations } = await new AxeBuilder({ page }).options({ rules: { "label-content-name-mismatch": { enabled: true } } }).analyze();
      assert.deepEqual(violations.map(({ id, nodes }) => `${state}: ${id} ${nodes[0]?.html}`), []);
    };
    await clean("a plan");
    await page.mouse.click(...(await middle(page, name("P.again"))));
    await page.locator(".declaration").waitFor();
    await clean("a selection");
    await page.locator(".board").focus();
    await page.keyboard.press("e");
    await page.locator("dialog.entry-form").waitFor();
    await clean("a form");
    await page.keyboard.press("Escape");
    await page.locator(".rail").getByRole("button", { name: "Text" }).click();
    await page.locator(".cm-content").waitFor();
    await clean("the text");
    await page.locator(".count").click();
    for (const tab of ["Timeline", "Build and sweep"]) await page.locator(`.bottom [role=tab]:text-is("${tab}")`).click();
    await clean("a job");
    await page.keyboard.press("F5");
    await settled(() => page.locator(".clock").innerText(), (now) => Number.parseFloat(now) > 0.2);
    await clean("a run");
    await page.keyboard.press("Shift+F5");
    await page.locator(".end-card").waitFor();
    await clean("an end");
  }, { colorScheme });
}
