// The disk and the page's saved state: "saved" only appears for written text, and no byte is lost.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { mkdir, readFile, rename, rm, symlink, writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { AFPC, inBrowser, settled, shows } from "./browser";

const PLAN = `use std

plan P {
    start go

    actor go: Wait(duration = 1 s) { Elapsed -> rest }
    actor rest: Wait(duration = 2 s) { Elapsed -> terminate }
}
`;

/** Types at the end of a line. */
async function type(page: Page, line: string, text: string): Promise<void> {
  await page.locator(".cm-line", { hasText: line }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(text);
}

const openText = (page: Page): Promise<void> => page.locator(".rail button", { hasText: "Text" }).click();

/** The page shows "saved" only while the file equals the text. */
const isHonest = async (page: Page, on: () => Promise<string>, wanted: string): Promise<void> => {
  const said = await page.locator(".saved").getAttribute("class");
  if (/\bsaved saved\b/.test(said ?? "")) assert.equal(await on(), wanted);
};

inBrowser("an unwritable file is reported as unsaved, and is saved as soon as possible", { "plan.afp": PLAN }, async ({ page, folder, read, holds, isSaved }) => {
  await page.locator(".node text").first().waitFor();
  await openText(page);
  const file = join(folder, "plan.afp");
  await rename(file, `${file}.kept`);
  await mkdir(file);
  await type(page, "start go", " // one");
  await shows(page.locator(".saved"), /not saved/);
  await shows(page.locator(".banner.error"), /not saved: /);
  const wanted = PLAN.replace("start go", "start go // one");
  for (let round = 0; round < 5; round++) {
    await isHonest(page, () => read("plan.afp"), wanted);
    await page.waitForTimeout(200);
  }
  await rm(file, { recursive: true });
  await rename(`${file}.kept`, file);
  await isSaved();
  await holds("plan.afp", wanted);
  assert.equal(await page.locator(".banner.error").count(), 0);
});

inBrowser("no letter is lost while another program keeps writing", { "plan.afp": `// 0\n\n${PLAN}` }, async ({ page, folder, holds, isSaved, read }) => {
  await page.locator(".node text").first().waitFor();
  await openText(page);
  await type(page, "start go", " // ");
  const file = join(folder, "plan.afp");
  let written = 0;
  const other = setInterval(() => {
    // At both ends of the file in one write, so that nothing is saved in between.
    const now = readFileSync(file, "utf8");
    if (now) writeFileSync(file, `${now.replace(/^\/\/ \d+/, `// ${++written}`).trimEnd()}\n${written % 2 ? "// end\n" : ""}`.replace("// end\n// end\n", "// end\n"));
  }, 170);
  const letters = "abcdefghijklmnopqrstuvwxyz".repeat(4);
  await page.keyboard.type(letters, { delay: 35 });
  clearInterval(other);
  await isSaved();
  assert.ok(written > 5);
  const now = await read("plan.afp");
  assert.ok(now.includes(`start go // ${letters}\n`), now);
  assert.ok(now.startsWith(`// ${written}\n`), now);
  await holds("plan.afp", await page.evaluate(() => [...document.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\n")));
});

inBrowser("mixed line endings stay, and pasted text does not add new kinds", { "plan.afp": PLAN.replace("\n", "\r\n") }, async ({ page, holds, isSaved }) => {
  await page.locator(".node text").first().waitFor();
  await openText(page);
  await type(page, "use std", " x");
  await page.keyboard.press("Backspace");
  await page.keyboard.press("Backspace");
  await page.evaluate(() => {
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", " // a\r\n// b\r// c");
    document.querySelector(".cm-content")!.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
  });
  await type(page, "start go", " // here");
  await isSaved();
  const wanted = PLAN.replace("start go", "start go // here").replace("use std\n", "use std // a\r\n// b\r\n// c\r\n");
  await holds("plan.afp", wanted);
});

inBrowser("a long text is accepted, and a text above the limit is refused", { "plan.afp": PLAN }, async ({ page, holds, isSaved }) => {
  await page.locator(".node text").first().waitFor();
  await openText(page);
  const lines = (mebibytes: number): string => `\n// ${"x".repeat(60)}`.repeat(mebibytes * 2 ** 14);
  const paste = (mebibytes: number) =>
    page.evaluate((text) => {
      const clipboardData = new DataTransfer();
      clipboardData.setData("text/plain", text);
      document.querySelector(".cm-content")!.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
    }, lines(mebibytes));
  await type(page, "start go", " // here");
  await paste(1.5);
  await isSaved();
  const wanted = PLAN.replace("start go", `start go // here${lines(1.5)}`);
  await holds("plan.afp", wanted);
  await paste(2.5);
  await shows(page.locator(".banner.error"), /at most 4 MiB/);
  await isSaved();
  await holds("plan.afp", wanted);
});

inBrowser("a file that another program removes is not saved until it is changed", { "plan.afp": PLAN }, async ({ page, folder, holds, isSaved, read }) => {
  await page.locator(".node text").first().waitFor();
  await openText(page);
  await rm(join(folder, "plan.afp"));
  await shows(page.locator(".banner.error"), /removed 'plan.afp'/);
  assert.equal(await read("plan.afp"), "");
  await type(page, "start go", " // still here");
  await isSaved();
  await holds("plan.afp", PLAN.replace("start go", "start go // still here"));
});

inBrowser("a new plan under the name of a removed plan is shown and can be edited", { "plan.afp": PLAN, "other.afp": PLAN }, async ({ page, folder, becomes, isSaved, read }) => {
  await page.locator(".node text").first().waitFor();
  await openText(page);
  await page.getByRole("button", { name: "Files" }).click();
  await page.getByRole("menuitemradio", { name: "plan.afp" }).click();
  await page.locator(".bar .file", { hasText: "plan.afp" }).waitFor();
  await page.locator(".cm-line", { hasText: "start go" }).waitFor();
  await rm(join(folder, "plan.afp"));
  await shows(page.locator(".banner.error"), /removed 'plan.afp'/);
  await page.getByRole("button", { name: "Files" }).click();
  await page.getByRole("menuitem", { name: "New plan" }).click();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("plan");
  await page.keyboard.press("Enter");
  await becomes("plan.afp", /plan Plan/);
  const made = await read("plan.afp");
  await isSaved();
  await type(page, "plan Plan", " // here");
  await becomes("plan.afp", /here/);
  assert.equal(await read("plan.afp"), made.replace("plan Plan {", "plan Plan { // here"));
});

inBrowser("a full disk keeps the old bytes, and receives the new bytes once it has space", { "plan.afp": PLAN }, async ({ page, folder, isSaved, read }) => {
  // A separate small file system, if the test may create one.
  const small = join(folder, "small");
  await mkdir(small);
  const made = spawnSync("mount", ["-t", "tmpfs", "-o", "size=16k", "tmpfs", small]);
  if (made.status !== 0) return void console.log("no full disk: a file system cannot be mounted here");
  try {
    await writeFile(join(small, "there.afp"), PLAN);
    await page.reload();
    await page.getByRole("button", { name: "Files" }).click();
    await page.getByRole("menuitemradio", { name: "small/there.afp" }).click();
    await page.locator(".bar .file", { hasText: "there.afp" }).waitFor();
    await openText(page);
    await writeFile(join(small, "filler"), Buffer.alloc(64_000)).catch(() => {});
    await type(page, "start go", ` // ${"x".repeat(60)}`);
    await shows(page.locator(".saved"), /not saved/);
    assert.equal(await read("small/there.afp"), PLAN);
    // The text equals the file again, so it counts as saved, although writes fail.
    await page.getByRole("button", { name: "Undo: typing" }).click();
    await isSaved();
    await page.getByRole("button", { name: "Redo: typing" }).click();
    await shows(page.locator(".saved"), /not saved/);
    await rm(join(small, "filler"));
    await isSaved();
    assert.equal(await read("small/there.afp"), PLAN.replace("start go", `start go // ${"x".repeat(60)}`));
  } finally {
    spawnSync("umount", ["-l", small]);
  }
});

inBrowser("simultaneous changes of two programs are merged and saved; conflicts in a line need a choice", { "plan.afp": PLAN }, async ({ page, folder, read, write, holds, isSaved }) => {
  await page.locator(".node text").first().waitFor();
  await openText(page);
  const file = join(folder, "plan.afp");
  for (let round = 0; round < 3; round++) {
    await type(page, "start go", ` // ${round}`);
    // In one write: the other program would undo a save in between, which would cause a conflict.
    writeFileSync(file, readFileSync(file, "utf8").replace("terminate }", `terminate } // ${round}`));
    await isSaved();
  }
  const before = await read("plan.afp");
  for (let round = 0; round < 3; round++) assert.match(before, new RegExp(`start go.* // ${round}[^]*terminate }.* // ${round}`));
  await type(page, "actor go", " // mine");
  await write("plan.afp", before.replace("-> rest }", "-> rest } // theirs"));
  await shows(page.locator(".saved"), /not saved/);
  await page.getByRole("button", { name: "Keep both, marked" }).click();
  await isSaved();
  assert.match(await read("plan.afp"), /<<<<<<<[^]*mine[^]*=======[^]*theirs[^]*>>>>>>>/);
  await page.locator(".count", { hasText: "error" }).click();
  await page.locator(".problems", { hasText: "is a conflict marker" }).waitFor();
  // The choice was made in this page.
  await page.getByRole("button", { name: "Undo: Keep both, marked" }).click();
  await holds("plan.afp", before.replace("-> rest }", "-> rest } // mine"));
});

inBrowser("a link stays a link, and its target is written", {}, async ({ page, folder, read, isSaved }) => {
  await mkdir(join(folder, "real"));
  await writeFile(join(folder, "real/plan.afp"), PLAN.replaceAll("\n", "\r\n"));
  await symlink("real/plan.afp", join(folder, "plan.afp"));
  await page.reload();
  await page.locator(".node text").first().waitFor();
  await openText(page);
  await type(page, "start go", " // linked");
  await isSaved();
  const wanted = PLAN.replace("start go", "start go // linked").replaceAll("\n", "\r\n");
  assert.equal(await settled(() => read("real/plan.afp"), (now) => now === wanted), wanted);
  assert.equal(await readFile(join(folder, "plan.afp"), "utf8"), wanted);
});

inBrowser("a second studio in the folder opens the page of the first studio", { "a.afp": PLAN, "b.afp": PLAN.replaceAll("P", "Q") }, async ({ page, folder }) => {
  await page.locator(".node text").first().waitFor();
  const second = spawnSync(AFPC, ["studio", join(folder, "b.afp"), "--no-open"], { encoding: "utf8", timeout: 10_000, env: { ...process.env, XDG_CONFIG_HOME: join(folder, ".config") } });
  assert.equal(second.status, 0, second.stderr);
  assert.match(second.stderr, /already serves this folder/);
  const address = /http:\S+/.exec(second.stdout)![0];
  assert.equal(new URL(address).port, new URL(page.url()).port);
  const other = await page.context().newPage();
  await other.goto(address);
  await other.locator(".bar .file", { hasText: "b.afp" }).waitFor();
  await other.locator(".banner", { hasText: "This one is read-only" }).waitFor();
  assert.equal(new URL(other.url()).hash, "");
});

inBrowser("an example has its world and its imported plans, and runs at once", {}, async ({ page, read }) => {
  await page.locator(".card", { hasText: "Find object" }).click();
  await page.locator(".bar .file", { hasText: "find_object.afp" }).waitFor();
  await page.locator(".count", { hasText: "ready" }).waitFor();
  for (const file of ["plans/find_object.afp", "plans/avoid_obstacle.afp", "worlds/find_object.toml"]) assert.notEqual(await read(file), "", file);
  await shows(page.locator(".where select"), /find_object\.toml/);
  await page.keyboard.press("F5");
  await page.locator(".clock:not(.held)").waitFor();
});
