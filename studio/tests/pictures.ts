// Compares screenshots with those of the checkout. `AFP_SCREENS=1` compares; with `AFP_BLESS=1`
// they are rewritten.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { tmpdir } from "node:os";
import { fileURLToPath } from "node:url";
import type { Page } from "playwright-core";

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "../..");
/** Permitted difference of a colour, of 255, and permitted number of differing pixels. */
const FAR = 40;
const MOST = 0.01;

/** Whether screenshots are compared or rewritten. */
export const compared = Boolean(process.env.AFP_SCREENS || process.env.AFP_BLESS);

/** The share of differing pixels; 1 for different sizes. */
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

/** Compares the screen with a screenshot of the checkout. */
export async function looksLike(page: Page, name: string): Promise<void> {
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
