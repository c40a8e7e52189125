// Texts, against a test server: sent changes give the same texts, and edits apply only to their
// version.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { inOrder } from "../page/documents/changes";
import { conflicts } from "../page/documents/conflicts";
import { again, begin, create, current, onText, open, saved, text, typed, unsent, version } from "../page/documents/documents";
import { apply, change, Stale } from "../page/documents/edits";
import { undo, undoLabel } from "../page/documents/history";
import { Refused, type Finish, type Lsp } from "../page/server/lsp";
import { offset, position } from "../page/documents/positions";
import * as session from "../page/server/session";
import { random } from "./random";
import { signal } from "@preact/signals";

/** A room that keeps texts as in the protocol. */
class Room {
  texts = new Map<string, string>();
  versions = new Map<string, number>();
  /** The choice in a conflict, and the resulting text. */
  chosen: unknown;
  chooses = "";
  takers = new Map<string, (params: any) => void>();
  lsp: Lsp = {
    open: signal(true),
    on: (method, take) => (this.takers.set(method, take), () => {}),
    request: async (method, params: any) => {
      if (method === "afp/read") return { uri: params.uri, text: this.texts.get(params.uri) ?? "", version: 1, etag: null } as any;
      if (method === "afp/choose") {
        this.chosen = params;
        this.changes(params.uri, this.chooses);
        return null as any;
      }
      if (method === "afp/create") {
        if (this.refuses) throw new Refused(-32803, "not now");
        if (this.texts.has(params.uri)) queueMicrotask(() => this.changes(params.uri, params.text));
        return { uri: params.uri, text: params.text, version: 0, etag: "1" } as any;
      }
      if (method === "afp/pen") return { holder: 1, yours: true } as any;
      throw new Error(method);
    },
    notify: (method, params: any) => {
      const { uri, version } = params.textDocument;
      this.versions.set(uri, version);
      this.last = params.contentChanges;
      if (method === "textDocument/didOpen") this.texts.set(uri, params.textDocument.text);
      for (const { range, text } of params.contentChanges ?? []) {
        const now = this.texts.get(uri)!;
        this.texts.set(uri, range ? now.slice(0, offset(now, range.start)) + text + now.slice(offset(now, range.end)) : text);
      }
    },
  };
  /** Whether it rejects new files. */
  refuses = false;
  /** The last received changes. */
  last: unknown;
  tell = (method: string, params: unknown) => this.takers.get(method)!(params);
  /** Sends a text that differs from the page's last one. */
  changes = (uri: string, text: string) => this.tell("afp/changed", { uri, text, clean: true, version: this.versions.get(uri), number: ++this.told });
  told = 0;
}

let room: Room;
let answers: string[] = [];
let number = 0;
const fresh = () => `file:///w/${++number}.afp`;

beforeEach(() => {
  room = new Room();
  answers = [];
  session.begin("", async () => {}, () => room.lsp);
  begin(async () => answers.shift() ?? null);
});

test("random typing, edits and undo: the server has the page's text", async () => {
  const below = random(7);
  const uri = fresh();
  room.texts.set(uri, "use carbot\n\nplan P {\n}\n");
  await open(uri);
  const first = text(uri);
  for (let step = 0; step < 200; step++) {
    const from = below(text(uri).length + 1);
    const to = Math.min(text(uri).length, from + below(4));
    const insert = ["", "a", "\n", "ö😀", "}\n"][below(5)]!;
    if (below(4) === 0) await undo();
    else if (below(2)) typed([{ uri, from, to, insert }]);
    else {
      const range = { start: position(text(uri), from), end: position(text(uri), to) };
      await apply({ documentChanges: [{ textDocument: { uri, version: version(uri) }, edits: [{ range, newText: insert }] }] }, "edit");
    }
    assert.equal(room.texts.get(uri), text(uri));
    assert.equal(room.versions.get(uri), version(uri));
  }
  while (undoLabel.value) await undo();
  assert.equal(text(uri), first);
  assert.equal(room.texts.get(uri), first);
});

