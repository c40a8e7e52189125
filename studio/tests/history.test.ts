// The history: undo of any sequence restores the first texts, redo the last ones.
import assert from "node:assert/strict";
import { test } from "node:test";
import { attach, backward, clear, EMPTY, forward, push, record, recorded, redo, redoLabel, undo, undoLabel, type Change, type Entry, type Step } from "../page/documents/history";
import { newest } from "../page/documents/keep";
import { random } from "./random";

/** Texts that are changed like in `documents.ts`. */
class Texts {
  all = new Map([["a", "plan A {\n}\n"], ["b", ""]]);
  make = (changes: Change[]): Step[] =>
    changes.map(({ uri, from, to, insert }) => {
      const text = this.all.get(uri)!;
      this.all.set(uri, text.slice(0, from) + insert + text.slice(to));
      return { uri, from, removed: text.slice(from, to), inserted: insert };
    });
  shown = () => JSON.stringify([...this.all]);
}

const begin = (agrees = true) => {
  const texts = new Texts();
  const asked: string[] = [];
  attach({ make: texts.make, select: () => {}, agree: async (label) => (asked.push(label), agrees) });
  return { texts, asked };
};

for (let seed = 1; seed <= 40; seed++) {
  test(`undoing everything restores the first texts (seed ${seed})`, async () => {
    const below = random(seed);
    const { texts } = begin();
    const states = [texts.shown()];
    for (let entry = 0; entry < 60; entry++) {
      const changes: Change[] = [];
      const lengths = new Map([...texts.all].map(([uri, text]) => [uri, text.length]));
      for (let change = 0; change <= below(3); change++) {
        const uri = "ab"[below(2)]!;
        const from = below(lengths.get(uri)! + 1);
        const to = from + below(lengths.get(uri)! - from + 1);
        const insert = "xy\n{}".slice(0, below(6));
        changes.push({ uri, from, to, insert });
        lengths.set(uri, lengths.get(uri)! - (to - from) + insert.length);
      }
      push({ label: `entry ${entry}`, changes });
      states.push(texts.shown());
    }
    const back = [...states].reverse();
    for (const state of back.slice(1)) {
      await undo();
      assert.equal(texts.shown(), state);
    }
    assert.equal(undoLabel.value, null);
    for (const state of states.slice(1)) {
      await redo();
      assert.equal(texts.shown(), state);
    }
    assert.equal(redoLabel.value, null);
  });
}

test("a new entry forgets what was undone", async () => {
  const { texts } = begin();
  push({ label: "one", changes: [{ uri: "b", from: 0, to: 0, insert: "1" }] });
  await undo();
  assert.equal(redoLabel.value, "one");
  push({ label: "two", changes: [{ uri: "b", from: 0, to: 0, insert: "2" }] });
  assert.equal(redoLabel.value, null);
  assert.equal(texts.all.get("b"), "2");
  clear();
  assert.equal(undoLabel.value, null);
});

const typed = (from: number, removed: string, inserted: string, at: number, uri = "b"): Entry => ({ label: "typing", steps: [{ uri, from, removed, inserted }], typed: at });

test("typing makes one entry until a pause, a move or a new line", () => {
  const count = (...entries: Entry[]) => entries.reduce(recorded, EMPTY).past.length;
  assert.equal(count(typed(0, "", "a", 0), typed(1, "", "b", 300), typed(2, "", "c", 900)), 1);
  assert.equal(count(typed(0, "", "a", 0), typed(1, "", "b", 800)), 2);
  assert.equal(count(typed(0, "", "a", 0), typed(5, "", "b", 100)), 2);
  assert.equal(count(typed(0, "", "a", 0), typed(1, "", "b", 100, "a")), 2);
  assert.equal(count(typed(0, "", "a", 0), typed(1, "", "\n", 100), typed(2, "", "b", 200)), 3);
  assert.equal(count(typed(0, "", "ab", 0), typed(1, "b", "", 100)), 1);
});

test("joined typing is undone in one step", () => {
  const log = [typed(0, "", "ab", 0), typed(1, "b", "", 100), typed(1, "", "c", 200)].reduce(recorded, EMPTY);
  const steps = log.past[0]!.steps;
  const run = (text: string, changes: Change[]) => changes.reduce((now, { from, to, insert }) => now.slice(0, from) + insert + now.slice(to), text);
  assert.equal(run("!", forward(steps)), "ac!");
  assert.equal(run("ac!", backward(steps)), "!");
});

test("undoing a change of others asks first", async () => {
  for (const agrees of [true, false]) {
    const { texts, asked } = begin(agrees);
    const steps = texts.make([{ uri: "b", from: 0, to: 0, insert: "theirs" }]);
    record({ label: "another program", steps, foreign: true });
    await undo();
    assert.deepEqual(asked, ["another program"]);
    assert.equal(texts.all.get("b"), agrees ? "" : "theirs");
  }
});

test("a long history keeps its newest entries", () => {
  const entries = Array.from({ length: 9 }, (_, at) => typed(at, "", "x", at * 1000));
  const size = JSON.stringify(entries[0]).length;
  assert.deepEqual(newest(entries, 4 * JSON.stringify(entries[8]).length).length, 4);
  assert.deepEqual(newest(entries, 4 * size + 99).at(-1), entries[8]);
  assert.deepEqual(newest(entries, 0), []);
});
