// Gestures of the drawing by mouse and keys, each compared with the resulting files.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { inBrowser, settled, shows } from "./browser";
import { exit, middle, name, type Spot } from "./spots";

const PLAN = `use carbot

plan P {
    start go

    actor go: Forward {
        ForwardSuccessful -> turn
    }

    actor turn: Turn(angle = 90 deg) {
        TurnSuccessful -> terminate
    }
}
`;

async function drag(page: Page, from: Spot, to: Spot, drop = true): Promise<void> {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0] + 6, from[1] + 3);
  await page.mouse.move(...to, { steps: 5 });
  if (drop) await page.mouse.up();
}

/** Waits for the drawing, and focuses it. */
async function ready(page: Page, item: string): Promise<void> {
  await page.locator(`.node [data-item="${item}"]`).waitFor();
  await page.locator(".board").focus();
}

/** Chooses from the open list. */
async function choose(page: Page, typed: string, label: string): Promise<void> {
  const list = page.locator(".chooser");
  await list.getByRole("option").first().waitFor();
  await list.getByRole("combobox").fill(typed);
  await list.locator("[role=option][aria-selected=true] .choice-label", { hasText: label }).waitFor();
  await page.keyboard.press("Enter");
  await list.waitFor({ state: "detached" });
}

inBrowser("a drag writes one position on the grid, Escape writes none, undo restores the bytes", { "plan.afp": PLAN }, async (studio) => {
  const { page, read, holds } = studio;
  await ready(page, "P.turn");
  let places = 0;
  const from = await middle(page, name("P.turn"));
  page.on("websocket", (socket) => socket.on("framesent", ({ payload }) => (places += String(payload).includes("afp/place") ? 1 : 0)));
  await page.reload();
  await ready(page, "P.turn");
  await drag(page, from, [from[0] + 130, from[1] + 70], false);
  await page.keyboard.press("Escape");
  await page.mouse.move(from[0] + 200, from[1]);
  await page.mouse.up();
  assert.deepEqual(await middle(page, name("P.turn")), from);
  assert.equal(places, 0);
  await drag(page, from, [from[0] + 130, from[1] + 70]);
  await studio.becomes("plan.afp.layout", /^P\.go -?\d+ \d+\nP\.start -?\d+ -?\d+\nP\.turn \d+ \d+\n$/);
  assert.equal(places, 1);
  const [, x, y] = (await read("plan.afp.layout")).trim().split("\n").at(-1)!.split(" ").map(Number);
  assert.deepEqual([x! % 12, y! % 12], [0, 0]);
  await page.keyboard.press("Control+z");
  await holds("plan.afp.layout", "");
  assert.equal(await read("plan.afp"), PLAN);
});

inBrowser("an exit dragged onto an element is connected, onto the ground it asks for a target; an arrow's head can be moved", { "plan.afp": PLAN }, async (studio) => {
  const { page, holds } = studio;
  await ready(page, "P.turn");
  await drag(page, await middle(page, exit("P.turn", "TurnSuccessful")), await middle(page, name("P.go")));
  const looped = PLAN.replace("TurnSuccessful -> terminate", "TurnSuccessful -> go");
  await holds("plan.afp", looped);
  const [x, y] = await middle(page, exit("P.go", "ForwardSuccessful"));
  await drag(page, [x, y], [x + 300, y + 20]);
  await choose(page, "end", "end the plan");
  await holds("plan.afp", looped.replace("ForwardSuccessful -> turn", "ForwardSuccessful -> terminate"));
  await page.keyboard.press("Control+z");
  await holds("plan.afp", looped);
  // Drags the head of the edge to `turn` back onto `go`.
  await page.waitForFunction(() => document.querySelectorAll(".way").length === 3);
  const tip = await page.locator('.way [data-item="P.go"][data-exit="ForwardSuccessful"] .tip').boundingBox();
  await drag(page, [tip!.x + tip!.width / 2, tip!.y + tip!.height - 2], await middle(page, name("P.go")));
  await holds("plan.afp", looped.replace("ForwardSuccessful -> turn", "ForwardSuccessful -> go"));
});

