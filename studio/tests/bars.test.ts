// What the drawing takes at 60 and at 1,000 elements, in milliseconds: measured with `AFP_BARS=1`, where the program is an
// optimised one and nothing else runs.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser } from "./browser";
import { large } from "./large";

/** Rounds of which the median counts. */
const ROUNDS = 5;
const BARS = { 60: { ready: 400, drop: 50, frames: 55 }, 1000: { ready: 1200, drop: 100, frames: 45 } } as const;

const median = (all: number[]): number => [...all].sort((one, two) => one - two)[all.length >> 1]!;

/** Milliseconds from the beginning of the page to the first frame with a drawing. */
async function ready(page: Page): Promise<number> {
  await page.reload();
  return page.waitForFunction(() => document.querySelector(".node text") && performance.now(), undefined, { timeout: 60_000 }).then((handle) => handle.jsonValue() as Promise<number>);
}

/** Milliseconds from the release of an element to the frame with its edges routed anew. */
async function drop(page: Page, nth: number): Promise<number> {
  const box = await page.locator('.node [data-item="Large.element1"] text.name').boundingBox();
  assert.ok(box);
  const [x, y] = [box.x + 10, box.y + 6];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y + 40, { steps: 8 });
  await page.mouse.move(x + (nth % 2 ? -36 : 36), y + (nth % 2 ? -24 : 24), { steps: 8 });
  await page.evaluate(() => {
    const board = document.querySelector<HTMLElement>(".board")!;
    const way = document.querySelector('.way [data-item="Large.element0"]')!.parentElement!;
    const global = window as any;
    board.addEventListener("pointerup", () => (global.released = performance.now()), { once: true, capture: true });
    global.routed = new Promise<number>((done) => {
      new MutationObserver((_, own) => {
        own.disconnect();
        requestAnimationFrame(() => setTimeout(() => done(performance.now() - global.released)));
      }).observe(way, { childList: true });
    });
  });
  await page.mouse.up();
  const took = await page.evaluate(() => (window as any).routed as Promise<number>);
  await page.waitForTimeout(700);
  return took;
}

/** Frames a second while the ground is dragged. */
async function frames(page: Page): Promise<number> {
  await page.evaluate(() => {
    const global = window as any;
    global.times = [];
    const each = (at: number): void => void (global.times?.push(at), global.times && requestAnimationFrame(each));
    requestAnimationFrame(each);
  });
  await page.mouse.move(600, 400);
  await page.mouse.down({ button: "middle" });
  for (let step = 0; step < 60; step++) {
    await page.mouse.move(600 + 2 * step, 400 - step);
    await page.waitForTimeout(8);
  }
  await page.mouse.up({ button: "middle" });
  return page.evaluate(() => {
    const times: number[] = (window as any).times;
    (window as any).times = null;
    return (1000 * (times.length - 1)) / (times.at(-1)! - times[0]!);
  });
}

for (const count of process.env.AFP_BARS ? ([60, 1000] as const) : []) {
  inBrowser(`bars at ${count} elements`, { "plan.afp": large(count) }, async ({ page }) => {
    await page.locator(".node text").first().waitFor({ timeout: 40_000 });
    const times: number[] = [];
    for (let round = 0; round < ROUNDS; round++) times.push(await ready(page));
    const drops: number[] = [];
    for (let round = 0; round < ROUNDS; round++) drops.push(await drop(page, round));
    const figures = { ready: median(times), drop: median(drops), frames: await frames(page) };
    await page.keyboard.press("0");
    const far = await frames(page);
    console.log(count, figures, { far }, { times, drops });
    const bar = BARS[count];
    if (process.env.AFP_BARS !== "check") return;
    assert.ok(figures.ready <= bar.ready && figures.drop <= bar.drop && Math.min(figures.frames, far) >= bar.frames, JSON.stringify(figures));
  }, { viewport: { width: 1366, height: 768 } });
}
