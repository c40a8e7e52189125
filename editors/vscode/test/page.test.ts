// Tests the page in a real browser with the real server: display, clicks, and that no foreign
// script runs in it.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { after, test } from "node:test";
import { chromium, type Browser, type Page } from "playwright-core";
import type { Range } from "../../../studio/page/documents/positions";
import { Drawing, type FromPage } from "../src/drawing";
import { page as written } from "../src/page";
import { PLAN, serving, there, type Talk } from "./server";

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const skip = existsSync(CHROMIUM) ? false : `there is no ${CHROMIUM}`;
const HERE = "https://webview.test";

let browser: Browser | null = null;
after(() => browser?.close());

interface Shown {
  page: Page;
  drawing: Drawing;
  revealed: Range[];
  /** Errors that the page has written to its console. */
  wrong: string[];
}

/** Opens the page as the editor would. */
async function shown(talk: Talk, run: (shown: Shown) => Promise<void>, theme = "vscode-light"): Promise<void> {
  browser ??= await chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox"] });
  const page = await browser.newPage({ viewport: { width: 900, height: 700 } });
  page.setDefaultTimeout(10_000);
  const [revealed, wrong]: [Range[], string[]] = [[], []];
  const uri = talk.uri;
  const drawing: Drawing = new Drawing(uri, null, {
    server: talk,
    post: (message) => void page.evaluate((data) => window.postMessage(data, "*"), message as object).catch(() => {}),
    reveal: (range) => revealed.push(range),
  });
  talk.onChange((change) => drawing.changed(change));
  page.on("pageerror", (why) => wrong.push(String(why)));
  page.on("console", (message) => message.type() === "error" && wrong.push(message.text()));
  await page.exposeFunction("afpReceive", (message: FromPage) => drawing.receive(message));
  await page.addInitScript((theme) => {
    Object.assign(window, { acquireVsCodeApi: () => ({ postMessage: (message: unknown) => (window as unknown as { afpReceive(message: unknown): void }).afpReceive(message) }) });
    document.addEventListener("DOMContentLoaded", () => document.body.classList.add(theme));
  }, theme);
  const sheet = async (theme: string): Promise<string> => (await talk.request<{ text: string }>("afp/export", { textDocument: { uri }, format: "css", theme })).text;
  const html = written({ script: `${HERE}/drawing.js`, origin: HERE, colours: { light: await sheet("light"), dark: await sheet("dark") }, nonce: "0123456789abcdef" });
  await page.route("**/*", async (route) => {
    const path = new URL(route.request().url()).pathname;
    if (path === "/drawing.js") return route.fulfill({ contentType: "text/javascript", body: await readFile("dist/drawing.js", "utf8") });
    if (path === "/") return route.fulfill({ contentType: "text/html", body: html });
    return route.abort();
  });
  try {
    await page.goto(`${HERE}/`);
    await page.locator('[data-id="Patrol.go"]').waitFor();
    await run({ page, drawing, revealed, wrong });
  } finally {
    await page.close();
  }
}

/** Clicks the name of an element. */
async function press(page: Page, item: string, twice = false): Promise<void> {
  const box = await page.locator(`[data-id="${item}"] text.name`).first().boundingBox();
  const at = [box!.x + box!.width / 2, box!.y + box!.height / 2] as const;
  await (twice ? page.mouse.dblclick(...at) : page.mouse.click(...at));
}

