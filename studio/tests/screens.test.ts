// Screenshots of the whole page in each look, compared with reviewed ones; also makes the README's
// picture.
import type { BrowserContextOptions, Page } from "playwright-core";
import { inBrowser } from "./browser";
import { compared, looksLike } from "./pictures";

const PICTURES = "studio/tests/screens";
/** The picture of the README and of the book. */
const SHOWN = "docs/images/studio.png";

const LOOKS: Record<string, BrowserContextOptions> = {
  light: { viewport: { width: 1400, height: 880 } },
  dark: { viewport: { width: 1400, height: 880 }, colorScheme: "dark" },
  contrast: { viewport: { width: 1400, height: 880 }, colorScheme: "dark", forcedColors: "active" },
  "800": { viewport: { width: 800, height: 700 } },
  phone: { viewport: { width: 390, height: 800 }, hasTouch: true, isMobile: true },
};

/** The looks in which the empty folder is also tested. */
const FIRST = ["light", "phone"];

/** Waits until the page is idle: no animation and no request. */
async function rests(page: Page): Promise<void> {
  await page.locator(".node text").first().waitFor();
  await page.locator(".floor .robot").waitFor({ state: "attached" });
  await page.locator(".count", { hasText: "ready" }).or(page.locator(".count .sign")).first().waitFor({ state: "attached" });
  await page.waitForTimeout(500);
}

async function example(page: Page, name: string): Promise<void> {
  await page.locator(".card", { hasText: name }).click();
  await rests(page);
}

/** Runs to a breakpoint at an element: always the same moment. */
async function held(page: Page, element: string): Promise<void> {
  const { x, y } = (await page.locator(".node text.name", { hasText: element }).first().boundingBox())!;
  await page.mouse.click(x + 6, y + 6);
  await page.keyboard.press("F9");
  await page.getByLabel("Speed").selectOption({ label: "5x" });
  await page.keyboard.press("F5");
  await page.locator(".clock.held").waitFor({ timeout: 90_000 });
}

for (const [look, options] of compared ? Object.entries(LOOKS) : []) {
  inBrowser(`a plan has its recorded look, ${look}`, {}, async ({ page, folder }) => {
    const heading = page.locator("h1");
    await heading.waitFor();
    await page.waitForTimeout(1000);
    // The name of the test folder varies.
    await heading.evaluate((node, name) => (node.textContent = node.textContent!.replace(name, "my-robot")), folder.split("/").at(-1)!);
    if (FIRST.includes(look)) await looksLike(page, `${PICTURES}/welcome-${look}.png`);
    await example(page, "Wall following");
    await looksLike(page, `${PICTURES}/plan-${look}.png`);
  }, options);
}

if (compared) {
  inBrowser("the picture of the README shows the current page", {}, async ({ page }) => {
    await example(page, "Avoid obstacle");
    await held(page, "arrive");
    // Goes back to the previously active sub-plan, which avoids the obstacle.
    await page.keyboard.press("Shift+F10");
    await page.locator(".run-active").first().waitFor({ state: "attached" });
    await page.keyboard.press("Control+k");
    await page.keyboard.type("timeline");
    await page.keyboard.press("Enter");
    await page.locator(".rail button", { hasText: "Text" }).click();
    await page.locator(".cm-line").first().waitFor();
    await page.locator(".tool[aria-label='The whole run']").click();
    await page.locator(".board").focus();
    await page.keyboard.press("0");
    const ground = (await page.locator(".board").boundingBox())!;
    await page.mouse.click(ground.x + 40, ground.y + 40);
    await page.mouse.move(2, 2);
    await page.waitForTimeout(800);
    await looksLike(page, SHOWN);
  }, { viewport: { width: 1600, height: 1000 }, timeout: 200_000 });
}
