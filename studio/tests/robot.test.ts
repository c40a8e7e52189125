// A folder with its own robot: nothing is built or run before it is trusted.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { inBrowser, shows } from "./browser";

const PLAN = `use std

plan Lonely {
    start rest
    actor rest: Wait(duration = 1 s) { Elapsed -> terminate }
}
`;

const PROJECT = `[robot]
toolbox = "rover"
sim = "Rover"

[toolboxes]
rover = { path = "rover.afp" }
`;

const TOOLBOX = `toolbox rover

/// A board.
device board {}
`;

const MANIFEST = `[package]
name = "rover"
version = "0.1.0"
edition = "2024"
`;

inBrowser("a robot of the folder is built and run only after the folder is trusted", { "plan.afp": PLAN, "afp.toml": PROJECT, "rover.afp": TOOLBOX, "Cargo.toml": MANIFEST }, async ({ page, read }) => {
  await page.locator(".node text").first().waitFor();
  await shows(page.locator(".world .empty"), /would build and run the robot 'rover::Rover' .*trust the folder/);
  await page.keyboard.press("F5");
  const question = page.getByRole("dialog");
  await shows(question, /Do you trust[^]*the robot of .*afp\.toml/);
  await question.getByRole("button", { name: "Cancel" }).click();
  await question.waitFor({ state: "detached" });
  assert.equal(await page.locator(".clock").count(), 0);
  assert.equal(await read("target/CACHEDIR.TAG"), "");

  // The crate does not exist: the error is shown, and nothing has started.
  await page.getByRole("button", { name: "Try again" }).click();
  await question.getByRole("button", { name: "Trust it" }).click();
  await shows(page.locator(".world .empty"), /cannot be (built|shown)/);
}, { timeout: 200_000 });

/** The example with its own robot, which takes minutes to build: only tested at night. */
const VACUUM = fileURLToPath(new URL("../../examples/vacuum", import.meta.url));

/** Its files, with paths to AFP's crates. */
function vacuum(): Record<string, string> {
  const names = readdirSync(VACUUM, { recursive: true, encoding: "utf8" }).filter((name) => /\.(afp|rs|toml|txt)$/.test(name) && !name.startsWith("target"));
  const crates = fileURLToPath(new URL("../../crates/", import.meta.url));
  return Object.fromEntries(names.map((name) => [name, readFileSync(`${VACUUM}/${name}`, "utf8").replaceAll(/"(\.\.\/)+crates\//g, `"${crates}`)]));
}

if (process.env.AFP_ROBOT) {
  inBrowser("the vacuum cleaner of a project drives in its own room", vacuum(), async ({ page }) => {
    await page.locator(".node text").first().waitFor();
    await page.keyboard.press("F5");
    await page.getByRole("dialog").getByRole("button", { name: "Trust it" }).click();
    await page.waitForFunction(() => /^[\d.]+ s$/.test(document.querySelector(".clock")?.textContent ?? ""), undefined, { timeout: 900_000 });
    await page.locator(".world svg").first().waitFor();
    // The page shows this robot's parts and none of the Carbot's.
    await shows(page.locator(".world"), /halt[^]*left[^]*right/);
    await page.locator(".sensors summary").click();
    await shows(page.locator(".sensors"), /cliff/i);
    assert.doesNotMatch(await page.locator(".world").innerText(), /escape|infrared/i);
    await page.keyboard.press("Shift+F5");
    await page.locator(".clock").waitFor({ state: "detached" });
  }, { timeout: 1_000_000, open: "plans/clean.afp" });
}