inBrowser("templates are dropped on the ground, onto an element and onto an edge", { "plan.afp": PLAN }, async (studio) => {
  const { page, read } = studio;
  await ready(page, "P.turn");
  const template = async (name: string): Promise<Spot> => {
    await page.locator(`[data-template=${name}]`).scrollIntoViewIfNeeded();
    return middle(page, `[data-template=${name}]`);
  };
  await drag(page, await template("CheckTouchSensor"), await middle(page, name("P.go")));
  await studio.becomes("plan.afp", /actor go: Forward \{\n        supervise checkTouchSensor: CheckTouchSensor \{\}/);
  await drag(page, await template("SearchWall"), [330, 640]);
  await studio.becomes("plan.afp", /actor searchWall: SearchWall \{\}/);
  await studio.becomes("plan.afp.layout", /P\.searchWall -?\d+ -?\d+/);
  await page.locator('.node [data-item="P.searchWall"]').waitFor();
  const line = await page.locator('.way [data-item="P.go"][data-exit="ForwardSuccessful"] .flow').boundingBox();
  await drag(page, await template("Curve"), [line!.x + line!.width / 2, line!.y + 6]);
  await studio.becomes("plan.afp", /ForwardSuccessful -> curve/);
  assert.match(await read("plan.afp"), /actor curve: Curve \{\n\s*CurveSuccessful -> turn\n/);
});

inBrowser("a value is set by steps, sign and formula; a name is changed in place; a template by a click", { "plan.afp": PLAN }, async (studio) => {
  const { page } = studio;
  await ready(page, "P.turn");
  await page.mouse.click(...(await middle(page, '.node [data-item="P.turn"] text.formula')));
  const popup = page.locator(".value-popup");
  await popup.getByRole("button", { name: "flip the sign" }).click();
  await popup.getByRole("button", { name: "more" }).click();
  await popup.getByRole("button", { name: "Set", exact: true }).click();
  await studio.becomes("plan.afp", /Turn\(angle = -\d+ deg\)/);
  await popup.waitFor({ state: "detached" });
  await page.mouse.dblclick(...(await middle(page, name("P.turn"))));
  await page.locator("input.rename").fill("left");
  await page.keyboard.press("Enter");
  await studio.becomes("plan.afp", /-> left[\s\S]*actor left: Turn/);
  await page.locator('.node [data-item="P.go"]').waitFor();
  await page.mouse.click(...(await middle(page, name("P.go"))));
  await page.locator(".inspector-head", { hasText: "go" }).waitFor();
  await page.locator("[data-template=CheckEscapeButton]").click();
  await studio.becomes("plan.afp", /actor go: Forward \{\n        supervise checkEscapeButton: CheckEscapeButton/);
});

inBrowser("an entry dragged onto an element or a port is bound to it; other places are explained", { "plan.afp": PLAN.replace("    start go", "    var gap: length = 20 cm\n    var way: angle = 5 deg\n\n    start go") }, async (studio) => {
  const { page } = studio;
  await ready(page, "P.go");
  const entry = (name: string): Promise<Spot> => middle(page, `.node [data-item="P.start"] text.entry:text-is("${name}")`);
  await drag(page, await entry("gap"), await middle(page, name("P.go")));
  await choose(page, "distance", "distance");
  await studio.becomes("plan.afp", /Forward\(distance = gap\)/);
  await page.locator('.node [data-item="P.go"] text.entry').waitFor();
  await drag(page, await entry("way"), await middle(page, '.node [data-item="P.turn"] text.formula'));
  await studio.becomes("plan.afp", /Turn\(angle = way\)/);
  await drag(page, await entry("way"), await middle(page, '.node [data-item="P.go"] text.entry'));
  await page.locator(".board-notice", { hasText: "angle" }).waitFor();
  await drag(page, await entry("way"), [300, 600]);
  await page.locator(".board-notice", { hasText: "Drop an entry on an element" }).waitFor();
});

inBrowser("zoom, fit and pan change no byte; keys show parts outside of the window", { "plan.afp": PLAN }, async ({ page, read }) => {
  await ready(page, "P.go");
  const zoom = page.locator(".board-zoom");
  for (const [key, wanted] of [["+", "125 %"], ["-", "100 %"], ["1", "100 %"]] as const) {
    await page.keyboard.press(key);
    await zoom.filter({ hasText: wanted }).waitFor();
  }
  const before = await middle(page, name("P.go"));
  await page.mouse.move(...before);
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, -60);
  await page.keyboard.up("Control");
  await zoom.filter({ hasText: /11\d %/ }).waitFor();
  const after = await middle(page, name("P.go"));
  assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) < 12, "the point under the pointer stays");
  for (let round = 0; round < 40; round++) await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Home");
  const [x] = await middle(page, name("P.go"));
  assert.ok(x > 220 && x < 1300, `in sight: ${x}`);
  assert.equal(await read("plan.afp"), PLAN);
  assert.equal(await read("plan.afp.layout"), "");
});

inBrowser("the selection is moved, copied, pasted and removed by keys", { "plan.afp": PLAN }, async (studio) => {
  const { page, holds, read } = studio;
  await ready(page, "P.go");
  for (const key of ["Home", "ArrowDown", "m", "ArrowRight", "Shift+ArrowDown"]) await page.keyboard.press(key);
  await page.keyboard.press("Escape");
  assert.equal(await read("plan.afp.layout"), "");
  for (const key of ["m", "ArrowRight", "Shift+ArrowDown", "Enter"]) await page.keyboard.press(key);
  await studio.becomes("plan.afp.layout", /^P\.turn -?\d+ \d+\n$/m);
  await page.keyboard.press("Control+Shift+l");
  await studio.becomes("plan.afp.layout", /^(?![^]*P\.turn)[^]*P\.go/);
  await page.keyboard.press("Control+d");
  await studio.becomes("plan.afp", /actor turn2: Turn\(angle = 90 deg\)/);
  await page.locator('.node [data-item="P.turn2"]').waitFor();
  await page.keyboard.press("Delete");
  await holds("plan.afp", PLAN);
  await page.locator(".board").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Delete");
  await studio.becomes("plan.afp", /^use carbot\n\nplan P \{\s*\}\n$/);
  await page.keyboard.press("Control+z");
  await holds("plan.afp", PLAN);
});

