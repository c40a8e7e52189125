// The paper's plan from an empty file, by touch and by mouse, with names, help and formulas typed.
// The result equals the plan's text.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import type { BrowserContextOptions, Page } from "playwright-core";
import { inBrowser } from "./browser";
import { follow, Hand, PLAN, search, type Pointer } from "./paper-hand";

const fingers = (page: Page): Pointer => ({
  press: (part) => part.tap(),
  pressAt: (x, y) => page.touchscreen.tap(x, y),
  // A resting finger opens the menu.
  menuAt: async (x, y) => {
    const client = await page.context().newCDPSession(page);
    await client.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
    await page.locator(".context-menu").waitFor();
    await client.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    await client.detach();
  },
});

const mouse = (page: Page): Pointer => ({
  press: (part) => part.click(),
  pressAt: (x, y) => page.mouse.click(x, y),
  menuAt: (x, y) => page.mouse.click(x, y, { button: "right" }),
});

const HANDS: [string, (page: Page) => Pointer, BrowserContextOptions][] = [
  ["fingers", fingers, { hasTouch: true, viewport: { width: 1180, height: 820 } }],
  ["the mouse", mouse, {}],
];

/** Maximum number of gestures: presses, and typed names and numbers. */
const MOST = 90;

for (const [name, pointer, options] of HANDS) {
  inBrowser(`the paper's plan from an empty file by ${name}`, { "plan.afp": `use carbot\n\nplan ${PLAN} {\n}\n` }, async ({ page, read }) => {
    await page.locator(`.node [data-item="${PLAN}.start"]`).waitFor();
    const hand = new Hand(page, () => read("plan.afp"), pointer(page));
    await search(hand);
    await follow(hand);
    const words = (text: string): string => text.replace(/\s+/g, " ");
    const paper = await readFile(new URL("../../plans/wall_following.afp", import.meta.url), "utf8");
    assert.equal(words(await read("plan.afp")), words(paper));
    await page.locator(".count", { hasText: "ready" }).waitFor();
    assert.ok(hand.gestures <= MOST, `${hand.gestures} gestures`);
  }, options);
}