test("a click in the drawing selects the text, and the cursor selects in the drawing", { skip }, () =>
  serving((talk) =>
    shown(talk, async ({ page, drawing, revealed, wrong }) => {
      await press(page, "Patrol.back");
      assert.equal((await there(() => revealed[0], "place in the text")).start.line, 8);
      await page.locator(".ring").waitFor();
      const ring = await page.locator(".ring").boundingBox();
      await drawing.cursor({ line: 4, character: 11 });
      await page.waitForFunction((before) => document.querySelector(".ring")!.getBoundingClientRect().y !== before, ring!.y);
      await talk.type(PLAN.replace("-> terminate", "-> turn").replace(/}\n$/, "    actor turn: Turn { TurnSuccessful -> go }\n}\n"));
      await page.locator('[data-id="Patrol.turn"]').waitFor();
      await page.locator("#board").focus();
      await page.keyboard.press("n");
      await there(() => revealed[1], "place of the first element");
      await page.keyboard.press("0");
      drawing.run({ plan: "Patrol", stack: ["go"], held: true, older: true });
      await page.locator(".runs.held").waitFor();
      await page.getByText("This run is of an older text.").waitFor();
      drawing.run({ plan: "Other", stack: ["go"], held: true, older: false });
      await page.getByText("This run is of an older text.").waitFor({ state: "hidden" });
      await page.locator(".runs").waitFor({ state: "detached" });
      if (process.env.AFP_PICTURES) await page.screenshot({ path: `${process.env.AFP_PICTURES}/webview.png` });
      assert.deepEqual(wrong, []);
    }),
  ),
);

test("a drag moves the drawing and selects nothing", { skip }, () =>
  serving((talk) =>
    shown(talk, async ({ page, revealed }) => {
      const before = await page.locator('[data-id="Patrol.go"]').boundingBox();
      await page.mouse.move(before!.x + 20, before!.y + 12);
      await page.mouse.down();
      await page.mouse.move(before!.x + 90, before!.y + 52, { steps: 4 });
      await page.mouse.up();
      const now = await page.locator('[data-id="Patrol.go"]').boundingBox();
      assert.ok(Math.abs(now!.x - before!.x - 70) < 2 && Math.abs(now!.y - before!.y - 40) < 2, JSON.stringify([before, now]));
      assert.deepEqual(revealed, []);
    }),
  ),
);

test("a sub-plan is opened, and the colours follow the editor's theme", { skip }, () =>
  serving(
    (talk) =>
      shown(
        talk,
        async ({ page, wrong }) => {
          const fill = await page.locator('[data-id="Patrol.go"] .box.subplan').first().evaluate((box) => getComputedStyle(box).fill);
          assert.equal(fill, "rgb(35, 31, 53)");
          await press(page, "Patrol.go", true);
          await page.locator('[data-id="Inner.left"]').waitFor();
          await page.locator("#plans").selectOption("Patrol");
          await page.locator('[data-id="Patrol.go"]').waitFor();
          if (process.env.AFP_PICTURES) await page.screenshot({ path: `${process.env.AFP_PICTURES}/webview-dark.png` });
          assert.deepEqual(wrong, []);
        },
        "vscode-dark",
      ),
    "use carbot\nplan Patrol { start go subplan go: Inner { OK -> go } }\nplan Inner { start left actor left: Turn { TurnSuccessful -> terminate } }\n",
  ),
);

test("the page runs no other scripts and loads nothing from elsewhere", { skip }, () =>
  serving((talk) =>
    shown(talk, async ({ page, drawing }) => {
      const ran = await page.evaluate(async () => {
        const violations: string[] = [];
        document.addEventListener("securitypolicyviolation", (event) => violations.push(event.effectiveDirective));
        const script = document.createElement("script");
        script.textContent = "window.ran = true";
        document.body.append(script);
        const image = document.createElement("img");
        image.src = "https://elsewhere.test/a.png";
        document.body.append(image);
        await fetch("https://elsewhere.test/").catch(() => {});
        await new Promise((done) => setTimeout(done, 100));
        return { ran: "ran" in window, violations: violations.sort() };
      });
      assert.deepEqual(ran, { ran: false, violations: ["connect-src", "img-src", "script-src-elem"] });
      // A fragment with content outside of the lists is omitted completely.
      const answer = await talk.request<{ elements: { item: string; svg: string }[] }>("afp/drawing", { textDocument: { uri: talk.uri } });
      answer.elements[0]!.svg = '<g onload="window.ran = true"><image href="https://elsewhere.test/b.png"/></g>';
      await page.evaluate((data) => window.postMessage(data, "*"), { kind: "drawing", uri: drawing.uri, answer } as object);
      await page.waitForFunction((item) => document.querySelector(`[data-id="${item}"]`)?.childElementCount === 0, answer.elements[0]!.item);
      assert.equal(await page.evaluate(() => "ran" in window), false);
    }),
  ),
);
