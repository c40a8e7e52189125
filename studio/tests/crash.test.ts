// A server that is killed in the middle of something: what was finished is on the disk once there is a server again.
import assert from "node:assert/strict";
import { inBrowser } from "./browser";

const PLAN = `use std

plan P {
    start go

    actor go: Wait(duration = 1 s) { Elapsed -> rest }
    actor rest: Wait(duration = 2 s) { Elapsed -> terminate }
}
`;

inBrowser("a server killed in mid-drag loses no finished edit", { "plan.afp": PLAN }, async ({ page, read, crash, restart }) => {
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
  assert.match(await read("plan.afp.layout"), /rest/);
}, { ignore: /WebSocket|connection/i });
