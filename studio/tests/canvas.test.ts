// The drawing's other features: menus, search, notes, data flow, extracted plans, the far view.
import assert from "node:assert/strict";
import { inBrowser } from "./browser";
import { large } from "./large";
import { middle, name, type Spot } from "./spots";

const PLAN = `use carbot

plan P {
    var gap: length = 20 cm

    start go

    // how far it is
    actor go: Forward(distance = gap) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> turn }
        ForwardSuccessful -> turn
    }

    actor turn: Turn(angle = 90 deg) {
        TurnSuccessful -> terminate
    }
}
`;

inBrowser("the menu of a part opens by mouse and key, and Escape closes it", { "plan.afp": PLAN }, async (studio) => {
  const { page, holds } = studio;
  await page.locator(name("P.turn")).first().waitFor();
  const menu = page.locator(".context-menu");
  await page.mouse.click(...(await middle(page, name("P.turn"))), { button: "right" });
  await menu.getByRole("menuitem", { name: /Remove the selection/ }).waitFor();
  await page.keyboard.press("Escape");
  await menu.waitFor({ state: "detached" });
  await page.mouse.click(...(await middle(page, name("P.turn"))), { button: "right" });
  await menu.getByRole("menuitem", { name: /Duplicate/ }).click();
  await studio.becomes("plan.afp", /actor turn2: Turn/);
  await page.keyboard.press("Control+z");
  await holds("plan.afp", PLAN);
  await page.mouse.click(300, 700, { button: "right" });
  await menu.getByRole("menuitem", { name: /Select everything/ }).click();
  await page.locator(".marks .ring:not(.second, .third)").nth(1).waitFor();
});

inBrowser("a folded box hides ports and supervisors, keeps its edges, and stays folded after a reload", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator(name("P.turn")).first().waitFor();
  const ports = page.locator("text.port");
  const edges = page.locator("[data-item='P.go.touch'][data-exit]");
  await page.locator("text.template", { hasText: "CheckTouchSensor" }).waitFor();
  const before = await ports.count();
  assert.ok((await edges.count()) >= 1);
  await page.mouse.click(...(await middle(page, name("P.go"))));
  await page.keyboard.press("f");
  await page.locator("text.template", { hasText: "CheckTouchSensor" }).waitFor({ state: "detached" });
  assert.ok((await ports.count()) < before);
  assert.ok((await edges.count()) >= 1);
  // At a small zoom, the word on the tab stays inside.
  for (let out = 0; out < 3; out++) await page.keyboard.press("-");
  await page.waitForTimeout(300);
  const [word, tab] = await page.locator("text.bare").evaluate((word) => {
    const tab = [...word.closest("g")!.querySelectorAll(".box.supervisor")].at(-1)!;
    return [word, tab].map((part) => part.getBoundingClientRect()).map(({ left, right }) => ({ left, right }));
  });
  assert.ok(word!.left >= tab!.left - 1 && word!.right <= tab!.right + 1, JSON.stringify({ word, tab }));
  await page.keyboard.press("1");
  await page.reload();
  await page.locator(name("P.turn")).first().waitFor();
  assert.equal(await page.locator("text.template", { hasText: "CheckTouchSensor" }).count(), 0);
  await page.mouse.click(...(await middle(page, name("P.go"))), { button: "right" });
  await page.getByRole("menuitem", { name: /Fold or unfold/ }).click();
  await page.locator("text.template", { hasText: "CheckTouchSensor" }).waitFor();
  assert.equal(await ports.count(), before);
});

inBrowser("elements become a plan, a sub-plan becomes its elements, undo restores the bytes", { "plan.afp": PLAN }, async (studio) => {
  const { page, holds } = studio;
  await page.locator(name("P.turn")).first().waitFor();
  await page.mouse.click(...(await middle(page, name("P.turn"))));
  await page.keyboard.press("Control+g");
  await page.getByRole("dialog").getByRole("textbox").fill("Round");
  await page.keyboard.press("Enter");
  await studio.becomes("plan.afp", /plan Round/);
  await page.locator(name("P.round")).first().waitFor();
  await page.locator(".board").focus();
  await page.keyboard.press("Control+Shift+g");
  await studio.becomes("plan.afp", /plan P \{[^]*actor turn: Turn[^]*plan Round/);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await holds("plan.afp", PLAN);
});

inBrowser("a supervisor is dragged to another element, and to the start", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  const touch = (owner: string): string => `.node [data-item="${owner}"] text.name:text-is("touch")`;
  await page.locator(touch("P.go")).waitFor();
  const drag = async (from: Spot, to: Spot): Promise<void> => {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(from[0] + 8, from[1] + 2);
    await page.mouse.move(...to, { steps: 4 });
    await page.mouse.up();
  };
  await drag(await middle(page, touch("P.go")), await middle(page, name("P.turn")));
  await studio.becomes("plan.afp", /actor turn: Turn\(angle = 90 deg\) \{[^}]*supervise touch/);
  await page.locator(touch("P.turn")).waitFor();
  await drag(await middle(page, touch("P.turn")), await middle(page, '.node [data-item="P.start"] text.start'));
  await studio.becomes("plan.afp", /\n    supervise touch: CheckTouchSensor/);
});

