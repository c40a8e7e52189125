// The paper's plan from an empty file by keyboard only, with names, help and formulas typed. The
// result equals the plan's text, apart from line breaks: the engine writes short bodies on one
// line, and the formatter keeps lines.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import type { Page } from "playwright-core";
import { inBrowser } from "./browser";
import { fillEntry } from "./spots";

const PLAN = "WallFollowing";

inBrowser("the paper's plan can be entered with only the keyboard", { "plan.afp": `use carbot\n\nplan ${PLAN} {\n}\n` }, async ({ page, read }) => {
  await page.locator(`.node [data-item="${PLAN}.start"]`).waitFor();
  await page.locator(".board").focus();
  const hands = new Hands(page, () => read("plan.afp"));
  await entries(hands);
  await search(hands);
  await follow(hands);
  const words = (text: string): string => text.replace(/\s+/g, " ");
  const paper = await readFile(new URL("../../plans/wall_following.afp", import.meta.url), "utf8");
  assert.equal(words(await read("plan.afp")), words(paper));
  await page.locator(".count", { hasText: "ready" }).waitFor();
  for (let undone = 0; undone < 80; undone++) await hands.key("Control+z");
  await hands.has(`^use carbot\n\nplan ${PLAN} \\{\n\\}\n$`);
});

async function entries(hands: Hands): Promise<void> {
  await hands.help("Find the next wall, then drive parallel to it until the escape button is pressed.");
  await hands.entry("in walldist: length = 30 cm");
  await hands.help("Distance to keep to the wall.");
  await hands.entry("var wallangle: angle");
  await hands.key("Escape");
  await hands.add("CheckEscapeButton", "escape");
  await hands.connect(null, "end the plan", "EscapeButtonPressed -> terminate");
}

async function search(hands: Hands): Promise<void> {
  await hands.key("Escape");
  await hands.add("Forward", "searchFirstWall");
  await hands.value("distance", "10000 cm");
  await hands.home("searchFirstWall");
  await hands.add("CheckTouchSensor", "touch");
  await hands.timing("1 ms");
  await hands.create(null, "Forward", "backupCollision");
  await hands.value("distance", "-walldist");
  await hands.key("ArrowUp");
  await hands.create(null, "SearchWall", "findWallAngle");
  await hands.write("angle", "wallangle");
  await hands.home("searchFirstWall");
  await hands.add("CheckDrivingLane", "checkLane");
  for (const [port, value] of [["distance", "walldist"], ["clearance", "10 cm"], ["margin", "10 cm"], ["halfwidth", "25 cm"]] as const) {
    await hands.value(port, value);
    await hands.key("ArrowUp");
  }
  await hands.connect(null, "findWallAngle", "LaneNotFree -> findWallAngle");
  await hands.home("searchFirstWall");
  await hands.connect(null, "searchFirstWall", "ForwardSuccessful -> searchFirstWall");
}

async function follow(hands: Hands): Promise<void> {
  await hands.home("searchFirstWall");
  for (const name of ["touch", "checkLane", "findWallAngle"]) {
    await hands.key(name === "touch" ? "ArrowRight" : "ArrowDown");
    await hands.stands(name);
  }
  await hands.create("WallFound", "Turn", "parallelToWall");
  await hands.value("angle", "wallangle");
  await hands.key("ArrowUp");
  await hands.create(null, "WallForward", "followWall");
  for (const [port, value] of [["walldist", "walldist"], ["lanedist", "walldist"], ["gain", "1"], ["tolerance", "20 cm"], ["step", "500 cm"]] as const) {
    await hands.value(port, value);
    await hands.key("ArrowUp");
    await hands.stands("followWall");
  }
  await hands.add("CheckTouchSensor", "wallTouch");
  await hands.connect(null, "backupCollision", "wallTouch: CheckTouchSensor { TouchSensorPressed -> backupCollision");
  await hands.key("ArrowUp", "ArrowLeft");
  await hands.stands("followWall");
  await hands.connect("ForwardSuccessful", "followWall", "ForwardSuccessful -> followWall");
  await hands.key("ArrowUp");
  await hands.connect("LaneNotFree", "findWallAngle", "LaneNotFree\\s+-> findWallAngle\n");
  await hands.key("ArrowUp");
  await hands.create("WallLost", "Turn", "turnAfterWallLost");
  await hands.value("angle", "-60 deg");
  await hands.key("ArrowUp");
  await hands.connect(null, "searchFirstWall", "TurnSuccessful\\s+-> searchFirstWall");
  await hands.home("searchFirstWall");
  await hands.key("ArrowRight", "ArrowDown", "ArrowDown");
  await hands.stands("findWallAngle");
  await hands.connect("NoWallFound", "turnAfterWallLost", "NoWallFound\\s+-> turnAfterWallLost");
}

