// What people see, compared with pictures that somebody has looked at: the whole page in each look, and the picture of the
// README, which is made here. `AFP_SCREENS=1` compares; with `AFP_BLESS=1` the pictures are written anew.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { tmpdir } from "node:os";
import { fileURLToPath } from "node:url";
import type { BrowserContextOptions, Page } from "playwright-core";
import { inBrowser } from "./browser";

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "../..");
const PICTURES = "studio/tests/screens";
/** The picture of the README and of the book. */
const SHOWN = "docs/images/studio.png";
/** How far a colour may be off before its pixel counts, of 255; and how many pixels may count. */
const FAR = 40;
const MOST = 0.01;

const LOOKS: Record<string, BrowserContextOptions> = {
  light: { viewport: { width: 1400, height: 880 } },
  dark: { viewport: { width: 1400, height: 880 }, colorScheme: "dark" },
  contrast: { viewport: { width: 1400, height: 880 }, colorScheme: "dark", forcedColors: "active" },
  "800": { viewport: { width: 800, height: 700 } },
  phone: { viewport: { width: 390, height: 800 }, hasTouch: true, isMobile: true },
};

/** The looks in which an empty folder is looked at, too. */
const FIRST = ["light", "phone"];

/** The part of all pixels in which two pictures differ; 1 where their sizes do. */
const differing = (page: Page, one: Buffer, other: Buffer): Promise<number> =>
  page.evaluate(
    async ([urls, far]) => {
      const [a, b] = await Promise.all(
        urls.map(async (url) => {
          const image = new Image();
          image.src = url;
          await image.decode();
          const canvas = new OffscreenCanvas(image.width, image.height);
          const context = canvas.getContext("2d")!;
          context.drawImage(image, 0, 0);
          return context.getImageData(0, 0, image.width, image.height);
        }),
      );
      if (a!.width !== b!.width || a!.height !== b!.height) return 1;
      let count = 0;
      for (let at = 0; at < a!.data.length; at += 4) {
        const off = [0, 1, 2].some((channel) => Math.abs(a!.data[at + channel]! - b!.data[at + channel]!) > far);
        count += off ? 1 : 0;
      }
      return (4 * count) / a!.data.length;
    },
    [[one, other].map((bytes) => `data:image/png;base64,${bytes.toString("base64")}`), FAR] as const,
  );

/** Compares what is on the screen with a picture of the checkout. */
async function looksLike(page: Page, name: string): Promise<void> {
  await page.evaluate(() => Promise.all(document.getAnimations().map((motion) => motion.finished.catch(() => {}))));
  const now = await page.screenshot({ animations: "disabled", caret: "hide" });
  const file = join(ROOT, name);
  if (process.env.AFP_BLESS) {
    await mkdir(dirname(file), { recursive: true });
    return writeFile(file, now);
  }
  assert.ok(existsSync(file), `there is no ${name}: AFP_BLESS=1 makes it; look at it`);
  const part = await differing(page, now, await readFile(file));
  const found = join(tmpdir(), `afp-${name.split("/").at(-1)}`);
  if (part > MOST) await writeFile(found, now);
  assert.ok(part <= MOST, `${(100 * part).toFixed(1)} % of ${name} are other pixels: compare it with ${found}`);
}

/** The page is at rest: nothing travels, nothing is asked for. */
async function rests(page: Page): Promise<void> {
  await page.locator(".node text").first().waitFor();
  await page.locator(".floor .robot").waitFor({ state: "attached" });
  await page.locator(".count", { hasText: "ready" }).or(page.locator(".count .sign")).first().waitFor({ state: "attached" });
  await page.waitForTimeout(500);
}

/** Begins with an example. */
async function example(page: Page, name: string): Promise<void> {
  await page.locator(".card", { hasText: name }).click();
  await rests(page);
}

/** Runs until an element that is stopped at: always the same moment. */
async function held(page: Page, element: string): Promise<void> {
  const { x, y } = (await page.locator(".node text.name", { hasText: element }).first().boundingBox())!;
  await page.mouse.click(x + 6, y + 6);
  await page.keyboard.press("F9");
  await page.getByLabel("Speed").selectOption({ label: "5x" });
  await page.keyboard.press("F5");
  await page.locator(".clock.held").waitFor({ timeout: 90_000 });
}

const wanted = Boolean(process.env.AFP_SCREENS || process.env.AFP_BLESS);
for (const [look, options] of wanted ? Object.entries(LOOKS) : []) {
  inBrowser(`a plan looks as it should, ${look}`, {}, async ({ page, folder }) => {
    const heading = page.locator("h1");
    await heading.waitFor();
    await page.waitForTimeout(1000);
    // The folder of a test is called otherwise each time.
    await heading.evaluate((node, name) => (node.textContent = node.textContent!.replace(name, "my-robot")), folder.split("/").at(-1)!);
    if (FIRST.includes(look)) await looksLike(page, `${PICTURES}/welcome-${look}.png`);
    await example(page, "Wall following");
    await looksLike(page, `${PICTURES}/plan-${look}.png`);
  }, options);
}

if (wanted) {
  inBrowser("the picture of the README is what one sees", {}, async ({ page }) => {
    await example(page, "Avoid obstacle");
    await held(page, "arrive");
    // To what was active before: the sub-plan that leads round the obstacle.
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
