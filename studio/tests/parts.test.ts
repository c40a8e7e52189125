// Units without a page: positions, Markdown, names of keys, commands, the socket.
import assert from "node:assert/strict";
import { test } from "node:test";
import { command, commandFor, commands, isForField, keyName } from "../page/screen/commands";
import { matching } from "../page/screen/ranking";
import { connect, type Socket } from "../page/server/lsp";
import { blocks } from "../page/screen/markdown";
import { offset, position } from "../page/documents/positions";

test("positions and offsets convert in both directions", () => {
  const text = "a\n\nö😀x\nlast";
  for (let at = 0; at <= text.length; at++) assert.equal(offset(text, position(text, at)), at);
  assert.deepEqual(position(text, text.length), { line: 3, character: 4 });
  assert.equal(offset(text, { line: 0, character: 99 }), 1);
  assert.equal(offset(text, { line: 99, character: 0 }), text.length);
});

test("Markdown becomes blocks; other markup stays text", () => {
  assert.deepEqual(blocks("```afp\nactor A\n```\n\nDrives `x` and **y**, *z*.\nOn.\n\n- `in a`: one\n  more\n- two"), [
    { kind: "code", text: "actor A" },
    {
      kind: "paragraph",
      inlines: [
        { kind: "text", text: "Drives " }, { kind: "code", text: "x" }, { kind: "text", text: " and " }, { kind: "strong", text: "y" },
        { kind: "text", text: ", " }, { kind: "em", text: "z" }, { kind: "text", text: ".\nOn." },
      ],
    },
    { kind: "list", items: [[{ kind: "code", text: "in a" }, { kind: "text", text: ": one more" }], [{ kind: "text", text: "two" }]] },
  ]);
  assert.deepEqual(blocks("<img src=x onerror=alert(1)> [go](javascript:alert)"), [
    { kind: "paragraph", inlines: [{ kind: "text", text: "<img src=x onerror=alert(1)> " }, { kind: "text", text: "go" }] },
  ]);
  assert.deepEqual(blocks("```\nopen"), [{ kind: "code", text: "open" }]);
  assert.deepEqual(blocks(""), []);
});

const pressed = (key: string, ...held: string[]) => ({ key, ctrlKey: held.includes("c"), metaKey: held.includes("m"), altKey: held.includes("a"), shiftKey: held.includes("s") });

test("keys have one name each", () => {
  for (const [name, event] of [
    ["Ctrl+Z", pressed("z", "c")], ["Ctrl+Shift+Z", pressed("Z", "c", "s")], ["?", pressed("?", "s")], ["+", pressed("+", "s")], ["A", pressed("a")], ["Shift+F6", pressed("F6", "s")],
    ["Shift+Left", pressed("ArrowLeft", "s")], ["Space", pressed(" ")], ["Ctrl+.", pressed(".", "c")], ["Alt+1", pressed("1", "a")],
  ] as const) assert.equal(keyName(event), name);
  assert.equal(keyName(pressed("z", "m"), true), "Ctrl+Z");
  assert.equal(keyName(pressed("z", "c"), true), "Z");
  for (const key of ["A", "Ctrl+Z", "Ctrl+A", "Delete"]) assert.ok(isForField(key), key);
  for (const key of ["F6", "Ctrl+K", "Ctrl+."]) assert.ok(!isForField(key), key);
});

test("letters are shortcuts only in the drawing; a new command replaces a command of the same name", () => {
  const ran: string[] = [];
  commands.value = [];
  command({ id: "a", label: "Add an element", key: "A", where: "drawing", run: () => ran.push("a") });
  command({ id: "f", label: "Rename in the text", key: "F2", run: () => ran.push("f") });
  command({ id: "g", label: "Rename the element", key: "F2", where: "drawing", run: () => ran.push("g") });
  assert.equal(commandFor("A", false), undefined);
  for (const [key, inside] of [["A", true], ["F2", false], ["F2", true]] as const) commandFor(key, inside)!.run();
  const away = command({ id: "a", label: "Add, anew", key: "A", where: "drawing", enabled: () => false, run: () => ran.push("new") });
  assert.equal(commandFor("A", true), undefined);
  away();
  assert.deepEqual(ran, ["a", "f", "g"]);
  assert.deepEqual(matching("ren el", commands.value).map((each) => each.id), ["g"]);
  assert.deepEqual(matching("", commands.value).length, 2);
});

/** Sockets of a server that answers on request. */
class Server {
  sockets: (Socket & { sent: any[] })[] = [];
  make = (): Socket => {
    const socket = { sent: [] as any[], send: (text: string) => void socket.sent.push(JSON.parse(text)), close: () => socket.onclose?.({}), onopen: null, onclose: null, onmessage: null } as any;
    this.sockets.push(socket);
    return socket;
  };
  last = () => this.sockets.at(-1)!;
  say = (message: object) => this.last().onmessage!({ data: JSON.stringify({ jsonrpc: "2.0", ...message }) });
}

const soon = () => new Promise((done) => setTimeout(done));

test("the first request goes first, others wait; errors are sentences; a lost connection is restored", { timeout: 5000 }, async () => {
  const server = new Server();
  const lsp = connect("ws://x/lsp", async (first) => void (await first.request("afp/hello", {})), server.make);
  const early = lsp.request<number>("early", { a: 1 });
  server.last().onopen!({});
  assert.deepEqual(server.last().sent.map((each) => each.method), ["afp/hello"]);
  server.say({ id: server.last().sent[0].id, result: {} });
  await soon();
  assert.equal(lsp.open.value, true);
  assert.deepEqual(server.last().sent.map((each) => each.method), ["afp/hello", "early"]);
  server.say({ id: server.last().sent[1].id, result: 42 });
  assert.equal(await early, 42);

  const heard: unknown[] = [];
  const quiet = lsp.on("afp/saved", (params) => heard.push(params));
  server.say({ method: "afp/saved", params: { version: 2 } });
  quiet();
  server.say({ method: "afp/saved", params: { version: 3 } });
  assert.deepEqual(heard, [{ version: 2 }]);
  server.say({ method: "workspace/semanticTokens/refresh", id: 9, params: null });
  assert.deepEqual(server.last().sent.at(-1), { jsonrpc: "2.0", id: 9, result: null });

  const refused = lsp.request("afp/edit", {});
  server.say({ id: server.last().sent.at(-1).id, error: { code: -32803, message: "there is no entry 'x'" } });
  await assert.rejects(refused, { code: -32803, message: "there is no entry 'x'" });

  const lost = lsp.request("lost", {});
  server.last().onclose!({});
  assert.equal(lsp.open.value, false);
  await assert.rejects(lost, /connection/);
  const later = lsp.request<number>("later", {});
  while (server.sockets.length < 2) await new Promise((done) => setTimeout(done, 20));
  server.last().onopen!({});
  server.say({ id: server.last().sent[0].id, result: {} });
  await soon();
  assert.equal(server.last().sent[1].method, "later");
  server.say({ id: server.last().sent[1].id, result: 1 });
  assert.equal(await later, 1);
});
