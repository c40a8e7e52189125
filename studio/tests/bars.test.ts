// Times of the page with 60 and 1,000 elements, in milliseconds, and its memory in a long run.
// `AFP_BARS=1` and `AFP_HOUR=3600` measure, with an optimised program and no other load;
// `AFP_BARS=check` enforces the limits.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";
import type { Page } from "playwright-core";
import { inBrowser } from "./browser";
import { large } from "./large";

/** Rounds; the median counts. */
const ROUNDS = 5;
const BARS = { 60: { ready: 400, drop: 50, frames: 55 }, 1000: { ready: 1200, drop: 100, frames: 45 } } as const;

/** Limits: milliseconds from a key to the mark of an error; kilobytes of the compressed page. */
const SQUIGGLE = 200;
const LOADED = 320;

const median = (all: number[]): number => [...all].sort((one, two) => one - two)[all.length >> 1]!;

/** Milliseconds from the start of the page to the first frame with a drawing. */
async function ready(page: Page): Promise<number> {
  await page.reload();
  return page.waitForFunction(() => document.querySelector(".node text") && performance.now(), undefined, { timeout: 60_000 }).then((handle) => handle.jsonValue() as Promise<number>);
}

/** The element whose name is nearest to the middle of the drawing, and its position. */
const inSight = (page: Page): Promise<{ item: string; x: number; y: number }> =>
  page.evaluate(() => {
    const board = document.querySelector(".board")!.getBoundingClientRect();
    const off = ({ left, top }: DOMRect): number => Math.hypot(left - board.left - board.width / 2, top - board.top - board.height / 2);
    const groups = [...document.querySelectorAll('.node [data-item^="Large.element"]')].filter((group) => /^Large\.element\d+$/.test(group.getAttribute("data-item")!));
    // Supervisors' names come after the element's name.
    const named = groups.filter((group) => group.querySelector("text.name"));
    const names = named.map((group) => ({ item: group.getAttribute("data-item")!, rect: group.querySelector("text.name")!.getBoundingClientRect() }));
    const { item, rect } = names.sort((one, other) => off(one.rect) - off(other.rect))[0]!;
    return { item, x: rect.left + 10, y: rect.top + 6 };
  });