test("edits of a text are applied from its end, and at one place in their order", () => {
  const at = (line: number, character: number) => ({ line, character });
  const edits = [
    { range: { start: at(0, 1), end: at(0, 1) }, newText: "1" },
    { range: { start: at(0, 1), end: at(0, 1) }, newText: "2" },
    { range: { start: at(0, 0), end: at(0, 1) }, newText: "" },
    { range: { start: at(1, 0), end: at(1, 1) }, newText: "B" },
  ];
  const result = inOrder("u", "ab\nbc", edits).reduce((now, { from, to, insert }) => now.slice(0, from) + insert + now.slice(to), "ab\nbc");
  assert.equal(result, "12b\nBc");
});

test("an edit for an older text is requested again and never applied", async () => {
  const uri = fresh();
  room.texts.set(uri, "ab");
  await open(uri);
  const at = { line: 0, character: 2 };
  const edit = (own: number) => ({ documentChanges: [{ textDocument: { uri, version: own }, edits: [{ range: { start: at, end: at }, newText: "!" }] }] });
  const old = version(uri);
  typed([{ uri, from: 0, to: 0, insert: "x" }]);
  await assert.rejects(apply(edit(old), "late"), Stale);
  assert.equal(text(uri), "xab");
  const asked: number[] = [];
  await change(async () => {
    asked.push(version(uri));
    return { edit: edit(asked.length === 1 ? old : version(uri)), label: "again" };
  });
  assert.equal(asked.length, 2);
  assert.equal(text(uri), "xa!b");
});

test("an edit that is always too old is reported and does not count", async () => {
  const uri = fresh();
  await open(uri);
  const edit = { documentChanges: [{ textDocument: { uri, version: -1 }, edits: [] }] };
  let asked = 0;
  await assert.rejects(change(async () => ((asked += 1), { edit, label: "add 'go'" })), /add 'go'\. Try again/);
  assert.equal(asked, 4);
});

test("lines end only with \\n, for every source of a text", async () => {
  const uri = fresh();
  await open(uri);
  typed([{ uri, from: 0, to: 0, insert: "a\r\nb\rc" }]);
  assert.equal(text(uri), "a\nb\nc");
  assert.equal(room.texts.get(uri), text(uri));
});

test("text typed while the page connects to a new server is sent, for every open file", async () => {
  const [one, two] = [fresh(), fresh()];
  for (const uri of [one, two]) room.texts.set(uri, "// ");
  for (const uri of [one, two]) await open(uri);
  const type = (insert: string): void => [one, two].forEach((uri) => typed([{ uri, from: 3, to: 3, insert }]));
  room.lsp.open.value = false;
  const { notify, request } = room.lsp;
  // Without a connection nothing is sent; then it reconnects and greets.
  room.lsp.notify = () => {};
  type("a");
  const first: Lsp = { ...room.lsp, notify, request: async (method, params: any) => (type("b"), request(method, params)) };
  const finish = await again(first);
  type("c");
  finish!();
  [room.lsp.notify, room.lsp.open.value] = [notify, true];
  type("d");
  for (const uri of [one, two]) {
    assert.equal(text(uri), "// dcbba");
    assert.equal(room.texts.get(uri), text(uri));
    assert.equal(room.versions.get(uri), version(uri));
    assert.deepEqual(conflicts.value, []);
  }
});

test("a text that a new server cannot read is not saved, and other texts continue", async () => {
  const [one, two] = [fresh(), fresh()];
  for (const uri of [one, two]) await open(uri);
  const request: Lsp["request"] = async (method, params: any) => {
    if (params.uri === one) throw new Refused(-32803, "cannot read it");
    return room.lsp.request(method, params);
  };
  (await again({ ...room.lsp, request }))!();
  assert.equal(saved.value, "cannot read it");
  typed([{ uri: two, from: 0, to: 0, insert: "a" }]);
  assert.equal(room.texts.get(two), "a");
});

