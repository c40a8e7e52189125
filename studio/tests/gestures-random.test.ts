// Random gestures: whatever is pressed and dragged, the page says no error, shows what a fresh one shows, and undo of all
// gives the first bytes.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser } from "./browser";

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
const KEYS = ["Home", "ArrowDown", "ArrowUp", "ArrowLeft", "ArrowRight", "Delete", "Control+d", "s", "Escape", "Control+Shift+l", "Control+a", "Space", "Control+Enter", "Backspace", "Control+z", "Control+Shift+z", "0", "1", "-", "+", "Shift+ArrowLeft"];

class Random {
  constructor(private seed: number) {}
  below(most: number): number {
    this.seed = (this.seed * 1103515245 + 12345) & 0x7fffffff;
    return (this.seed >> 8) % most;
  }
  of<T>(list: readonly T[]): T {
    return list[this.below(list.length)]!;
  }
}

/** One gesture, and what ends whatever it has opened. */
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
  switch (random.below(7)) {
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
    default:
      await page.keyboard.press(key);
      return key;
  }
}

/** Leaves every popup and dialog; the drawing has the focus. */
async function leave(page: Page): Promise<void> {
  for (let round = 0; round < 5 && (await page.locator("dialog[open], .chooser, .value-popup, input.rename").count()); round++) await page.keyboard.press("Escape");
  await page.locator(".board").focus();
}

const shown = (page: Page): Promise<string[]> =>
  page.evaluate(() => [...document.querySelectorAll(".node")].map((node) => `${node.getAttribute("aria-label")} ${[...node.querySelectorAll("text")].map((text) => text.textContent).join(" ")}`).sort());

/** More of them with `AFP_SEEDS=20,21,22`. */
for (const seed of (process.env.AFP_SEEDS ?? "20").split(",").map(Number)) {
  inBrowser(`random gestures, seed ${seed}`, { "plan.afp": PLAN }, async ({ page, holds, read, isSaved }) => {
    const random = new Random(seed);
    await page.locator('.node [data-item="P.go"]').waitFor();
    await page.locator(".board").focus();
    const done: string[] = [];
    let texts = 0;
    for (let nth = 0; nth < GESTURES; nth++) {
      done.push(await gesture(page, random));
      await leave(page);
      if ((await read("plan.afp")) !== PLAN) texts++;
    }
    assert.ok(texts > 5, "texts are changed");
    await isSaved();
    for (let round = 0; round < 6; round++) await page.keyboard.press("Backspace");
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
  });
}
