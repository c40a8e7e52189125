// Fragments: the page accepts the engine's, and nothing that runs, loads or links.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { after, test } from "node:test";
import { build } from "esbuild";
import { chromium, type Browser } from "playwright-core";

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const skip = existsSync(CHROMIUM) ? false : `there is no ${CHROMIUM}`;

let browser: Browser | null = null;
after(() => browser?.close());

const FINE = [
  '<g class="element" data-item="P.go" transform="translate(1 2)"><rect class="box" x="0" y="0" width="4" height="4" rx="9"><title>go: a &lt;b&gt;</title></rect><text font-size="11">go</text><use class="icon" href="#afp-start-1" x="1" y="1" width="2" height="2"/></g>',
  '<symbol id="afp-x" viewBox="0 0 24 24"><g fill="none" stroke="currentColor"><path d="M1 1l2 2"/></g></symbol>',
];

const FOUL = [
  "<script>window.ran = 1</script>",
  '<g onclick="window.ran = 1"/>',
  '<g><animate attributeName="x" onbegin="window.ran = 1"/></g>',
  '<g><foreignObject><img xmlns="http://www.w3.org/1999/xhtml" src="x" onerror="window.ran = 1"/></foreignObject></g>',
  '<image href="http://example.invalid/x.png"/>',
  '<use href="http://example.invalid/x.svg#a"/>',
  '<use href="data:image/svg+xml,x#a"/>',
  '<a href="javascript:window.ran = 1"><text>x</text></a>',
  '<g style="background: url(http://example.invalid/x)"/>',
  '<rect fill="url(http://example.invalid/x)"/>',
  '<g><b xmlns="http://www.w3.org/1999/xhtml">x</b></g>',
  '<use xmlns:x="http://www.w3.org/1999/xlink" x:href="#afp-start-1"/>',
  "<g><rect></g>",
  '</g><script>window.ran = 1</script><g>',
];

test("only fragments of the engine are accepted", { skip, timeout: 60_000 }, async () => {
  const made = await build({ entryPoints: ["page/drawing/fragment.ts"], bundle: true, format: "iife", globalName: "fragment", write: false });
  browser ??= await chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox"] });
  const page = await browser.newPage();
  const loads: string[] = [];
  page.on("request", (request) => loads.push(request.url()));
  const [alone, among, icons, ran] = await page.evaluate(
    ([code, fine, foul]) => {
      const { nodes, all, icon } = new Function(`${code}; return fragment`)() as typeof import("../page/drawing/fragment");
      const put = (found: SVGElement[]): number => {
        document.body.append(...found);
        return found.length;
      };
      const lone = [...fine, ...foul].map((svg) => put(nodes(svg)));
      const mixed = foul.map((svg) => all([...fine, svg, fine[0]!]).map(put));
      const small = [...fine, ...foul].map((svg) => icon(`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">${svg}</svg>`) !== null);
      return [lone, mixed, small, (window as { ran?: number }).ran ?? 0] as const;
    },
    [made.outputFiles[0]!.text, FINE, FOUL] as const,
  );
  assert.deepEqual(alone, [1, 1, ...FOUL.map(() => 0)]);
  for (const [nth, found] of among.entries()) assert.deepEqual(found, [1, 1, 0, 1], FOUL[nth]);
  assert.deepEqual(icons, [true, true, ...FOUL.map(() => false)]);
  assert.equal(ran, 0);
  assert.deepEqual(loads, []);
});