/** Milliseconds from dropping an element to the frame with its rerouted edges. */
async function drop(page: Page, nth: number): Promise<number> {
  const { item, x, y } = await inSight(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y + 40, { steps: 8 });
  await page.mouse.move(x + (nth % 2 ? -36 : 36), y + (nth % 2 ? -24 : 24), { steps: 8 });
  await page.evaluate((item) => {
    const board = document.querySelector<HTMLElement>(".board")!;
    const way = document.querySelector(`.way [data-item="${item}"]`)!.parentElement!;
    const global = window as any;
    board.addEventListener("pointerup", () => (global.released = performance.now()), { once: true, capture: true });
    global.routed = new Promise<number>((done) => {
      new MutationObserver((_, own) => {
        own.disconnect();
        requestAnimationFrame(() => setTimeout(() => done(performance.now() - global.released)));
      }).observe(way, { childList: true });
    });
  }, item);
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

/** Milliseconds from a key in the text to the frame with the error's mark. */
async function squiggle(page: Page): Promise<number> {
  await page.locator(".cm-line", { hasText: "start element0" }).click();
  await page.keyboard.press("End");
  await page.evaluate(() => {
    const global = window as any;
    const text = document.querySelector(".cm-content")!;
    text.addEventListener("keydown", () => (global.pressed = performance.now()), { once: true, capture: true });
    global.marked = new Promise<number>((done) => {
      new MutationObserver((_, own) => {
        if (!text.querySelector(".cm-lintRange-error")) return;
        own.disconnect();
        requestAnimationFrame(() => setTimeout(() => done(performance.now() - global.pressed)));
      }).observe(text, { childList: true, subtree: true, attributes: true });
    });
  });
  await page.keyboard.press("x");
  const took = await page.evaluate(() => (window as any).marked as Promise<number>);
  await page.keyboard.press("Control+z");
  await page.locator(".cm-lintRange-error").waitFor({ state: "detached" });
  return took;
}

/** Compressed size of everything that the page loads, kilobytes. */
async function loaded(): Promise<number> {
  const files = ["index.html", "main.js", "app.css", "icon.svg"].map((name) => readFile(new URL(`../dist/${name}`, import.meta.url)));
  return (await Promise.all(files)).reduce((sum, bytes) => sum + gzipSync(bytes).length, 0) / 1000;
}

/** Frames a second of an empty page during a drag: the machine's limit. */
async function emptyFrames(page: Page): Promise<number> {
  const other = await page.context().newPage();
  const most = await frames(other);
  await other.close();
  return most;
}

for (const count of process.env.AFP_BARS ? ([60, 1000] as const) : []) {
  inBrowser(`bars at ${count} elements`, { "plan.afp": large(count) }, async ({ page }) => {
    await page.locator(".node text").first().waitFor({ timeout: 60_000 });
    const times: number[] = [];
    for (let round = 0; round < ROUNDS; round++) times.push(await ready(page));
    const drops: number[] = [];
    for (let round = 0; round < ROUNDS; round++) drops.push(await drop(page, round));
    const empty = await emptyFrames(page);
    const near = await frames(page);
    await page.keyboard.press("0");
    const far = await frames(page);
    await page.keyboard.press("Control+k");
    await page.keyboard.type("text");
    await page.keyboard.press("Enter");
    const keys: number[] = [];
    for (let round = 0; round < ROUNDS; round++) keys.push(await squiggle(page));
    const figures = { ready: median(times), drop: median(drops), near, far, empty, squiggle: median(keys), loaded: await loaded() };
    console.log(count, figures, { times, drops, keys });
    if (process.env.AFP_BARS !== "check") return;
    const bar = BARS[count];
    // A slower machine has a proportionally lower limit.
    const enough = (bar.frames * Math.min(empty, 60)) / 60;
    assert.ok(figures.ready <= bar.ready && figures.drop <= bar.drop && figures.squiggle <= SQUIGGLE && figures.loaded <= LOADED, JSON.stringify(figures));
    assert.ok(Math.min(near, far) >= enough, JSON.stringify(figures));
  }, { viewport: { width: 1366, height: 768 }, timeout: 400_000 });
}

/** Duration of a plan's run, seconds. */
const LASTS = Number(process.env.AFP_HOUR ?? 0);
/** Permitted growth of the page's memory, megabytes. */
const GROWS = 5;

if (LASTS > 0) {
  inBrowser("a long run does not fill the page", { "plan.afp": await readFile(new URL("../../plans/wall_following.afp", import.meta.url), "utf8") }, async ({ page }) => {
    const session = await page.context().newCDPSession(page);
    const heap = async (): Promise<number> => {
      await session.send("HeapProfiler.collectGarbage");
      return (await session.send("Runtime.getHeapUsage")).usedSize / 1e6;
    };
    await page.locator(".node text").first().waitFor();
    const empty = await emptyFrames(page);
    await page.keyboard.press("F5");
    const seconds = async (): Promise<number> => Number.parseFloat(await page.locator(".clock").innerText());
    const until = async (at: number): Promise<void> => {
      while ((await seconds()) < at) await page.waitForTimeout(1000);
    };
    await until(Math.min(60, LASTS / 4));
    const before = await heap();
    const frames = [];
    for (let part = 1; part <= 10; part++) {
      await until((LASTS * part) / 10);
      frames.push(await resting(page));
    }
    const grown = (await heap()) - before;
    console.log({ seconds: await seconds(), before, grown, frames, empty });
    assert.ok(grown < GROWS && median(frames) >= (55 * Math.min(empty, 60)) / 60, JSON.stringify({ grown, frames, empty }));
  }, { timeout: (LASTS + 300) * 2000 });
}

/** Frames a second of an idle page, over two seconds. */
const resting = (page: Page): Promise<number> =>
  page.evaluate(
    () =>
      new Promise<number>((done) => {
        const begin = performance.now();
        let count = 0;
        const each = (at: number): void => {
          count++;
          if (at - begin < 2000) requestAnimationFrame(each);
          else done((1000 * count) / (at - begin));
        };
        requestAnimationFrame(each);
      }),
  );
