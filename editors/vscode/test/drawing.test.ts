// Tests the drawing with the real server: its requests, its messages to the page, its moves of the
// cursor.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Range } from "../../../studio/page/documents/positions";
import { Drawing, type ToPage } from "../src/drawing";
import { PLAN, serving, there, type Talk } from "./server";

interface Seen {
  drawing: Drawing;
  posted: ToPage[];
  revealed: { range: Range; focus: boolean }[];
}

function drawn(talk: Talk, plan: string | null = null): Seen {
  const seen: Omit<Seen, "drawing"> = { posted: [], revealed: [] };
  const drawing = new Drawing(talk.uri, plan, {
    server: talk,
    post: (message) => seen.posted.push(message),
    reveal: (range, focus) => seen.revealed.push({ range, focus }),
  });
  talk.onChange((change) => drawing.changed(change));
  return { ...seen, drawing };
}

const of = <K extends ToPage["kind"]>(seen: Seen, kind: K): Extract<ToPage, { kind: K }>[] => seen.posted.filter((message) => message.kind === kind) as Extract<ToPage, { kind: K }>[];

test("requests wait for the page, then get the whole drawing, then changes", () =>
  serving(async (talk) => {
    const seen = drawn(talk);
    await seen.drawing.ask();
    assert.deepEqual(seen.posted, []);
    await seen.drawing.receive({ kind: "ready" });
    const [whole] = of(seen, "drawing");
    assert.deepEqual(whole?.answer.elements.map(({ item }) => item), ["Patrol.back", "Patrol.go", "Patrol.start"]);
    // An edit of a plan without positions may change the layout; this one moves nothing.
    await talk.type(PLAN.replace("-30 cm", "-40 cm"));
    const { change } = await there(() => of(seen, "changed")[0], "change");
    assert.ok(change.elements.some(({ item }) => item === "Patrol.back"));
    assert.ok(!change.elements.some(({ item }) => item === "Patrol.go"), "unchanged parts are not sent again");
    const other = { ...change, textDocument: { uri: "file:///other.afp" } };
    seen.drawing.changed(other);
    assert.equal(of(seen, "changed").length, 1, "changes of other documents are theirs");
    await seen.drawing.end();
    await talk.type(PLAN);
    await talk.request("afp/itemAt", { textDocument: { uri: talk.uri }, position: { line: 0, character: 0 } });
    assert.equal(of(seen, "changed").length, 1, "a closed drawing receives nothing");
  }));

test("a click selects in the text, and the cursor selects in the drawing", () =>
  serving(async (talk) => {
    const seen = drawn(talk);
    await seen.drawing.receive({ kind: "ready" });
    await seen.drawing.receive({ kind: "select", part: { item: "Patrol.back" } });
    const [{ range, focus }] = seen.revealed as [Seen["revealed"][0]];
    assert.deepEqual([range.start.line, focus], [8, false]);
    await seen.drawing.cursor(range.start);
    assert.deepEqual(of(seen, "select"), [], "the cursor that was sent there says nothing new");
    await seen.drawing.cursor({ line: 5, character: 21 });
    assert.equal(of(seen, "select")[0]?.part?.item, "Patrol.go.touch");
    await seen.drawing.cursor(range.start);
    assert.equal(of(seen, "select")[1]?.part?.item, "Patrol.back", "and later it may go there by itself");
    await seen.drawing.receive({ kind: "open", part: { item: "Patrol.go", part: { kind: "exit", name: "ForwardSuccessful" } } });
    assert.deepEqual([seen.revealed[1]?.range.start.line, seen.revealed[1]?.focus], [6, true]);
  }));

test("a renamed plan stays visible and is requested by its new name", () => {
  const text = (name: string): string => `${PLAN}\nplan ${name} { start go actor go: Turn { TurnSuccessful -> go } }\n`;
  return serving(async (talk) => {
    const seen = drawn(talk, "Other");
    await seen.drawing.receive({ kind: "ready" });
    await talk.type(text("Another"));
    const { change } = await there(() => of(seen, "changed")[0], "change");
    assert.deepEqual([change.plan, change.plans], ["Another", ["Patrol", "Another"]]);
    await seen.drawing.ask();
    assert.equal(of(seen, "drawing")[1]?.answer.plan, "Another");
    await talk.type(PLAN);
    const { change: last } = await there(() => of(seen, "changed")[1], "change");
    assert.equal(last.plan, "Patrol");
  }, text("Other"));
});

test("another plan of the file is shown, and a missing plan is reported", () =>
  serving(async (talk) => {
    const seen = drawn(talk, "Other");
    await seen.drawing.receive({ kind: "ready" });
    assert.equal(of(seen, "drawing")[0]?.answer.plan, "Other");
    await seen.drawing.receive({ kind: "plan", name: "Patrol" });
    assert.equal(of(seen, "drawing")[1]?.answer.plan, "Patrol");
    await seen.drawing.show("Nowhere");
    assert.match(of(seen, "nothing")[0]?.why ?? "", /there is no plan 'Nowhere'/);
  }, `${PLAN}\nplan Other { start go actor go: Turn { TurnSuccessful -> go } }\n`));
