// The page asks the server: it has no grammar of plans, no units and no patterns over drawings.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

const PAGE = new URL("../page", import.meta.url).pathname;
const files = (readdirSync(PAGE, { recursive: true }) as string[]).filter((name) => /\.tsx?$/.test(name));

/** Words that the page must not contain, except in some files: the names of files are not plans. */
const FORBIDDEN: [what: string, pattern: RegExp, except: readonly string[]][] = [
  ["a pattern of numbers with units", /\/[^/\n]*\\d[^/\n]*\[A-Za-z[^/\n]*\/[a-z]*\.(exec|test)/, []],
  ["a pattern of names in plans", /\[A-Za-z_\]\\w/, []],
  ["a unit in a string", /["'`](cm|mm|m\/s|cm\/s|deg|rad|ms)["'`]/, []],
  ["a pattern over elements of SVG", /\/[^/\n]*<\[\^>\]/, []],
  ["an item of a plan", /`(actor|computation|subplan|supervise|var|const|in|out) \$\{/, []],
  ["an item of a plan", /\$\{(kind|keyword)\} \$\{\w+\}:/, []],
  ["text of the command line taken apart", /--\(?(seeds|vary|until)/, []],
  ["a colour of a terminal", /\\u001b|\\x1b/, []],
];

test("the page has no grammar, no units and no patterns over drawings", () => {
  const found = files.flatMap((name) => {
    const text = readFileSync(join(PAGE, name), "utf8");
    return FORBIDDEN.filter(([, pattern, except]) => pattern.test(text) && !except.includes(name)).map(([what]) => `${name}: ${what}`);
  });
  assert.deepEqual(found, []);
  assert.ok(files.length > 100);
});