/** Actions of a user with the keyboard; each waits for the change in the file. */
class Hands {
  constructor(private readonly page: Page, private readonly read: () => Promise<string>) {}

  async key(...keys: string[]): Promise<void> {
    for (const key of keys) await this.page.keyboard.press(key);
  }

  async has(wanted: string): Promise<void> {
    const end = Date.now() + 5000;
    while (!new RegExp(wanted).test(await this.read()) && Date.now() < end) await new Promise((done) => setTimeout(done, 20));
    assert.match(await this.read(), new RegExp(wanted));
  }

  /** Waits until an item is selected. */
  async stands(name: string): Promise<void> {
    await this.page.locator(".inspector-head strong", { hasText: new RegExp(`^${name}$`) }).waitFor();
  }

  async home(name: string): Promise<void> {
    await this.page.locator(".board").focus();
    await this.key("Home");
    await this.stands(name);
  }

  private async choose(typed: string, label: string): Promise<void> {
    const list = this.page.locator(".chooser");
    await list.getByRole("combobox").fill(typed);
    await list.locator("[aria-selected=true] .choice-label", { hasText: new RegExp(`^${label}$`) }).waitFor();
    await this.key("Enter");
  }

  private async rename(from: RegExp, to: string): Promise<void> {
    await this.page.locator(".inspector-head strong", { hasText: from }).waitFor();
    await this.page.locator(".board").focus();
    await this.key("F2");
    await this.page.locator("input.rename").fill(to);
    await this.key("Enter");
    await this.has(`\\b${to}: `);
    await this.stands(to);
  }

  private static wish = (template: string): RegExp => new RegExp(`^${template.charAt(0).toLowerCase()}${template.slice(1)}\\d*$`);

  async add(template: string, name: string): Promise<void> {
    await this.key("a");
    await this.choose(template, template);
    await this.rename(Hands.wish(template), name);
  }

  /** Connects an exit to a new element. */
  async create(exit: string | null, template: string, name: string): Promise<void> {
    await this.key("c");
    if (exit) await this.choose(exit, exit);
    await this.choose(`new: ${template}`, `new: ${template}`);
    await this.rename(Hands.wish(template), name);
  }

  async connect(exit: string | null, to: string, wanted: string): Promise<void> {
    await this.page.locator(".board").focus();
    await this.key("c");
    if (exit) await this.choose(exit, exit);
    await this.choose(to, to);
    await this.has(wanted);
  }

  private async port(name: string): Promise<void> {
    await this.page.locator(".board").focus();
    await this.key("Enter");
    await this.choose(name, name);
    await this.page.locator(".value-popup .value").waitFor();
  }

  async value(port: string, value: string): Promise<void> {
    await this.port(port);
    await this.page.locator(".value-popup input[type=text]").fill(value);
    await this.key("Enter");
    await this.has(`${port} = ${value}`);
    await this.page.locator(".value-popup").waitFor({ state: "detached" });
  }

  /** Binds an output to an entry; its button has the focus. */
  async write(port: string, entry: string): Promise<void> {
    await this.port(port);
    await this.page.locator(".value-popup button:focus", { hasText: entry }).waitFor();
    await this.key("Enter");
    await this.has(`${port} => ${entry}`);
  }

  async entry(line: string): Promise<void> {
    await this.page.locator(".board").focus();
    await this.key("e");
    await fillEntry(this.page, line);
    await this.key("Enter");
    await this.has(line);
    await this.stands(/(\w+):/.exec(line)![1]!);
  }

  private async field(label: string, text: string, wanted: string): Promise<void> {
    const field = this.page.locator(".inspector").getByLabel(label, { exact: true });
    await field.fill(text);
    await this.key("Enter");
    await this.has(wanted);
    await this.page.locator(".board").focus();
  }

  help = (text: string): Promise<void> => this.field("Help", text, text);
  timing = (every: string): Promise<void> => this.field("every", every, `every ${every}`);
}