test("a change that would make a text too long is refused, also for undo, without a loss", async () => {
  const uri = fresh();
  room.texts.set(uri, "ö".repeat(10));
  await open(uri);
  session.hello.value = { longest: 24 } as session.Hello;
  try {
    const put = (insert: string): void => typed([{ uri, from: 0, to: 0, insert }]);
    assert.throws(() => put("abcdef"), /at most .* MiB/);
    assert.deepEqual([text(uri), room.texts.get(uri), undoLabel.value], ["ö".repeat(10), "ö".repeat(10), null]);
    put("abcd");
    typed([{ uri, from: 0, to: 4, insert: "" }]);
    // A text by another program may exceed the limit, and may become shorter.
    room.changes(uri, `${"ö".repeat(10)}123456`);
    typed([{ uri, from: 15, to: 16, insert: "" }]);
    assert.equal(text(uri), `${"ö".repeat(10)}12345`);
    const label = undoLabel.value;
    await assert.rejects(undo(), /can have at most/);
    assert.deepEqual([undoLabel.value, text(uri)], [label, `${"ö".repeat(10)}12345`]);
    assert.equal(room.texts.get(uri), text(uri));
  } finally {
    session.hello.value = null;
  }
});

test("after very many changes the whole text is sent", async () => {
  const uri = fresh();
  room.texts.set(uri, "a".repeat(5000));
  await open(uri);
  typed(Array.from({ length: 5000 }, (_, at) => ({ uri, from: at, to: at + 1, insert: "b" })));
  assert.deepEqual(room.last, [{ text: "b".repeat(5000) }]);
  assert.equal(room.texts.get(uri), text(uri));
});

test("a text is saved if the server confirms its newest version", async () => {
  const uri = fresh();
  await open(uri);
  assert.equal(saved.value, "saved");
  typed([{ uri, from: 0, to: 0, insert: "a" }]);
  typed([{ uri, from: 1, to: 1, insert: "b" }]);
  assert.equal(saved.value, "saving");
  room.tell("afp/saved", { uri, version: version(uri) - 1, etag: "1" });
  assert.equal(saved.value, "saving");
  room.tell("afp/saved", { uri, version: version(uri), failed: "the disk is full" });
  assert.equal(saved.value, "the disk is full");
  room.tell("afp/saved", { uri, version: version(uri), etag: "2" });
  assert.equal(saved.value, "saved");
});

test("a change of another program arrives, and undoing it asks", async () => {
  const uri = fresh();
  room.texts.set(uri, "one\ntwo\n");
  await open(uri);
  current.value = uri;
  const heard: string[] = [];
  const quiet = onText((_, changes, maker) => heard.push(`${maker} ${JSON.stringify(changes.map(({ from, to, insert }) => [from, to, insert]))}`));
  room.changes(uri, "one\n2\ntwo\n");
  quiet();
  assert.deepEqual(heard, ['outside [[4,4,"2\\n"]]']);
  assert.equal(room.texts.get(uri), text(uri));
  assert.equal(saved.value, "saved");
  await undo();
  assert.equal(text(uri), "one\n2\ntwo\n");
  answers = ["Undo it"];
  await undo();
  assert.equal(text(uri), "one\ntwo\n");
});

test("a file that is created again under the address of an open text has its own text", async () => {
  const uri = fresh();
  room.texts.set(uri, "plan Old { }\n");
  await open(uri);
  room.refuses = true;
  await assert.rejects(create({ uri, text: "x" }), /not now/);
  room.refuses = false;
  await create({ uri, text: "plan New { go }\n" });
  await new Promise((done) => setTimeout(done));
  assert.equal(text(uri), "plan New { go }\n");
  typed([{ uri, from: 0, to: 0, insert: "a" }]);
  assert.equal(room.texts.get(uri), "aplan New { go }\n");
  assert.equal(room.versions.get(uri), version(uri));
  // The change was made in this page, so undo does not ask.
  await undo();
  assert.match(undoLabel.value!, /^new file /);
  await undo();
  assert.equal(room.texts.get(uri), "plan Old { }\n");
});

