// A run in the drawing: nested plans, supervisors, taken edges.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Socket } from "../page/server/lsp";
import { connect } from "../page/server/dap";
import { at, taken, within } from "../page/debug/follow";
import { differs, hash } from "../page/documents/hash";

test("a text has the debugger's hash for all line endings", () => {
  assert.equal(hash(""), "cbf29ce484222325");
  assert.equal(hash("foobar"), "85944171f73967e8");
  assert.equal(hash("\uFEFFuse std\r\nplan P {}\r\n"), hash("use std\nplan P {}\n"));
  assert.equal(hash("länge → 1"), "4b342ddcb57f390f");
  assert.deepEqual(["a", "b"].map((text) => differs({ "/p.afp": hash("a") }, "/p.afp", text)), [false, true]);
  assert.equal(differs({}, "/p.afp", "a"), false);
});

const outer = { path: "", plan: "Outer" };

test("the active element is found in the outermost plan", () => {
  assert.deepEqual(at([outer], "Outer", ["drive"], ["escape", "drive.touch"]), {
    active: [{ item: "Outer.drive", inside: false }],
    watching: ["Outer.escape", "Outer.drive.touch"],
  });
  assert.deepEqual(at([outer], "Other", ["drive"], ["escape"]), { active: [], watching: [] });
});

test("the active element is found in a sub-plan for any order of the stack", () => {
  const frames = [outer, { path: "work", plan: "Inner" }];
  for (const stack of [["work", "work.second"], ["work.second", "work"]]) {
    const watching = ["limit", "work.late", "work.second.touch"];
    assert.deepEqual(at(frames, "Inner", stack, watching), { active: [{ item: "Inner.second", inside: false }], watching: ["Inner.late", "Inner.second.touch"] });
    assert.deepEqual(at(frames, "Outer", stack, watching), { active: [{ item: "Outer.work", inside: true }], watching: ["Outer.limit"] });
  }
});

test("a sub-plan shows the names of its active elements", () => {
  const frames = [outer, { path: "work", plan: "Inner" }];
  const stack = ["work", "work.second.third", "work.second"];
  assert.equal(within(frames, "Outer", stack, "Outer.work"), "second › third");
  assert.equal(within(frames, "Inner", stack, "Inner.second"), "third");
  assert.equal(within(frames, "Inner", stack, "Inner.other"), "");
});

test("a plan that contains itself shows its innermost instance", () => {
  const frames = [{ path: "", plan: "P" }, { path: "a", plan: "P" }];
  assert.deepEqual(at(frames, "P", ["a", "a.b"], []).active, [{ item: "P.b", inside: false }]);
});

test("the taken edges are the edges of the only possible path", () => {
  const edges = [
    { id: "1", from: "P.a", to: "P.b" },
    { id: "2", from: "P.a.touch", to: "P.c" },
    { id: "3", from: "P.b", to: "P.c" },
    { id: "4", from: "P.b.touch", to: "P.c" },
  ];
  assert.deepEqual(taken(edges, "P.a", "P.b"), ["1"]);
  assert.deepEqual(taken(edges, "P.a", "P.c"), ["2"]);
  assert.deepEqual(taken(edges, "P.b", "P.c"), []);
  assert.deepEqual(taken(edges, null, "P.b"), []);
  assert.deepEqual(taken(edges, "P.b", "P.b"), []);
});

test("a path leads through computations, which take no time", () => {
  const edges = [
    { id: "1", from: "P.a", to: "P.count" },
    { id: "2", from: "P.count", to: "P.b" },
    { id: "3", from: "P.count", to: "P.count" },
    { id: "4", from: "P.b", to: "P.count" },
    { id: "5", from: "P.b.touch", to: "P.count" },
  ];
  const isPassed = (item: string): boolean => item === "P.count";
  assert.deepEqual(taken(edges.filter(({ id }) => id !== "3"), "P.a", "P.b", isPassed), ["1", "2"]);
  // Loops through a computation are ambiguous; from b two exits lead there.
  assert.deepEqual(taken(edges, "P.a", "P.b", isPassed), []);
  assert.deepEqual(taken([...edges.slice(3), { id: "6", from: "P.count", to: "P.a" }], "P.b", "P.a", isPassed), []);
  assert.deepEqual(taken(edges, "P.a", "P.b"), []);
});

test("requests wait for the debugger's socket, refusals are sentences, its end is reported once", async () => {
  const sent: any[] = [];
  const socket: Socket = { send: (text) => void sent.push(JSON.parse(text)), close: () => socket.onclose?.({}), onopen: null, onclose: null, onmessage: null };
  let lost = 0;
  const dap = connect("ws://x/dap", () => (lost += 1), () => socket);
  const say = (message: object) => socket.onmessage!({ data: JSON.stringify(message) });
  const first = dap.request("launch", { program: "a.afp" });
  assert.deepEqual(sent, []);
  socket.onopen!({});
  assert.deepEqual(sent[0], { seq: 1, type: "request", command: "launch", arguments: { program: "a.afp" } });
  say({ type: "response", request_seq: 1, success: true, command: "launch" });
  assert.equal(await first, null);
  const refused = dap.request("pause");
  say({ type: "response", request_seq: 2, success: false, message: "nothing runs yet" });
  await assert.rejects(refused, /nothing runs yet/);
  const heard: unknown[] = [];
  dap.on("afp/state", (body) => heard.push(body));
  say({ type: "event", event: "afp/state", body: { at: 1 } });
  assert.deepEqual(heard, [{ at: 1 }]);
  const late = dap.request("next");
  socket.onclose!({});
  await assert.rejects(late, /connection/);
  await assert.rejects(dap.request("next"), /connection/);
  dap.close();
  assert.equal(lost, 1);
});
