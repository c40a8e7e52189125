// Leaving a field in any way writes the value; invalid values stay, marked; only Escape discards.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser, settled } from "./browser";
import { middle, name } from "./spots";

const PLAN = `use carbot

plan P {
    var gap: length = 20 cm

    start go

    actor go: Forward(distance = 2 cm) {
        ForwardSuccessful -> turn
    }

    actor turn: Turn(angle = 90 deg) {
        TurnSuccessful -> terminate
    }
}
`;

/** Opens the value of a port by a click; the field has the focus. */
async function open(page: Page, item: string): Promise<void> {
  await page.locator(`.node [data-item="${item}"]`).first().waitFor();
  await page.mouse.click(...(await middle(page, `.node [data-item="${item}"] text.formula`)));
  await page.locator(".value-popup input[type=text]:focus").waitFor();
}

/** An empty place of the drawing. */
const ground = [900, 690] as const;

inBrowser("a typed or stepped value is written when its field loses the focus", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await open(page, "P.turn");
  await page.keyboard.type("-75 deg");
  await page.mouse.click(...ground);
  await studio.becomes("plan.afp", /angle = -75 deg/);
  await page.locator(".value-popup").waitFor({ state: "detached" });
  await open(page, "P.turn");
  await page.locator(".value-popup").getByRole("button", { name: "more" }).click();
  await page.mouse.click(...ground);
  await studio.becomes("plan.afp", /angle = -(?!75)\d+ deg/);
  // By a click on another element, and by Tab.
  await open(page, "P.turn");
  await page.keyboard.type("10 deg");
  await page.mouse.click(...(await middle(page, name("P.go"))));
  await studio.becomes("plan.afp", /angle = 10 deg/);
  await page.keyboard.press("Control+z");
  await studio.becomes("plan.afp", /angle = -\d+ deg/);
});

inBrowser("an invalid value stays marked in its field and is not written; Escape discards it", { "plan.afp": PLAN }, async (studio) => {
  const { page, read } = studio;
  const field = page.locator(".value-popup input[type=text]");
  await open(page, "P.turn");
  await page.keyboard.type("90 +");
  await page.mouse.click(...ground);
  await page.locator('.value-popup input[aria-invalid="true"]').waitFor();
  assert.equal(await field.inputValue(), "90 +");
  assert.equal(await read("plan.afp"), PLAN);
  // It is kept while another value is open.
  await open(page, "P.go");
  await page.keyboard.press("Escape");
  await open(page, "P.turn");
  assert.equal(await field.inputValue(), "90 +");
  await page.keyboard.press("Escape");
  await page.locator(".value-popup").waitFor({ state: "detached" });
  await open(page, "P.turn");
  assert.equal(await field.inputValue(), "90 deg");
  await page.keyboard.type("45 deg");
  await page.keyboard.press("Escape");
  await page.locator(".value-popup").waitFor({ state: "detached" });
  await page.waitForTimeout(400);
  assert.equal(await read("plan.afp"), PLAN);
});

inBrowser("a refused line of the inspector stays marked", { "plan.afp": PLAN }, async (studio) => {
  const { page, read } = studio;
  await page.locator('.node [data-item="P.go"]').first().waitFor();
  await page.mouse.click(...(await middle(page, '.node [data-item="P.start"] text.entry')));
  const line = page.locator(".inspector label.line", { hasText: "value" }).locator("input");
  await line.fill("20 +");
  await page.mouse.click(...ground);
  await page.locator(".board-notice").waitFor();
  assert.equal(await read("plan.afp"), PLAN);
  await page.mouse.click(...(await middle(page, '.node [data-item="P.start"] text.entry')));
  assert.equal(await settled(() => line.inputValue(), (now) => now === "20 +"), "20 +");
  assert.equal(await line.getAttribute("aria-invalid"), "true");
  await line.press("Escape");
  assert.equal(await line.inputValue(), "20 cm");
});

inBrowser("a step selects the next number of the grid, and a new unit keeps the value", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await open(page, "P.go");
  const popup = page.locator(".value-popup");
  const field = popup.locator("input[type=text]");
  await popup.getByRole("button", { name: "less" }).click();
  const reads = async (wanted: string): Promise<void> => assert.equal(await settled(() => field.inputValue(), (now) => now === wanted), wanted);
  await reads("0 cm");
  await field.fill("2 m");
  await popup.getByRole("combobox").selectOption("cm");
  await reads("200 cm");
});
