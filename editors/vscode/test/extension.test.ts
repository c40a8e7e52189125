// Tests the thin layer with a stub of the editor and the real server. Visual Studio Code itself is
// not available without its own download.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, beforeEach, test } from "node:test";
import { hash } from "../../../studio/page/documents/hash";
import { activate, deactivate } from "../src/extension";
import { LanguageClient } from "./client";
import { AFPC, PLAN, there } from "./server";
import { Range, seen, Uri, window } from "./vscode";

const manifest = JSON.parse(readFileSync("package.json", "utf8"));
const folder = mkdtempSync(join(tmpdir(), "afp-vscode-"));
const file = join(folder, "plan.afp");
const uri = Uri.file(file);
const lens = { uri: uri.toString(), name: "Patrol" };

before(async () => {
  writeFileSync(file, PLAN);
  seen.command = AFPC;
  await activate({ subscriptions: [], extensionUri: Uri.file(process.cwd()) } as never);
  const textDocument = { uri: uri.toString(), languageId: "afp", version: 1, text: PLAN };
  await LanguageClient.current!.sendNotification("textDocument/didOpen", { textDocument });
});

after(async () => {
  await deactivate();
  rmSync(folder, { recursive: true });
});

beforeEach(() => {
  seen.trusted = true;
  window.activeTextEditor = { document: { uri, languageId: "afp" } } as never;
  for (const list of [seen.warnings, seen.errors, seen.tasks, seen.launched, seen.shown, seen.diagnostics]) list.length = 0;
});

const run = (name: string, ...args: unknown[]): unknown => seen.commands.get(name)!(...args);

test("every declared command exists, and every lens has a command", async () => {
  const announced = manifest.contributes.commands.map(({ command }: { command: string }) => command).sort();
  assert.deepEqual([...seen.commands.keys()].sort(), announced);
  const lenses = await LanguageClient.current!.sendRequest<{ command: { command: string; title: string } }[]>("textDocument/codeLens", { textDocument: { uri: uri.toString() } });
  assert.deepEqual(lenses.map(({ command }) => [command.title, command.command]), [["run", "afp.run"], ["debug", "afp.debug"], ["drawing", "afp.drawing"]]);
  for (const named of Object.values<{ command: string }[]>(manifest.contributes.menus).flat()) assert.ok(announced.includes(named.command), named.command);
});

test("the files in the manifest exist", () => {
  for (const path of [manifest.main, manifest.contributes.languages[0].configuration, manifest.contributes.grammars[0].path]) assert.ok(existsSync(path), path);
});

test("run and test are processes with arguments, not shell commands", () => {
  void run("afp.run", lens);
  void run("afp.test");
  assert.deepEqual(seen.tasks.map(({ execution }) => [execution.process, execution.args]), [[AFPC, ["run", `${file}:Patrol`]], [AFPC, ["test", file]]]);
});

test("debug launches the plan of its lens, with an adapter that has the plan", async () => {
  void run("afp.debug", lens);
  assert.equal(seen.launched[0]?.program, `${file}:Patrol`);
  const adapter = seen.factories.get("afp").createDebugAdapterDescriptor({ configuration: seen.launched[0] });
  assert.deepEqual([adapter.command, adapter.args, adapter.options], [AFPC, ["dap", `${file}:Patrol`], { cwd: folder }]);
});

test("a joined run uses the existing adapter", () => {
  const configuration = { type: "afp", request: "attach", port: 4711, token: "t" };
  const adapter = seen.factories.get("afp").createDebugAdapterDescriptor({ configuration });
  assert.equal(adapter.port, 4711);
});

test("an untrusted folder runs nothing, but plans are drawn", async () => {
  seen.trusted = false;
  for (const name of ["afp.run", "afp.test", "afp.debug"]) void run(name, lens);
  assert.equal(seen.warnings.length, 3);
  assert.deepEqual([seen.tasks, seen.launched], [[], []]);
  assert.throws(() => seen.factories.get("afp").createDebugAdapterDescriptor({ configuration: { program: file } }), /not trusted/);
  await run("afp.drawing", lens);
  assert.equal(seen.panels.length, 1);
});

