// A folder that brings a robot of its own: nothing of it is built or run before somebody trusts it.
import assert from "node:assert/strict";
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

inBrowser("a robot of the folder is built and run once it is trusted, and not before", { "plan.afp": PLAN, "afp.toml": PROJECT, "rover.afp": TOOLBOX, "Cargo.toml": MANIFEST }, async ({ page, read }) => {
  await page.locator(".node text").first().waitFor();
  await shows(page.locator(".world .empty"), /the robot 'rover::Rover'.* would be built and run: .*trust the folder/);
  await page.keyboard.press("F5");
  const question = page.getByRole("dialog");
  await shows(question, /Do you trust[^]*the robot of .*afp\.toml/);
  await question.getByRole("button", { name: "Cancel" }).click();
  await question.waitFor({ state: "detached" });
  assert.equal(await page.locator(".clock").count(), 0);
  assert.equal(await read("target/CACHEDIR.TAG"), "");

  // There is no such crate: what is wrong with it is said, and nothing has started.
  await page.getByRole("button", { name: "Try again" }).click();
  await question.getByRole("button", { name: "Trust it" }).click();
  await shows(page.locator(".world .empty"), /cannot be (built|shown)/);
}, { timeout: 200_000 });
