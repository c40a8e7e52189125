// Undo restores moves, changes in progress and cut items.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { test } from "node:test";
import { attach, log, push, redo, underWay, undo } from "../page/documents/history";
import { inBrowser, settled } from "./browser";
import { middle, name } from "./spots";

const PLAN = `use carbot

plan P {
    in walldist: length = 30 cm

    start drive

    actor turn: Turn(angle = 90 deg) {
        TurnSuccessful -> terminate
    }

    actor drive: Forward(distance = walldist) {
        ForwardSuccessful -> turn
    }
}
`;

/** Positions of element boxes on the page. */
const places = (page: Page, items: readonly string[]) => async (): Promise<string> => {
  const boxes = await Promise.all(items.map((item) => page.locator(`.node [data-item="${item}"]`).first().boundingBox()));
  return JSON.stringify(boxes.map((box) => box && [box.x, box.y].map(Math.round)));
};

inBrowser("the first move writes every position; undo and tidying restore everything", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await page.locator('.node [data-item="P.drive"]').first().waitFor();
  const at = places(page, ["P.drive", "P.turn"]);
  const first = await at();
  const move = async (): Promise<void> => {
    const [x, y] = await middle(page, name("P.drive"));
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 60, y + 100);
    await page.mouse.move(x - 130, y + 200);
    await page.mouse.up();
    await studio.becomes("plan.afp.layout", /^P\.drive -?\d+ \d+\nP\.start -?\d+ -?\d+\nP\.turn -?\d+ \d+\n$/);
    assert.notEqual(await settled(at, (now) => now !== first), first);
  };
  const isBack = async (): Promise<void> => assert.equal(await settled(at, (now) => now === first), first);
  await move();
  await page.keyboard.press("Control+z");
  await isBack();
  await studio.holds("plan.afp.layout", "");
  await move();
  await page.keyboard.press("Control+Shift+l");
  await isBack();
  await studio.becomes("plan.afp.layout", /^P\.start -?\d+ -?\d+\nP\.turn -?\d+ \d+\n$/);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+Shift+l");
  await isBack();
  await studio.holds("plan.afp.layout", "");
  await move();
  await studio.isSaved();
  await studio.write("plan.afp.layout", "");
  await isBack();
});

inBrowser("the whole plan is cut and pasted in source order, with its start", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await page.locator('.node [data-item="P.drive"]').first().waitFor();
  await page.locator(".board").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Control+x");
  await studio.becomes("plan.afp", /^use carbot\n\nplan P \{\n    in walldist: length = 30 cm\n\}\n$/);
  await page.keyboard.press("Control+v");
  await studio.holds("plan.afp", PLAN);
}, { permissions: ["clipboard-read", "clipboard-write"] });

test("undo reverts the pending change and not the change before it", async () => {
  const texts = new Map([["a", "one"]]);
  attach({
    make: (changes) => changes.map(({ uri, from, to, insert }) => {
      const before = texts.get(uri)!;
      texts.set(uri, before.slice(0, from) + insert + before.slice(to));
      return { uri, from, removed: before.slice(from, to), inserted: insert };
    }),
    select: () => {},
    agree: async () => true,
  });
  const add = (insert: string): void => push({ label: insert, changes: [{ uri: "a", from: texts.get("a")!.length, to: texts.get("a")!.length, insert }] });
  add(" two");
  let answer = (): void => {};
  const change = underWay(new Promise<void>((done) => (answer = done)).then(() => add(" three")));
  const undone = undo();
  assert.equal(texts.get("a"), "one two");
  answer();
  await Promise.all([change, undone]);
  assert.equal(texts.get("a"), "one two");
  assert.deepEqual([log.value.past.length, log.value.future.length], [1, 1]);
  await redo();
  assert.equal(texts.get("a"), "one two three");
  // A rejected change does not count.
  await Promise.all([underWay(Promise.reject(new Error("refused"))).catch(() => {}), undo()]);
  assert.equal(texts.get("a"), "one two");
});
