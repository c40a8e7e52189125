// A document has the same address in the page and on the server.
import assert from "node:assert/strict";
import { test } from "node:test";
import { pathOf, uriOf } from "../page/documents/addresses";
import { hello, type Hello } from "../page/server/session";
import { inBrowser, shows } from "./browser";

test("relative and absolute paths convert to the server's addresses and back", () => {
  hello.value = { root: "file:///w/robot%20%28copy%29" } as Hello;
  const root = "/w/robot (copy)";
  for (const [path, written] of [
    ["a.afp", "a.afp"],
    ["tests/room (1).afp", "tests/room%20%281%29.afp"],
    ["it's!*~-_.afp", "it%27s%21%2A~-_.afp"],
    ["gr\u00f6\u00dfe.afp", "gr%C3%B6%C3%9Fe.afp"],
  ] as const) {
    const uri = `file:///w/robot%20%28copy%29/${written}`;
    assert.deepEqual([uriOf(path), uriOf(`${root}/${path}`), pathOf(uri)], [uri, uri, `${root}/${path}`]);
  }
});

const PLAN = `use carbot

plan Away {
    start go

    actor go: Forward(distance = 40 cm) { ForwardSuccessful -> terminate }
}
`;
const SCENARIO = `use "../plan.afp"

scenario "never there" for Away {
    expect end by OK before 1 ms
    until 1 s
}
`;

inBrowser("the text of a failed scenario is opened under its address, and saved", { "plan.afp": PLAN, "tests/room (1).afp": SCENARIO }, async ({ page, becomes, isSaved }) => {
  await page.locator(".node text").first().waitFor();
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-line", { hasText: "start go" }).waitFor();
  await page.keyboard.press("Control+k");
  await page.keyboard.type("scenarios");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Run scenarios" }).click();
  await page.getByRole("button", { name: "never there" }).click({ timeout: 60_000 });
  await page.getByRole("button", { name: /room \(1\)\.afp:3/ }).click();
  await shows(page.locator(".bar .file"), /room \(1\)\.afp/);
  await page.locator(".cm-line", { hasText: "until 1 s" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(" // here");
  await becomes("tests/room (1).afp", /until 1 s \/\/ here/);
  await isSaved();
});
