// The real page in a real browser: `afpc studio` on a test folder, in Debian's Chromium.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { PATIENCE, settled } from "./settled";
import { chromium, type Browser, type BrowserContextOptions, type Locator, type Page } from "playwright-core";

export const AFPC = process.env.AFPC ?? "";
const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
/** The reason why the browser tests are skipped; false if they run. */
export const SKIP = !AFPC ? "AFPC does not say where afpc is" : !existsSync(CHROMIUM) ? `there is no ${CHROMIUM}` : false;

export { settled };

export interface Studio {
  page: Page;
  folder: string;
  /** The bytes of a file, as text; empty if it is missing. */
  read(name: string): Promise<string>;
  write(name: string, text: string): Promise<void>;
  holds(name: string, text: string): Promise<void>;
  /** Waits until a file matches a pattern. */
  becomes(name: string, wanted: RegExp): Promise<void>;
  /** Kills the server, as in a crash. */
  crash(): Promise<void>;
  /**
   * Starts another server on the same port and returns its printed address; the browser opens it
   * unless `enter` is false.
   */
  restart(enter?: boolean): Promise<string>;
  /** Waits until the page shows "saved". */
  isSaved(): Promise<void>;
}

/** Waits until a part of the page matches a pattern. */
export async function shows(part: Locator, wanted: RegExp): Promise<void> {
  assert.match(await settled(() => part.innerText(), (now) => wanted.test(now)), wanted);
}

/** The position of a word of the text, once it is visible. */
const middle = (page: Page, word: string): Promise<[number, number]> =>
  page.evaluate((word) => {
    const texts = document.createTreeWalker(document.querySelector(".cm-content")!, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
      const at = new RegExp(`\\b${word}\\b`).exec(texts.currentNode.nodeValue ?? "")?.index;
      if (at === undefined) continue;
      texts.currentNode.parentElement!.scrollIntoView({ block: "center" });
      const range = document.createRange();
      range.setStart(texts.currentNode, at);
      range.setEnd(texts.currentNode, at + word.length);
      const { x, y, width, height } = range.getBoundingClientRect();
      return [x + width / 2, y + height / 2];
    }
    throw new Error(`no '${word}' in ${document.querySelector(".cm-content")!.textContent}`);
  }, word);

/** Hovers over a word of the text until its tooltip matches; a new pane may still scroll. */
export async function explained(page: Page, word: string, wanted: RegExp): Promise<void> {
  const tooltip = page.locator(".cm-tooltip-hover");
  for (let tries = 0; tries < 5; tries++) {
    await page.mouse.move(2, 2);
    await page.mouse.move(...(await middle(page, word)));
    if (await tooltip.waitFor({ timeout: 2000 }).then(() => true, () => false)) break;
  }
  await shows(tooltip, wanted);
}

let browser: Browser | null = null;
after(() => browser?.close());

/** Starts the server of a folder; returns its address and a function that ends it. */
async function serve(folder: string, port = "0", file = ""): Promise<{ address: string; end: () => Promise<void>; kill: () => Promise<void> }> {
  const child = spawn(AFPC, ["studio", join(folder, file), "--port", port, "--no-open"], { stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, XDG_CONFIG_HOME: join(folder, ".config") } });
  const gone = new Promise<void>((done) => child.once("close", () => done()));
  const kill = async (): Promise<void> => {
    child.kill("SIGKILL");
    await gone;
  };
  const end = async (): Promise<void> => {
    child.kill("SIGTERM");
    const timer = setTimeout(() => child.kill("SIGKILL"), 3000);
    await gone;
    clearTimeout(timer);
  };
  let said = "";
  const address = await new Promise<string>((done, fail) => {
    const timer = setTimeout(() => fail(new Error(`no address within ${PATIENCE} ms; it said: ${said}`)), PATIENCE);
    const take = (text: Buffer): void => {
      said += text.toString();
      const found = /http:\/\/\S+\?code=\S+/.exec(said);
      if (found) clearTimeout(timer);
      if (found) done(found[0]);
    };
    child.stdout.on("data", take);
    child.stderr.on("data", take);
    child.once("close", () => fail(new Error(`it ended: ${said}`)));
  }).catch(async (why) => {
    await end();
    throw why;
  });
  return { address, end, kill };
}

/** A test in the browser, on a folder with some files. An error in the page's console fails it. */
export function inBrowser(name: string, files: Record<string, string>, run: (studio: Studio) => Promise<void>, options: BrowserContextOptions & { ignore?: RegExp; timeout?: number; open?: string } = {}): void {
  test(name, { timeout: options.timeout ?? 120_000, skip: SKIP }, async () => {
    browser ??= await chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox"] });
    const folder = await mkdtemp(join(tmpdir(), "afp-studio-"));
    for (const [file, text] of Object.entries(files)) {
      await mkdir(dirname(join(folder, file)), { recursive: true });
      await writeFile(join(folder, file), text);
    }
    const { ignore, timeout: _, open, ...others } = options;
    let server = await serve(folder, "0", open);
    const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, ...others });
    try {
      context.setDefaultTimeout(PATIENCE);
      const page = await context.newPage();
      const wrong: string[] = [];
      page.on("pageerror", (why) => wrong.push(String(why)));
      page.on("console", (message) => message.type() === "error" && !ignore?.test(message.text()) && wrong.push(message.text()));
      await page.goto(server.address);
      const read = (file: string) => readFile(join(folder, file), "utf8").catch(() => "");
      const write = (file: string, text: string) => writeFile(join(folder, file), text);
      const holds = async (file: string, text: string): Promise<void> => assert.equal(await settled(() => read(file), (now) => now === text), text);
      const becomes = async (file: string, wanted: RegExp): Promise<void> => assert.match(await settled(() => read(file), (now) => wanted.test(now)), wanted);
      const crash = () => server.kill();
      const restart = async (enter = true): Promise<string> => {
        server = await serve(folder, new URL(server.address).port);
        if (enter) await context.request.get(server.address);
        return server.address;
      };
      const isSaved = () => page.locator(".saved.saved:not(.saving, .failed)").waitFor();
      const failed = await run({ page, folder, read, write, holds, becomes, crash, restart, isSaved }).then(() => null, (why: Error) => why);
      if (wrong.length) throw new Error(`the page says: ${wrong.join("\n")}`, { cause: failed });
      if (failed) throw failed;
    } finally {
      await context.close();
      await server.end();
      await rm(folder, { recursive: true, force: true });
    }
  });
}
