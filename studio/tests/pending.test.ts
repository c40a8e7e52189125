// Two concurrent writers with delayed messages: the final text of both has the changes of each.
import assert from "node:assert/strict";
import { test } from "node:test";
import { signal } from "@preact/signals";
import { difference } from "../page/documents/changes";
import { begin, open, text, typed } from "../page/documents/documents";
import { undo } from "../page/documents/history";
import type { Lsp } from "../page/server/lsp";
import { offset } from "../page/documents/positions";
import * as session from "../page/server/session";
import { random } from "./random";

const URI = "file:///w/two.afp";

/** A room whose messages are delayed in both directions until released. */
class SlowRoom {
  text = "one\ntwo\nthree\nfour\n";
  /** The text known from the page. */
  theirs = this.text;
  seen = 0;
  told = 0;
  taken = 0;
  toRoom: any[] = [];
  toPage: any[] = [];
  takers = new Map<string, (params: any) => void>();
  lsp: Lsp = {
    open: signal(true),
    on: (method, take) => (this.takers.set(method, take), () => {}),
    request: async () => ({ uri: URI, text: this.text, version: 0, etag: null }) as any,
    notify: (method, params) => void (method === "textDocument/didChange" && this.toRoom.push(params)),
  };

  hear(): void {
    const said = this.toRoom.shift();
    if (!said) return;
    for (const { range, text } of said.contentChanges) this.theirs = this.theirs.slice(0, offset(this.theirs, range.start)) + text + this.theirs.slice(offset(this.theirs, range.end));
    this.taken = said.taken ?? this.taken;
    if (this.theirs === this.text) this.taken = this.told;
    if (this.taken < this.told) return;
    [this.seen, this.text] = [said.textDocument.version, this.theirs];
  }

  say(): void {
    const said = this.toPage.shift();
    if (said) this.takers.get("afp/changed")!(said);
  }

  /** A change by another program. */
  outside(from: number, to: number, insert: string): void {
    this.text = this.text.slice(0, from) + insert + this.text.slice(to);
    this.toPage.push({ uri: URI, text: this.text, clean: true, version: this.seen, number: ++this.told });
  }
}

async function begun(): Promise<SlowRoom> {
  const room = new SlowRoom();
  session.begin("", async () => {}, () => room.lsp);
  session.pen.value = true;
  begin(async () => null);
  await open(URI);
  return room;
}

test("unsent letters keep their place around the changes of another program", async () => {
  const room = await begun();
  typed([{ uri: URI, from: 7, to: 7, insert: "A" }]);
  room.hear();
  typed([{ uri: URI, from: 8, to: 8, insert: "B" }]);
  // It writes at both ends, and knows only the first letter.
  room.outside(room.text.length, room.text.length, "five\n");
  room.outside(0, 3, "1");
  room.say();
  typed([{ uri: URI, from: 9, to: 9, insert: "C" }]);
  while (room.toPage.length) room.say();
  while (room.toRoom.length) room.hear();
  assert.equal(text(URI), "1\ntwoABC\nthree\nfour\nfive\n");
  assert.equal(room.text, text(URI));
});

test("after random edits, undo and other writers, both sides have the same text with every letter", async () => {
  for (let seed = 1; seed <= 60; seed++) {
    const below = random(seed);
    const room = await begun();
    const letters: string[] = [];
    const letter = (): string => (letters.push(String.fromCharCode(0xe000 + letters.length)), letters.at(-1)! + (below(4) ? "" : "\n"));
    for (let step = 0; step < 120; step++) {
      const what = below(6);
      if (what < 2) typed([{ uri: URI, from: below(text(URI).length + 1), to: 0, insert: letter() }].map((change) => ({ ...change, to: change.from })));
      else if (what === 2) {
        const at = below(room.text.length + 1);
        room.outside(at, at, letter());
      } else if (what === 3) room.say();
      else room.hear();
    }
    while (room.toPage.length || room.toRoom.length) below(2) ? room.say() : room.hear();
    assert.equal(room.text, text(URI), `seed ${seed}`);
    assert.equal(room.theirs, text(URI));
    for (const one of letters) assert.equal(text(URI).split(one).length, 2, `seed ${seed}`);
  }
});

test("after deletions on both sides, both have the same text", async () => {
  for (let seed = 1; seed <= 60; seed++) {
    const below = random(seed);
    const room = await begun();
    const place = (length: number): [number, number] => {
      const from = below(length + 1);
      return [from, Math.min(length, from + below(5))];
    };
    for (let step = 0; step < 80; step++) {
      const what = below(7);
      const insert = ["", "x", "y\n", "😀", "😁"][below(5)]!;
      if (what < 2) {
        const [from, to] = place(text(URI).length);
        typed([{ uri: URI, from, to, insert }]);
      } else if (what === 2) {
        const [from, to] = place(room.text.length);
        room.outside(from, to, insert);
      } else if (what === 3) room.say();
      else if (what === 4) await undo();
      else room.hear();
    }
    while (room.toPage.length || room.toRoom.length) below(2) ? room.say() : room.hear();
    assert.equal(room.text, text(URI), `seed ${seed}`);
  }
});

const applied = (before: string, after: string): string =>
  difference("u", before, after).reduce((now, { from, to, insert }) => now.slice(0, from) + insert + now.slice(to), before);

test("the difference of two texts converts one into the other and keeps equal lines", () => {
  const below = random(3);
  for (let round = 0; round < 2000; round++) {
    const any = () => Array.from({ length: below(14) }, () => ["a", "b", "\n", "\n", "😀", "😁"][below(6)]).join("");
    const [before, after] = [any(), any()];
    assert.equal(applied(before, after), after);
  }
  const [before, after] = ["one\ntwo\nthree\nfour\n", "1\ntwo\nthree\nfour!\n"];
  assert.deepEqual(difference("u", before, after), [{ uri: "u", from: 18, to: 18, insert: "!" }, { uri: "u", from: 0, to: 3, insert: "1" }]);
  // No half of a surrogate pair is sent.
  assert.deepEqual(difference("u", "a😀b", "a😁b"), [{ uri: "u", from: 1, to: 3, insert: "😁" }]);
  const many = (word: string) => Array.from({ length: 3000 }, (_, line) => `${word}${line}\n`).join("");
  assert.equal(applied(many("a"), many("b")), many("b"));
});