inBrowser("a blocked clipboard is reported, and no data is lost", { "plan.afp": PLAN }, async ({ page, read }) => {
  const first = await read("plan.afp");
  await ready(page, "P.go");
  await page.evaluate(() => {
    const denied = () => Promise.reject(new DOMException("denied", "NotAllowedError"));
    Object.assign(navigator.clipboard, { readText: denied, writeText: denied });
  });
  await page.mouse.click(900, 600, { button: "right" });
  await page.getByRole("menuitem", { name: /^Paste/ }).click();
  await shows(page.locator(".board-notice"), /read the clipboard: press Ctrl\+V/);
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Control+x");
  await shows(page.locator(".board-notice"), /write to the clipboard/);
  assert.equal(await read("plan.afp"), first);
});

const clipboard = { permissions: ["clipboard-read", "clipboard-write"] };

inBrowser("items are copied as text with their toolbox, cut and pasted; supervisors can be pasted into other elements", { "plan.afp": PLAN.replace("    }\n\n    actor turn", "        supervise touch: CheckTouchSensor { TouchSensorPressed -> turn }\n    }\n\n    actor turn") }, async (studio) => {
  const { page, read } = studio;
  const first = await read("plan.afp");
  await ready(page, "P.go");
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Control+c");
  const copied = () => page.evaluate(() => navigator.clipboard.readText());
  const wanted = "use carbot\nsupervise touch: CheckTouchSensor { TouchSensorPressed -> turn }\n";
  assert.equal(await settled(copied, (now) => now === wanted), wanted);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Control+v");
  await studio.becomes("plan.afp", /actor turn: [^}]*supervise touch: CheckTouchSensor/);
  await page.keyboard.press("Control+z");
  await studio.holds("plan.afp", first);
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Control+x");
  await studio.becomes("plan.afp", /^(?![\s\S]*actor turn)/);
  await page.keyboard.press("Control+v");
  await studio.becomes("plan.afp", /actor turn: Turn\(angle = 90 deg\)/);
}, clipboard);

const NOTED = `use carbot

plan P {
    start go

    // goes ahead: far
    actor go: Forward { ForwardSuccessful -> terminate }

    actor turn: Turn(angle = 90 deg) { TurnSuccessful -> terminate }
}
`;

inBrowser("a cut element keeps its note, a pasted start is the start again, and scenarios do not block the cut", { "plan.afp": NOTED, "tests/s.afp": 'use "../plan.afp"\n\nscenario "s" for P {\n    expect go active\n}\n' }, async (studio) => {
  const { page } = studio;
  await ready(page, "P.go");
  const stood = await page.locator('.node [data-item="P.go"]').first().boundingBox();
  await page.keyboard.press("Home");
  await page.keyboard.press("Control+x");
  await studio.becomes("plan.afp", /^(?![^]*(actor go|goes ahead|start))/);
  await page.keyboard.press("Control+v");
  await studio.becomes("plan.afp", /start go\n[^]*\/\/ goes ahead: far\n    actor go: Forward \{/);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await studio.holds("plan.afp", NOTED);
  await page.waitForFunction(([x, y]) => {
    const now = document.querySelector('.node [data-item="P.go"]')?.getBoundingClientRect();
    return now && Math.abs(now.x - x!) < 1 && Math.abs(now.y - y!) < 1;
  }, [stood!.x, stood!.y]);
}, clipboard);

const NESTED = `use carbot

plan P {
    start q
    subplan q: Q { OK -> terminate }
}

plan Q {
    start go
    actor go: Forward { ForwardSuccessful -> terminate }
}
`;

inBrowser("each sub-plan has its own view; problems are shown at their places", { "plan.afp": NESTED }, async (studio) => {
  const { page } = studio;
  await ready(page, "P.q");
  await page.keyboard.press("-");
  await page.keyboard.press("Home");
  await page.keyboard.press("Control+Enter");
  await page.locator('.node [data-item="Q.go"]').waitFor();
  await page.locator(".board-zoom", { hasText: "100 %" }).waitFor();
  await page.keyboard.press("Backspace");
  await page.locator('.node [data-item="P.q"]').waitFor();
  await page.locator(".board-zoom", { hasText: "80 %" }).waitFor();
  await page.mouse.dblclick(...(await middle(page, name("P.q"))));
  await page.locator('.node [data-item="Q.go"]').waitFor();
  await page.locator(".board").focus();
  await page.keyboard.press("Home");
  await page.keyboard.press("Control+d");
  await page.locator('.node [data-item="Q.go2"]').waitFor();
  await page.mouse.move(...(await middle(page, name("Q.go2"))));
  await page.locator(".tip-box", { hasText: "can never be reached" }).waitFor();
  await page.mouse.move(300, 700);
  // It still has the keyboard focus.
  await page.keyboard.press("Escape");
  await page.locator(".tip-box").waitFor({ state: "detached" });
});
