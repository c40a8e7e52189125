// A killed server: finished changes are on the disk when a server runs again.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { AFPC, inBrowser, shows } from "./browser";

const PLAN = `use std

plan P {
    start go

    actor go: Wait(duration = 1 s) { Elapsed -> rest }
    actor rest: Wait(duration = 2 s) { Elapsed -> terminate }
}
`;

inBrowser("a server that is killed during a drag loses no finished edit", { "plan.afp": PLAN }, async ({ page, read, becomes, crash, restart }) => {
  const node = page.locator('.node [data-item="P.rest"] text.name').first();
  await node.waitFor();
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-line", { hasText: "start go" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(" // typed before");
  const { x, y } = (await node.boundingBox())!;
  await page.mouse.move(x + 5, y + 5);
  await page.mouse.down();
  await page.mouse.move(x + 40, y + 40);
  await crash();
  await page.mouse.move(x + 130, y + 90, { steps: 4 });
  await page.mouse.up();
  await page.locator(".banner.warning").waitFor();
  await page.locator(".cm-line", { hasText: "plan P" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(" // typed without a server");
  assert.ok(!(await read("plan.afp")).includes("without"));
  assert.equal(await page.locator(".saved.saved:not(.saving, .failed)").count(), 0);
  await restart();
  await page.locator(".saved.saved:not(.saving, .failed)").waitFor();
  const text = await read("plan.afp");
  assert.match(text, /plan P \{ \/\/ typed without a server/);
  assert.match(text, /start go \/\/ typed before/);
  // The server computes the result of the drag after the restart.
  await becomes("plan.afp.layout", /rest/);
}, { ignore: /WebSocket|connection/i });

const typed = " // typed without a server";

/** Types into the text while the server is dead. */
async function typeAlone(page: Page, crash: () => Promise<void>): Promise<void> {
  await page.locator(".node text").first().waitFor();
  await page.locator(".rail button", { hasText: "Text" }).click();
  await page.locator(".cm-line", { hasText: "start go" }).waitFor();
  await crash();
  await shows(page.locator(".banner.warning"), /start it again with 'afpc studio \S+ --port \d+' and open the printed address/);
  await page.locator(".cm-line", { hasText: "start go" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(typed);
}

/** An address with a code for the server of a folder, as printed by a second start. */
const codeFor = (folder: string): string =>
  /http:\S+/.exec(spawnSync(AFPC, ["studio", folder, "--no-open"], { encoding: "utf8", env: { ...process.env, XDG_CONFIG_HOME: join(folder, ".config") } }).stdout)![0];

const WHOLE = PLAN.replace("start go", `start go${typed}`);
const ignore = /WebSocket|connection/i;

inBrowser("text typed without a server is kept if another page has taken the edit lock", { "plan.afp": PLAN }, async ({ page, folder, crash, restart, read, holds }) => {
  await typeAlone(page, crash);
  // Another browser comes first; this one has no code yet.
  const others = await page.context().browser()!.newContext();
  const other = await others.newPage();
  await other.goto(await restart(false));
  await other.locator(".node text").first().waitFor();
  await page.context().request.get(codeFor(folder));
  await page.getByText("This one is read-only").waitFor();
  await shows(page.locator(".saved"), /not saved/);
  assert.equal(await read("plan.afp"), PLAN);
  await page.getByRole("button", { name: "Keep mine" }).click();
  await holds("plan.afp", WHOLE);
  await page.locator(".saved.saved:not(.saving, .failed)").waitFor();
  await page.getByRole("button", { name: "Undo: Keep mine" }).click();
  await holds("plan.afp", PLAN);
  await others.close();
}, { ignore });

inBrowser("text typed without a server is offered to the next page", { "plan.afp": PLAN }, async ({ page, crash, restart, read, holds }) => {
  await typeAlone(page, crash);
  let asked = 0;
  page.on("dialog", (dialog) => void (asked++, dialog.accept()));
  const address = await restart(false);
  await page.goto(address);
  assert.equal(asked, 1, "the page asks before it is left");
  await page.getByRole("button", { name: "Keep mine" }).waitFor();
  assert.equal(await read("plan.afp"), PLAN);
  // The question reappears, because it was not answered.
  await page.reload();
  await page.getByRole("button", { name: "Keep mine" }).click();
  await holds("plan.afp", WHOLE);
  await page.locator(".saved.saved:not(.saving, .failed)").waitFor();
  await page.reload();
  await page.locator(".node text").first().waitFor();
  assert.equal(await page.getByRole("button", { name: "Keep mine", exact: true }).count(), 0);
}, { ignore });