test("without a plan the commands report it", () => {
  window.activeTextEditor = undefined;
  for (const name of ["afp.run", "afp.debug", "afp.drawing", "afp.graph"]) void run(name);
  assert.deepEqual(seen.warnings, Array(4).fill("Open a plan first."));
});

test("a plan with errors does not run, and its first error is shown", async () => {
  const provider = seen.providers.get("afp");
  const config = provider.resolveDebugConfiguration(undefined, {});
  assert.equal(config.program, file);
  assert.equal(await provider.resolveDebugConfigurationWithSubstitutedVariables(undefined, config), config);
  seen.diagnostics.push({ severity: 1, message: "a warning", range: new Range(0, 0, 0, 1) });
  assert.equal(await provider.resolveDebugConfigurationWithSubstitutedVariables(undefined, config), config);
  seen.diagnostics.push({ severity: 0, message: "no template 'Drive'", range: new Range(4, 14, 4, 19) });
  assert.equal(await provider.resolveDebugConfigurationWithSubstitutedVariables(undefined, config), undefined);
  assert.equal(seen.shown[0]?.options.selection.start.line, 4);
  assert.match(seen.errors[0] ?? "", /an error, so nothing runs: no template 'Drive'/);
});

test("the drawing has a panel, which follows cursor and run and closes the subscription", async () => {
  await run("afp.drawing", lens);
  const panel = seen.panels[0]!;
  assert.equal(seen.panels.length, 1, "one for each document");
  assert.match(panel.html, /default-src 'none'/);
  assert.ok(panel.options.localResourceRoots.every((root) => root.path.endsWith("/dist")));
  await Promise.all(panel.receive({ kind: "ready" }));
  const kinds = (): string[] => panel.posted.map(({ kind }) => kind);
  assert.deepEqual(kinds(), ["drawing"]);
  seen.events.selection.fire({ textEditor: { document: { uri } }, selections: [{ active: { line: 4, character: 11 } }] });
  await there(() => kinds().includes("select"), "selection");
  await Promise.all(panel.receive({ kind: "select", part: { item: "Patrol.back" } }));
  await there(() => seen.shown[0], "place in the text");
  assert.deepEqual([seen.shown[0]!.options.selection.start.line, seen.shown[0]!.options.preserveFocus], [8, true]);
  const session = { type: "afp", configuration: { program: `${file}:Patrol` }, customRequest: async () => {} };
  let text = "plan Patrol {}\r\n";
  seen.documents = [{ uri, getText: () => text }];
  const body = { stack: ["go"], held: false, sources: { [file]: hash("plan Patrol {}\n") } };
  seen.events.custom.fire({ session, event: "afp/state", body });
  assert.deepEqual(panel.posted.at(-1), { kind: "run", plan: "Patrol", stack: ["go"], held: false, older: false });
  text = "plan Patrol {} // now\r\n";
  seen.events.text.fire({});
  assert.deepEqual(panel.posted.at(-1), { kind: "run", plan: "Patrol", stack: ["go"], held: false, older: true });
  seen.events.ended.fire(session);
  assert.deepEqual(panel.posted.at(-1), { kind: "run", plan: "Patrol", stack: [], held: false, older: false });
  panel.close();
  const before = panel.posted.length;
  seen.events.custom.fire({ session, event: "afp/state", body });
  assert.equal(panel.posted.length, before);
});

test("a run is asked for its current element", () => {
  const asked: unknown[] = [];
  const customRequest = async (...args: unknown[]): Promise<void> => void asked.push(args);
  seen.events.started.fire({ type: "afp", customRequest });
  seen.events.started.fire({ type: "node", customRequest });
  assert.deepEqual(asked, [["afp/subscribe", { state: true }]]);
});

test("the drawing is saved as a picture", async () => {
  [seen.pick, seen.save] = ["SVG", Uri.file(join(folder, "plan.svg"))];
  await run("afp.graph");
  assert.match(seen.written.get(join(folder, "plan.svg")) ?? "", /^<svg/);
  [seen.pick, seen.save] = ["PNG", Uri.file(join(folder, "plan.png"))];
  await run("afp.graph");
  assert.match(seen.written.get(join(folder, "plan.png")) ?? "", /^.PNG\r\n/s);
});
