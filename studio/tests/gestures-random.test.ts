// Random gestures: no console errors, a readable text, an equal fresh page, and undo restores the
// first bytes and the first picture. `AFP_GESTURES=2000` sets their number, fifty per plan.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import type { Page } from "playwright-core";
import { AFPC, inBrowser, settled, SKIP } from "./browser";
import { random as numbers } from "./random";

const PLAN = `use carbot

plan P {
    var gap: length = 20 cm

    start go

    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }

    actor go: Forward(distance = gap) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> turn }
        ForwardSuccessful -> turn
    }

    actor turn: Turn(angle = 90 deg) {
        TurnSuccessful -> rest
    }

    subplan rest: Q {
        OK -> terminate
    }
}

plan Q {
    start wait
    actor wait: Turn { TurnSuccessful -> terminate }
}
`;

const GESTURES = 50;
const ALL = Number(process.env.AFP_GESTURES ?? GESTURES);
const KEYS = ["v", "Control+f", "Control+Shift+g", "Home", "ArrowDown", "ArrowUp", "ArrowLeft", "ArrowRight", "Delete", "Control+d", "s", "Escape", "Control+Shift+l", "Control+a", "Space", "Control+Enter", "Backspace", "Control+z", "Control+Shift+z", "0", "1", "-", "+", "Shift+ArrowLeft"];

class Random {
  readonly below: (most: number) => number;
  constructor(seed: number) {
    this.below = numbers(seed);
  }
  of<T>(list: readonly T[]): T {
    return list[this.below(list.length)]!;
  }
}

/** One gesture, and the end of everything that it has opened. */
async function gesture(page: Page, random: Random): Promise<string> {
  const spot = (): [number, number] => [240 + random.below(740), 60 + random.below(640)];
  const boxes = await page.locator(".node text").all();
  const thing = async (): Promise<[number, number]> => {
    const box = boxes.length ? await random.of(boxes).boundingBox() : null;
    return box && box.x > 230 && box.x < 980 && box.y > 50 && box.y < 700 ? [box.x + box.width / 2, box.y + box.height / 2] : spot();
  };
  const drag = async (from: [number, number], to: [number, number], end: "up" | "Escape"): Promise<string> => {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(...to, { steps: 4 });
    if (end === "Escape") await page.keyboard.press("Escape");
    await page.mouse.up();
    return `drag ${from} ${to} ${end}`;
  };
  const choice = async (key: string): Promise<string> => {
    await page.keyboard.press(key);
    await page.waitForTimeout(30);
    if (await page.locator(".chooser").count()) {
      const steps = random.below(6);
      for (let step = 0; step < steps; step++) await page.keyboard.press("ArrowDown");
      await page.keyboard.press(random.below(3) ? "Enter" : "Escape");
    }
    return `choice ${key}`;
  };
  const key = random.of(KEYS);
  switch (random.below(9)) {
    case 0:
      return drag(await thing(), spot(), random.below(4) ? "up" : "Escape");
    case 1:
      return drag(await thing(), await thing(), "up");
    case 2:
      await page.mouse.click(...(await thing()));
      return "click";
    case 3:
      return choice(random.of(["a", "c", "t", "Enter"]));
    case 4:
      for (const each of ["m", "ArrowRight", "Shift+ArrowDown", random.below(3) ? "Enter" : "Escape"]) await page.keyboard.press(each);
      return "carry";
    case 5: {
      await page.mouse.click(...(await thing()), { button: "right" });
      const items = await page.getByRole("menuitem").all();
      const chosen = items.length && random.below(4) ? random.of(items) : null;
      const label = await chosen?.textContent();
      await chosen?.click();
      await page.waitForTimeout(30);
      if (await page.locator("dialog[open] form").count()) await page.keyboard.press("Enter");
      return `menu ${label}`;
    }
    case 6:
      await page.keyboard.press("n");
      await page.waitForTimeout(60);
      if (await page.locator(".note-field").count()) await page.keyboard.type(random.of(["a", "two words", "// x", ""]));
      return "note";
    default:
      await page.keyboard.press(key);
      return key;
  }
}

/** Closes every popup and dialog and focuses the drawing. */
async function leave(page: Page): Promise<void> {
  for (let round = 0; round < 5 && (await page.locator("dialog[open], .chooser, .value-popup, input.rename, .context-menu, .note-field, .seek-bar").count()); round++) await page.keyboard.press("Escape");
  await page.locator(".board").focus();
}

const shown = (page: Page): Promise<string[]> =>
  page.evaluate(() => [...document.querySelectorAll(".node")].map((node) => `${node.getAttribute("aria-label")} ${[...node.querySelectorAll("text")].map((text) => text.textContent).join(" ")}`).sort());

/** Each box and edge as drawn. */
const picture = (page: Page): Promise<string[]> =>
  page.evaluate(() => [...document.querySelectorAll(".node > .element, .way > .edge")].map((group) => group.outerHTML).sort());

/** Syntax errors of the text: plans may be unfinished, but must be readable. */
function unreadable(folder: string): string {
  const { stdout, stderr } = spawnSync(AFPC, ["check", join(folder, "plan.afp")], { encoding: "utf8" });
  return (stdout + stderr).split("\n").filter((line) => /error\[E01/.test(line)).join("\n");
}

/** The number of gestures that changed the text. */
let texts = 0;

for (let round = 0; round < Math.max(1, ALL / GESTURES); round++) {
  const seed = Number(process.env.AFP_SEED ?? 20) + round;
  inBrowser(`random gestures, seed ${seed}`, { "plan.afp": PLAN }, async ({ page, folder, holds, read, isSaved }) => {
    const random = new Random(seed);
    await page.locator('.node [data-item="P.go"]').waitFor();
    await page.locator(".board").focus();
    const first = await picture(page);
    const done: string[] = [];
    for (let nth = 0; nth < GESTURES; nth++) {
      done.push(await gesture(page, random));
      await leave(page);
      if ((await read("plan.afp")) !== PLAN) texts++;
    }
    await isSaved();
    assert.equal(unreadable(folder), "", `${done.join("\n")}\n${await read("plan.afp")}`);
    for (let back = 0; back < 6; back++) await page.keyboard.press("Backspace");
    await page.waitForTimeout(300);
    const before = await shown(page);
    await page.reload();
    await page.locator(".node").first().waitFor();
    await page.waitForTimeout(300);
    assert.deepEqual(await shown(page), before, done.join("\n"));
    await page.locator(".board").focus();
    for (let undone = 0; undone < 2 * GESTURES; undone++) await page.keyboard.press("Control+z");
    await holds("plan.afp", PLAN);
    await holds("plan.afp.layout", "");
    await leave(page);
    // Folded boxes belong to the view, and not to the plan.
    if (await page.evaluate(() => sessionStorage.getItem("afp.folded") !== "{}")) {
      await page.evaluate(() => sessionStorage.setItem("afp.folded", "{}"));
      await page.reload();
      await page.locator(".node").first().waitFor();
    }
    for (const key of ["Backspace", "Backspace", "Backspace", "Escape", "Home"]) await page.keyboard.press(key);
    const text = JSON.stringify(first);
    const now = async (): Promise<string> => JSON.stringify(await picture(page));
    assert.equal(await settled(now, (shown) => shown === text), text, done.join("\n"));
  });
}

test("random gestures change the text", { skip: SKIP }, () => {
  assert.ok(texts > Math.min(ALL, GESTURES) / 10, `${texts}`);
});
