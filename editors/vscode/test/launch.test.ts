// Tests launch configurations, and that the extension's proposals can be launched: with the test
// client of VS Code's adapters and the real adapter.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { DebugClient } from "@vscode/debugadapter-testsupport";
import { adapterOf, argumentsOf, completed, isElsewhere, launchOf, programOf, type Launch } from "../src/launch";
import { DRIVE, Robot } from "../../../studio/tests/driven";
import { AFPC, serving } from "./server";

const manifest = JSON.parse(readFileSync("package.json", "utf8"));
const [debuggers] = manifest.contributes.debuggers;
const open = { path: "/w/a.afp", language: "afp" };

test("F5 without a configuration file debugs the open plan in real time", () => {
  assert.deepEqual(completed({}, open), { type: "afp", request: "launch", name: "Debug the plan", program: "/w/a.afp", speed: 1 });
  assert.equal(completed({}, null), "Open a plan first.");
  assert.equal(completed({}, { path: "/w/afp.toml", language: "toml" }), "Open a plan first.");
});

test("a configuration reports missing values and may use full speed", () => {
  assert.match(completed({ type: "afp", name: "x" }, open) as string, /needs a 'program'/);
  assert.match(completed({ type: "afp", program: "a", log: "b" }, open) as string, /not both/);
  assert.equal((completed({ type: "afp", program: "a", speed: null }, open) as Launch).speed, undefined);
  assert.equal((completed({ type: "afp", program: "a", speed: 3 }, open) as Launch).speed, 3);
});

test("a run is joined with the output of its server", () => {
  const attach = { type: "afp", request: "attach", name: "x", port: 4711, token: "t" };
  assert.deepEqual(completed(attach, null), attach);
  const robot = { type: "afp", request: "attach", name: "x", host: "afp@robot.local" };
  assert.deepEqual(completed(robot, null), robot);
  assert.deepEqual([isElsewhere(robot), isElsewhere(attach)], [true, false]);
  assert.match(completed({ ...attach, token: "" }, open) as string, /the 'port' and the 'token'/);
  assert.match(completed({ ...attach, port: undefined }, open) as string, /the 'port' and the 'token'/);
});

test("a lens has the name of its plan", () => {
  assert.equal(launchOf("/w/a.afp", "Patrol").program, "/w/a.afp:Patrol");
  assert.deepEqual(programOf("C:\\w\\a.afp:Patrol"), { file: "C:\\w\\a.afp", plan: "Patrol" });
  assert.deepEqual(programOf("C:\\w\\a.afp"), { file: "C:\\w\\a.afp", plan: null });
  assert.deepEqual(argumentsOf("run", "/w/a.afp", "Patrol"), ["run", "/w/a.afp:Patrol"]);
  assert.deepEqual(argumentsOf("test", "/w/a.afp", "a scenario"), ["test", "/w/a.afp"]);
});

test("the options match docs/debug.md", () => {
  const page = readFileSync("../../docs/debug.md", "utf8");
  const table = page.slice(page.indexOf("## Launch arguments"), page.indexOf("## Debug a log"));
  const rows = table.split("\n").filter((line) => line.startsWith("| `"));
  const named = rows.flatMap((row) => [...row.split("|")[1]!.matchAll(/`(\w+)`/g)].map(([, name]) => name!));
  // The token is only for clients that connect.
  const documented = named.filter((name) => name !== "token").sort();
  assert.deepEqual(Object.keys(debuggers.configurationAttributes.launch.properties).sort(), documented);
});

for (const [nth, config] of [...debuggers.initialConfigurations, ...debuggers.configurationSnippets.slice(0, 2).map((one: { body: Launch }) => one.body)].entries()) {
  test(`a proposed configuration can be launched, ${nth + 1}: ${config.name}`, () =>
    serving(async ({ file }) => {
      const text = JSON.stringify(config).replaceAll('"^\\"\\\\${file}\\""', '"${file}"').replaceAll("${file}", file);
      const launch = completed(JSON.parse(text), null) as Launch;
      // At full speed, the test need not wait.
      delete launch.speed;
      const client = new DebugClient(AFPC, "", "afp");
      const adapter = spawn(AFPC, adapterOf(launch), { stdio: ["pipe", "pipe", "inherit"] });
      // The client itself could start it with one argument at most.
      (client as unknown as { connect(from: object, to: object): void }).connect(adapter.stdout, adapter.stdin);
      await client.initializeRequest();
      const ready = client.waitForEvent("initialized");
      await client.launch({ until: 2, ...launch } as never);
      await ready;
      const breakpoints = [{ line: 5 }];
      const set = await client.setBreakpointsRequest({ source: { path: file }, breakpoints });
      assert.deepEqual(set.body.breakpoints.map(({ verified, line }) => [verified, line]), [[true, 5]]);
      const stopped = client.waitForEvent("stopped");
      await client.configurationDoneRequest();
      assert.equal((await stopped).body?.reason, launch.stopOnEntry ? "entry" : "breakpoint");
      await client.disconnectRequest();
      adapter.kill();
    }));
}

test("a breakpoint of the editor holds a robot that drives, and the editor continues it", async () => {
  const robot = new Robot();
  const client = new DebugClient(AFPC, "dap", "afp");
  try {
    await robot.begin();
    await robot.wheels("turn");
    const attach = completed({ type: "afp", request: "attach", name: "Robot", socket: robot.socket, role: "operator" }, null) as Launch;
    assert.ok(isElsewhere(attach));
    await client.start();
    await client.initializeRequest();
    const ready = client.waitForEvent("initialized");
    await client.attachRequest(attach as never);
    await ready;
    const line = 1 + DRIVE.split("\n").findIndex((each) => each.includes("actor rest"));
    // The editor's file is on another machine than the robot's.
    const set = await client.setBreakpointsRequest({ source: { path: "/home/me/plans/drive.afp" }, breakpoints: [{ line }] });
    assert.deepEqual(set.body.breakpoints.map((each) => [each.verified, each.line]), [[true, line]]);
    const stopped = client.waitForEvent("stopped", 60_000);
    await client.configurationDoneRequest();
    assert.equal((await stopped).body?.reason, "breakpoint");
    await robot.wheels("stop");
    const stack = await client.stackTraceRequest({ threadId: 1 });
    assert.deepEqual([stack.body.stackFrames[0]?.name, stack.body.stackFrames[0]?.source?.path], ["rest: Wait", "/home/me/plans/drive.afp"]);
    await client.setBreakpointsRequest({ source: { path: "/home/me/plans/drive.afp" }, breakpoints: [] });
    await client.continueRequest({ threadId: 1 });
    await robot.wheels("turn");
    const ended = client.waitForEvent("terminated", 60_000);
    await client.customRequest("terminate");
    await ended;
    assert.equal(await robot.ends(), 0);
  } finally {
    // With the run, the adapter has ended: it would not answer a request.
    client["stopAdapter"]();
    await robot.end();
  }
});
