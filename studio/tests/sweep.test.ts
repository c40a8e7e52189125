// The outcome map of a sweep, without a page and on it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { inBrowser, shows } from "./browser";
import { counted, countedAll, grouped, mapOf, ROW, runsOf, sumOf, type Ending, type Run } from "../page/jobs/sweep";

const run = (nth: number, ending: Ending, seed: number, values: Record<string, number> = {}, why = ""): Run => ({
  run: nth, ending, seed, why, where: "go", time_s: 1, world: null, touched: {}, command: "",
  values: Object.fromEntries(Object.entries(values).map(([name, si]) => [name, { text: `${si * 100} cm`, si }])),
});

test("two varied values are sorted columns and rows; a third one is merged in a cell", () => {
  const far = [0.2, 1, 0.3];
  const runs = far.flatMap((dist, at) => [0.1, 0.2].flatMap((gain, nth) => [0, 1].map((seed) => run(4 * at + 2 * nth + seed, seed ? "error" : "ok", seed, { dist, gain }))));
  const map = mapOf(runs);
  assert.deepEqual(map.across, { name: "dist", labels: ["20 cm", "30 cm", "100 cm"] });
  assert.deepEqual(map.down, { name: "gain", labels: ["10 cm", "20 cm"] });
  assert.deepEqual(map.cells.map((row) => row.map((cell) => cell.length)), [[2, 2, 2], [2, 2, 2]]);
  assert.ok(map.cells[1]![2]!.every(({ values }) => values.dist!.si === 1 && values.gain!.si === 0.2));
  assert.deepEqual(counted(map.cells[0]![0]!), [{ ending: "ok", count: 1 }, { ending: "error", count: 1 }]);
});

test("seeds are wrapped into rows; a constant value is not in the map", () => {
  const one = mapOf([2, 1].flatMap((dist, at) => [0, 1].map((seed) => run(2 * at + seed, "ok", seed, { dist, same: 1 }))));
  assert.deepEqual([one.across.name, one.down.name, one.across.labels], ["dist", "seed", ["100 cm", "200 cm"]]);
  const seeds = mapOf(Array.from({ length: ROW + 3 }, (_, seed) => run(seed, "ok", seed)));
  assert.deepEqual(seeds.down.labels, ["0", String(ROW)]);
  assert.deepEqual(seeds.cells.map((row) => row.length), [ROW, 3]);
  assert.equal(mapOf([run(0, "ok", 5)]).cells.flat(2).length, 1);
});

test("runs with equal results are one line, and the summary is not a run", () => {
  const runs = [run(0, "ok", 0), run(1, "error", 1, {}, "fault"), run(2, "error", 2, {}, "fault")];
  assert.deepEqual(grouped(runs).map(({ run, count }) => [run.run, count]), [[1, 2], [0, 1]]);
  assert.deepEqual(runsOf([...runs, { summary: { runs: 3 } }]), runs);
});

test("the summary covers all runs, also runs that are not listed", () => {
  const summary = { runs: 9, of: 100, endings: { error: 2, ok: 7 } };
  const lines = [run(0, "ok", 0), { summary }];
  assert.deepEqual(sumOf(lines), summary);
  assert.deepEqual(countedAll(runsOf(lines), sumOf(lines)), [{ ending: "ok", count: 7 }, { ending: "error", count: 2 }]);
  // A killed sweep has no summary.
  assert.deepEqual([sumOf([run(0, "ok", 0)]), sumOf([]), countedAll([run(0, "ok", 0)], null)], [null, null, [{ ending: "ok", count: 1 }]]);
});

const PLAN = `use std
use carbot

plan Away {
    in way: length = 40 cm

    start go

    actor go: Forward(distance = way) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> terminate }
        ForwardSuccessful -> terminate
    }
}
`;

inBrowser("a plan is run many times; a cell of the map shows the results of its runs, and a run can be watched", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator(".node text").first().waitFor();
  await page.keyboard.press("Control+k");
  await page.keyboard.type("build and sweep");
  await page.keyboard.press("Enter");
  await page.getByLabel("Seeds").fill("0..3");
  await page.getByLabel("Vary").fill("way=20cm,2m");
  await page.getByLabel("Until").fill("20 s");
  await page.getByRole("button", { name: "Run many times" }).click();
  await page.locator(".map td button").first().waitFor({ timeout: 60_000 });
  assert.equal(await page.locator(".map td button").count(), 6);
  await shows(page.locator(".endings"), /3 ended OK[\s\S]*3 interrupted/);
  await page.getByRole("button", { name: /^way = 2m, seed 1: / }).click();
  await shows(page.locator(".chosen"), /way = 2m, seed 1[\s\S]*touched/);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Enter");
  await shows(page.locator(".chosen"), /way = 20cm, seed 1/);
  await page.locator(".chosen").getByRole("button", { name: "Watch it" }).click();
  await page.locator(".end-card").waitFor({ timeout: 30_000 });
  await shows(page.locator(".given"), /way = 20cm/);
  assert.equal(await page.getByLabel("Seed", { exact: true }).inputValue(), "1");
  await page.getByRole("button", { name: "Reset way" }).click();
  assert.equal(await page.locator(".given").count(), 0);
});

inBrowser("an invalid sweep value is explained at its field", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator(".node text").first().waitFor();
  await page.keyboard.press("Control+k");
  await page.keyboard.type("build and sweep");
  await page.keyboard.press("Enter");
  for (const [field, wrong, says] of [
    ["Seeds", "5..2", /^Seeds '5\.\.2': '5\.\.2' has no seeds/],
    ["Vary", "way", /^Vary 'way': expected a name and its values/],
    ["Until", "0 s", /'0 s' is not a time: write for example '30 s'/],
  ] as const) {
    const input = page.getByLabel(field, { exact: true });
    const before = await input.inputValue();
    await input.fill(wrong);
    await page.getByRole("button", { name: "Run many times" }).click();
    await shows(page.locator(".banner.error"), says);
    await input.fill(before);
  }
}, { ignore: /Seeds '|Vary '|is not a time/ });
