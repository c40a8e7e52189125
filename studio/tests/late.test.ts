// Marks of an older text appear at their current positions, even if the user types faster than the
// server answers.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ChangeSet, Text } from "@codemirror/state";
import { Late } from "../page/text/late";

test("a place in an older version is mapped to the new version; in an unknown version it is lost", () => {
  let doc = Text.of(["plan P {", "}"]);
  const late = new Late(4, doc);
  const insert = (version: number, from: number, text: string): void => {
    const changes = ChangeSet.of({ from, insert: text }, doc.length);
    doc = changes.apply(doc);
    late.note(version, doc, changes);
  };
  insert(5, 8, " /");
  insert(6, 10, "/");
  insert(7, 0, "\n");
  assert.equal(late.at(5)!.text, "plan P { /\n}");
  assert.equal(late.at(5)!.now(9), 10);
  assert.equal(late.at(4)!.now(7), 8);
  assert.equal(late.at(null)!.now(3), 3);
  // A version without changes has the text of the previous one.
  assert.equal(late.at(8)!.text, doc.toString());
  assert.equal(late.at(3), null);
});