inBrowser("a note is written above its element; the flow of data is shown", { "plan.afp": PLAN }, async (studio) => {
  const { page, holds } = studio;
  await page.locator(name("P.go")).first().waitFor();
  await page.mouse.click(...(await middle(page, name("P.go"))));
  await page.keyboard.press("n");
  const field = page.locator(".note-field textarea");
  await field.waitFor();
  assert.equal(await field.inputValue(), "how far it is");
  await field.fill("how far\nit drives");
  await page.keyboard.press("Control+Enter");
  await holds("plan.afp", PLAN.replace("// how far it is\n", "// how far\n    // it drives\n"));
  await page.locator(".board").focus();
  assert.equal(await page.locator(".data-flow").count(), 0);
  await page.keyboard.press("v");
  await page.keyboard.press("v");
  await page.locator(".data-flow.reads").waitFor();
  await page.keyboard.press("v");
  await page.locator(".data-flow").waitFor({ state: "detached" });
  await page.mouse.move(...(await middle(page, '.node [data-item="P.start"] text.entry')));
  await page.locator(".data-flow.reads").waitFor();
});

inBrowser("the search finds and shows items in the drawing and the text", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator(name("P.go")).first().waitFor();
  await page.keyboard.press("Control+e");
  await page.locator(".cm-content").waitFor();
  await page.locator(".board").focus();
  await page.keyboard.press("Control+f");
  await page.locator(".seek-bar input").fill("turn");
  await page.locator(".marks .found").first().waitFor();
  await page.locator(".cm-sought").first().waitFor();
  await page.keyboard.press("Enter");
  await page.locator(".seek-count", { hasText: /^1 of/ }).waitFor();
  await page.locator(".cm-shown", { hasText: "Turn" }).waitFor();
  await page.keyboard.press("Escape");
  await page.locator(".marks .found").first().waitFor({ state: "detached" });
  await page.keyboard.press("Control+p");
  await page.getByRole("dialog").getByRole("combobox").fill("go");
  await page.getByRole("option", { name: /^go/ }).waitFor();
  await page.keyboard.press("Enter");
  await page.locator(".inspector-head, .cm-shown", { hasText: "go" }).first().waitFor();
});

inBrowser("a large plan has only its visible part in the page; from far away it is painted; the map moves the view", { "plan.afp": large(400) }, async ({ page }) => {
  // An unoptimised server lays out four hundred boxes.
  await page.locator(name("Large.element0")).first().waitFor({ timeout: 60_000 });
  const filled = (): Promise<number> => page.locator(".node > g").count();
  assert.ok((await filled()) < 150, `${await filled()} of 400 are in the page`);
  assert.equal(await page.locator(".far-view").isVisible(), false);
  const map = (await page.locator(".minimap").boundingBox())!;
  await page.mouse.click(map.x + map.width / 2, map.y + map.height - 12);
  await page.locator(name("Large.element0")).first().waitFor({ state: "hidden" });
  await page.locator(".board").focus();
  await page.keyboard.press("0");
  await page.locator(".far-view").waitFor();
  const painted = await page.evaluate(() => {
    const canvas = document.querySelector<HTMLCanvasElement>(".far-view")!;
    const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((value, at) => at % 4 === 3 && value > 0).length;
  });
  assert.ok(painted > 2000, `${painted} pixels are painted`);
});

inBrowser("an unreachable element has a dotted border and a note until it is connected", { "plan.afp": `use std

plan P {
    start go

    actor go: Wait(duration = 1 s) { Elapsed -> terminate }
    actor lost: Wait(duration = 1 s) { Elapsed -> terminate }
}
` }, async ({ page, write, read }) => {
  await page.locator(".unreached-text", { hasText: "never reached" }).waitFor();
  assert.equal(await page.locator(".unreached").count(), 1);
  const [border, box] = [(await page.locator(".unreached").boundingBox())!, (await page.locator('.node [data-item="P.lost"] .box').first().boundingBox())!];
  assert.ok(Math.abs(border.x - box.x) < 6 && Math.abs(border.y - box.y) < 6, JSON.stringify({ border, box }));
  await write("plan.afp", (await read("plan.afp")).replace("Elapsed -> terminate", "Elapsed -> lost"));
  await page.locator(".unreached").waitFor({ state: "detached" });
});
