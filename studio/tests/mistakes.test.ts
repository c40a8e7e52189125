// Errors of the command line, parsed for the page.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { mistakes } from "../page/jobs/mistakes";
import { AFPC } from "./browser";

const PLAN = `use std

plan P {
    start pause
    actor pause: Wait(duration = 1) { Elapsed -> terminate }
}
`;

/** The objects that the real program prints for a build of this plan. */
function built(plan: string): any[] {
  const folder = mkdtempSync(join(tmpdir(), "afp-mistakes-"));
  writeFileSync(join(folder, "p.afp"), plan);
  const env = { ...process.env, CARGO: join(folder, "no-cargo") };
  const { stdout } = spawnSync(AFPC, ["build", "--json", "p.afp"], { cwd: folder, env, encoding: "utf8" });
  rmSync(folder, { recursive: true });
  return stdout.trim().split("\n").map((line) => JSON.parse(line));
}

test("errors are found with and without a place; warnings and the summary are not errors", { skip: !AFPC && "AFPC does not say where afpc is" }, () => {
  const [wrong, ...more] = mistakes(built(PLAN));
  assert.deepEqual([wrong?.code, wrong?.place?.file, wrong?.place?.line, wrong?.place?.column, more.length], ["E0203", "p.afp", 5, 34, 0]);
  assert.match(wrong!.message, /^expected a duration/);
  const [missing, ...others] = mistakes(built(PLAN.replace("1)", "1 s)").replace("start", "var unused: bool\n    start")));
  assert.deepEqual([missing?.code, missing?.place, others.length], [null, null, 0]);
  assert.match(missing!.help, /rustup/);
  assert.deepEqual(mistakes([{ severity: "warning", message: "unused" }, { summary: { built: true } }]), []);
});