test("conflicting changes need a choice, which the room applies", async () => {
  for (const [keep, stays] of [["mine", "mine"], ["theirs", "theirs"], ["both", "mine theirs"]] as const) {
    const uri = fresh();
    room.texts.set(uri, "one");
    await open(uri);
    typed([{ uri, from: 0, to: 3, insert: "mine" }]);
    room.tell("afp/changed", { uri, text: "theirs", clean: false });
    assert.equal(text(uri), "mine");
    assert.equal(saved.value, "disputed");
    const [conflict] = conflicts.value.filter((each) => each.uri === uri);
    room.chooses = stays;
    await conflict!.choose(keep);
    assert.deepEqual(room.chosen, { uri, keep });
    assert.equal(text(uri), stays);
    assert.equal(room.texts.get(uri), stays);
    assert.equal(conflicts.value.length, 0);
    room.tell("afp/saved", { uri, version: version(uri) });
    assert.equal(saved.value, "saved");
    // The choice was made in this page, so undo does not ask.
    await undo();
    assert.equal(text(uri), keep === "mine" ? "one" : "mine");
    room.tell("afp/saved", { uri, version: version(uri) });
  }
});

test("after a lost connection unsent changes are sent, and changes of others are received", async () => {
  const cases = [
    // the page's text, the room's text, the holder of the edit lock, the final text of both,
    // whether there is a conflict
    ["base", "base", "page", "base", false],
    ["mine", "base", "page", "mine", false],
    ["mine", "mine", "page", "mine", false],
    ["base", "theirs", "page", "theirs", false],
    ["mine", "theirs", "page", "theirs", true],
    ["base", "theirs", "other", "theirs", false],
    ["mine", "base", "other", "base", true],
    ["mine", "mine", "other", "mine", false],
    ["mine", "theirs", "other", "theirs", true],
  ] as const;
  for (const [mine, theirs, holder, last, choice] of cases) {
    const uri = fresh();
    room.texts.set(uri, "base");
    begin(async () => null);
    await open(uri);
    room.lsp.open.value = false;
    const kept = room.lsp.notify;
    room.lsp.notify = () => {};
    if (mine !== "base") typed([{ uri, from: 0, to: 4, insert: mine }]);
    room.texts.set(uri, theirs);
    room.lsp.notify = kept;
    room.lsp.open.value = true;
    session.pen.value = holder === "page";
    (await again(room.lsp))!();
    assert.equal(text(uri), last, `${mine} ${theirs} ${holder}`);
    assert.deepEqual(unsent.value.filter((one) => one.uri === uri && one.text === mine), choice || (mine !== theirs && mine === last) ? [{ uri, text: mine }] : []);
    assert.equal(room.texts.get(uri), last);
    assert.equal(room.versions.get(uri), version(uri));
    const conflict = conflicts.value.find((each) => each.uri === uri);
    assert.equal(conflict !== undefined, choice);
    if (conflict) {
      await conflict.choose("mine");
      assert.equal(session.pen.value, true);
      assert.equal(text(uri), "mine");
      assert.equal(room.texts.get(uri), "mine");
      assert.notEqual(undoLabel.value, null);
    }
  }
  session.pen.value = true;
});

test("messages of the server during the connection are newer than its first answer", async () => {
  let greeted: Promise<Finish> | null = null;
  const takers = new Map<string, (params: any) => void>();
  const one = { uri: "file:///w/a.afp", name: "a.afp" };
  const two = { uri: "file:///w/b.afp", name: "b.afp" };
  const lsp: Lsp = {
    open: signal(true),
    on: (method, take) => (takers.set(method, take), () => {}),
    request: async (method: string): Promise<any> => {
      if (method === "afp/hello") return { client: 1, root: "file:///w", open: null, pen: true, files: [one], examples: [] };
      await null;
      takers.get("afp/files")!({ files: [one, two] });
      return { capabilities: {} };
    },
    notify: () => {},
  };
  session.begin("", async () => {}, (_, greet) => {
    queueMicrotask(() => (greeted = greet!(lsp)));
    return lsp;
  });
  await Promise.resolve();
  await greeted;
  assert.deepEqual(session.files.value.map(({ name }) => name), ["a.afp", "b.afp"]);
});
