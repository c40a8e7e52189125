// Jobs: followed to their end on any connection, and resumed by a reloaded page.
import assert from "node:assert/strict";
import { test } from "node:test";
import { signal } from "@preact/signals";
import { inBrowser, shows } from "./browser";
import { begin, run, running, said, takeUp, type Done } from "../page/jobs/jobs";
import type { Finish, Lsp } from "../page/server/lsp";
import * as session from "../page/server/session";

/** A page with a test server. */
async function page(): Promise<{ tell: (method: string, params: unknown) => void; greet: (jobs: session.Going[]) => Promise<unknown>; resumed: session.Going[] }> {
  let [greeting, number, jobs]: [(lsp: Lsp) => Promise<Finish>, number, session.Going[]] = [async () => {}, 0, []];
  const takers = new Map<string, (params: any) => void>();
  const lsp: Lsp = {
    open: signal(true),
    on: (method, take) => (takers.set(method, take), () => {}),
    request: async (method: string): Promise<any> => {
      if (method === "afp/hello") return { client: 1, root: "file:///w", open: null, pen: true, files: [], examples: [], jobs, longest: 100 };
      if (method === "afp/trust") return { trusted: true, code: [] };
      return method === "afp/job" ? { id: ++number } : { capabilities: {} };
    },
    notify: () => {},
  };
  session.begin("", async () => {}, (_, greet) => ((greeting = greet!), lsp));
  session.going.value = [];
  const resumed: session.Going[] = [];
  begin((job) => resumed.push(job));
  const greet = (now: session.Going[]) => ((jobs = now), greeting(lsp));
  await greet([]);
  return { tell: (method, params) => takers.get(method)!(params), greet, resumed };
}

const order = { kind: "new", name: "x" };
const done = (id: number): Done => ({ id, ok: true, code: 0, results: [], said: "" });
const soon = () => new Promise((done) => setTimeout(done, 5));

test("a job continues to its end on the next connection, unless the server does not know it", async () => {
  const { tell, greet, resumed } = await page();
  const one = run("one", order);
  const two = run("two", order);
  await soon();
  assert.deepEqual(running.value.map(({ title }) => title), ["one", "two"]);
  await greet([{ id: 2, order, said: "a line" }]);
  assert.equal((await one)?.ok, false);
  assert.deepEqual(resumed, []);
  tell("afp/jobSaid", { id: 2, text: "another\nlast" });
  assert.deepEqual(running.value.map(({ id, last }) => [id, last]), [[2, "last"]]);
  tell("afp/jobDone", done(2));
  assert.equal((await two)?.ok, true);
  assert.deepEqual(running.value, []);
  assert.deepEqual(said.value, ["> one", "> two", "another", "last"]);
});

test("a reloaded page shows running jobs, and jobs that have ended meanwhile", async () => {
  const { tell, greet, resumed } = await page();
  await greet([{ id: 7, order, said: "before" }]);
  assert.deepEqual(resumed.map(({ id }) => id), [7]);
  const end = takeUp(resumed[0]!, "seven");
  assert.deepEqual(running.value, [{ id: 7, title: "seven", last: "before" }]);
  tell("afp/jobDone", done(7));
  assert.equal((await end).ok, true);
});

const PLAN = `use std
use carbot

plan Away {
    start go

    actor go: Forward(distance = 40 cm) { ForwardSuccessful -> terminate }
}
`;

inBrowser("a sweep continues while the page reloads, and can be ended there", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator(".node text").first().waitFor();
  await page.keyboard.press("Control+k");
  await page.keyboard.type("build and sweep");
  await page.keyboard.press("Enter");
  const sweep = async (seeds: string): Promise<void> => {
    await page.getByLabel("Seeds").fill(seeds);
    await page.getByRole("button", { name: "Run many times" }).click();
    await page.locator(".busy").waitFor();
    await page.reload();
    await page.locator(".node text").first().waitFor();
  };
  const ends = page.getByRole("button", { name: "Cancel", exact: true });
  // A long job continues during a reload.
  await sweep("0..99999");
  assert.equal(await page.getByLabel("Seeds").inputValue(), "0..99999");
  await ends.click();
  await ends.waitFor({ state: "detached", timeout: 60_000 });
  await shows(page.locator(".endings"), /ended early, after \d+ of 99999 runs/);
  // A short job may end before, during or after the reload: all results are shown.
  await sweep("0..2000");
  await page.locator(".endings", { hasText: "2000" }).waitFor({ timeout: 60_000 });
  await ends.waitFor({ state: "detached" });
  await page.locator(".map td button").first().waitFor();
});
