// Unsent texts: stored per page, offered once, never if equal to the file.
import assert from "node:assert/strict";
import { test } from "node:test";
import { claim, keep, kept } from "../page/documents/unsent";

function storage() {
  const all = new Map<string, string>();
  return {
    all,
    get length() {
      return all.size;
    },
    key: (at: number) => [...all.keys()][at] ?? null,
    getItem: (key: string) => all.get(key) ?? null,
    setItem: (key: string, value: string) => void all.set(key, value),
    removeItem: (key: string) => void all.delete(key),
  };
}

const one = (name: string): string => `afp-studio-unsent-${name}`;

test("the newest text of a file is offered once", () => {
  const here = storage();
  here.setItem("afp-studio-history", "{}");
  here.setItem(one("broken"), "{");
  keep(here, one("a"), { at: 1, texts: [{ uri: "u", text: "old" }, { uri: "v", text: "other" }] });
  keep(here, one("b"), { at: 2, texts: [{ uri: "u", text: "new" }] });
  assert.deepEqual(kept(here).map(([key]) => key), [one("b"), one("a")]);
  assert.equal(claim(here, "u", "in the file"), "new");
  assert.equal(claim(here, "u", "in the file"), "old");
  assert.equal(claim(here, "u", "in the file"), null);
  assert.equal(claim(here, "v", "other"), null, "the file has it");
  assert.deepEqual(kept(here), []);
});

test("a file with an open question keeps the question's text and newly typed text", () => {
  const here = storage();
  keep(here, one("a"), { at: 1, texts: [{ uri: "u", text: "asked" }, { uri: "u", text: "typed" }] });
  assert.equal(claim(here, "u", ""), "typed");
  assert.equal(claim(here, "u", ""), "asked");
});
