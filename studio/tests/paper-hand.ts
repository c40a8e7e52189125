// The paper's plan from an empty file, by touch and by mouse.
import assert from "node:assert/strict";
import type { Locator, Page } from "playwright-core";
import { PATIENCE } from "./settled";
import { fillEntry } from "./spots";

export const PLAN = "WallFollowing";

/** The differences between a finger and a mouse. */
export interface Pointer {
  press(part: Locator): Promise<void>;
  pressAt(x: number, y: number): Promise<void>;
  /** Opens the context menu. */
  menuAt(x: number, y: number): Promise<void>;
}

export async function search(hand: Hand): Promise<void> {
  await hand.help("Find the next wall, then drive parallel to it until the escape button is pressed.");
  await hand.entry("in walldist: length = 30 cm");
  await hand.help("Distance to keep to the wall.");
  await hand.entry("var wallangle: angle");
  await hand.add("CheckEscapeButton", "escape");
  await hand.connect("EscapeButtonPressed", "end the plan");
  await hand.add("Forward", "searchFirstWall");
  await hand.value("distance", "10000 cm");
  await hand.add("CheckTouchSensor", "touch");
  await hand.timing("1 ms");
  await hand.create("TouchSensorPressed", "Forward", "backupCollision");
  await hand.value("distance", "-walldist");
  await hand.create("ForwardSuccessful", "SearchWall", "findWallAngle");
  await hand.write("angle", "wallangle");
  await hand.on("searchFirstWall");
  await hand.add("CheckDrivingLane", "checkLane");
  for (const [port, value] of [["distance", "walldist"], ["clearance", "10 cm"], ["margin", "10 cm"], ["halfwidth", "25 cm"]] as const) await hand.value(port, value);
  await hand.connect("LaneNotFree", "findWallAngle");
  await hand.on("searchFirstWall");
  await hand.connect("ForwardSuccessful", "searchFirstWall");
}

export async function follow(hand: Hand): Promise<void> {
  await hand.on("findWallAngle");
  await hand.create("WallFound", "Turn", "parallelToWall");
  await hand.value("angle", "wallangle");
  await hand.create("TurnSuccessful", "WallForward", "followWall");
  for (const [port, value] of [["walldist", "walldist"], ["lanedist", "walldist"], ["gain", "1"], ["tolerance", "20 cm"], ["step", "500 cm"]] as const) await hand.value(port, value);
  await hand.add("CheckTouchSensor", "wallTouch");
  await hand.connect("TouchSensorPressed", "backupCollision");
  await hand.on("followWall");
  await hand.connect("ForwardSuccessful", "followWall");
  await hand.connect("LaneNotFree", "findWallAngle");
  await hand.create("WallLost", "Turn", "turnAfterWallLost");
  await hand.value("angle", "-60 deg");
  await hand.connect("TurnSuccessful", "searchFirstWall");
  await hand.on("findWallAngle");
  await hand.connect("NoWallFound", "turnAfterWallLost");
}

/** Actions of a user with a finger or the mouse; names, help and formulas are typed. */
export class Hand {
  /** Presses of the pointer and typed fields. */
  gestures = 0;
  private readonly pointer: Pointer;

  constructor(private readonly page: Page, private readonly read: () => Promise<string>, pointer: Pointer) {
    const counted = <T extends unknown[]>(take: (...given: T) => Promise<void>) => (...given: T): Promise<void> => {
      this.gestures++;
      return take(...given);
    };
    this.pointer = { press: counted(pointer.press), pressAt: counted(pointer.pressAt), menuAt: counted(pointer.menuAt) };
  }

  /** Types into a field. */
  private async type(field: Locator, text: string): Promise<void> {
    this.gestures++;
    await field.fill(text);
  }

  private async has(wanted: string): Promise<void> {
    const end = Date.now() + 5000;
    while (!new RegExp(wanted).test(await this.read()) && Date.now() < end) await new Promise((done) => setTimeout(done, 20));
    assert.match(await this.read(), new RegExp(wanted));
  }

  /** Waits until an item is selected. */
  private async stands(name: string | RegExp): Promise<void> {
    await this.page.locator(".inspector-head strong", { hasText: name instanceof RegExp ? name : new RegExp(`^${name}$`) }).waitFor();
  }

  /** Whether a place of the drawing can be pressed. */
  private isInSight = (x: number, y: number): Promise<boolean> =>
    this.page.evaluate(([x, y]) => document.elementFromPoint(x, y)?.closest(".board") != null && document.elementFromPoint(x, y)!.closest(".over") === null, [x, y] as const);

  /** Selects an element. A drawing that changes under a press counts as no press. */
  async on(name: string): Promise<void> {
    const [before, end] = [this.gestures, Date.now() + PATIENCE];
    const head = this.page.locator(".inspector-head strong", { hasText: new RegExp(`^${name}$`) });
    const isSelected = (): Promise<boolean> => head.waitFor({ timeout: 2000 }).then(() => true, () => false);
    do {
      this.gestures = before;
      await this.pressOn(name);
    } while (!(await isSelected()) && Date.now() < end);
    await this.stands(name);
  }

  /** Presses an element; if it is out of sight, shows the whole plan first. */
  private async pressOn(name: string): Promise<void> {
    const label = this.page.locator(`.node [data-item="${PLAN}.${name}"] text.name`).first();
    const seen = (await label.count()) ? await label.boundingBox() : null;
    if (!seen || !(await this.isInSight(seen.x + seen.width / 2, seen.y + seen.height / 2))) await this.pointer.press(this.page.getByRole("button", { name: "Show the whole plan" }));
    const box = (await label.boundingBox())!;
    await this.pointer.pressAt(box.x + box.width / 2, box.y + box.height / 2);
  }

  /** Fills a field of the inspector. */
  private async field(label: string, text: string, wanted: string): Promise<void> {
    await this.type(this.page.locator(".inspector").getByLabel(label, { exact: true }), text);
    await this.page.keyboard.press("Enter");
    await this.has(wanted);
  }

  help = (text: string): Promise<void> => this.field("Help", text, text);
  timing = (every: string): Promise<void> => this.field("every", every, `every ${every}`);

  /** Adds an entry from the menu of the start. */
  async entry(line: string): Promise<void> {
    const start = (await this.page.locator(`.node [data-item="${PLAN}.start"] text.start`).boundingBox())!;
    await this.pointer.menuAt(start.x + start.width / 2, start.y + start.height / 2);
    await this.pointer.press(this.page.getByRole("menuitem", { name: "Add an entry" }));
    await fillEntry(this.page, line);
    // The fields that differ from the form's defaults.
    const [, kind, , type, value] = /^(\w+) (\w+): (\w+)(?: = (.*))?$/.exec(line)!;
    this.gestures += 1 + Number(kind !== "var") + Number(type !== "length") + Number(value !== undefined);
    await this.pointer.press(this.page.getByRole("dialog").getByRole("button", { name: "Add an entry" }));
    await this.has(line);
    await this.stands(/(\w+):/.exec(line)![1]!);
  }

  private async rename(template: string, name: string): Promise<void> {
    await this.stands(new RegExp(`^${template.charAt(0).toLowerCase()}${template.slice(1)}\\d*$`));
    await this.field("Name", name, `\\b${name}: `);
    await this.stands(name);
  }

  async add(template: string, name: string): Promise<void> {
    const button = this.page.locator(`[data-template=${template}]`);
    await button.scrollIntoViewIfNeeded();
    await this.pointer.press(button);
    await this.rename(template, name);
  }

  private async then(exit: string, choice: string): Promise<void> {
    await this.pointer.press(this.page.locator(".inspector .row", { hasText: new RegExp(`^${exit}`) }));
    const list = this.page.locator(".chooser");
    await this.pointer.press(list.locator(".choice-label", { hasText: new RegExp(`^${choice}$`) }));
    await list.waitFor({ state: "detached" });
  }

  /** Connects an exit to a new element. */
  async create(exit: string, template: string, name: string): Promise<void> {
    await this.then(exit, `new: ${template}`);
    await this.rename(template, name);
  }

  async connect(exit: string, to: string): Promise<void> {
    await this.then(exit, to);
    await this.has(`${exit}\\s+-> ${to === "end the plan" ? "terminate" : to}\\b`);
  }

  private async port(name: string): Promise<void> {
    await this.pointer.press(this.page.locator(".inspector .port > .row", { hasText: new RegExp(`^${name}`) }));
  }

  async value(port: string, value: string): Promise<void> {
    await this.port(port);
    const chip = this.page.locator(".inspector .value .entry-chip", { hasText: new RegExp(`^${value}$`) });
    await this.page.locator(".inspector .value").waitFor();
    if (await chip.count()) await this.pointer.press(chip);
    else {
      await this.type(this.page.locator(".inspector .value input[type=text]"), value);
      await this.page.keyboard.press("Enter");
    }
    await this.has(`${port} = ${value}`);
  }

  /** Binds an output to an entry. */
  async write(port: string, entry: string): Promise<void> {
    await this.port(port);
    await this.pointer.press(this.page.locator(".inspector .value .entry-chip", { hasText: entry }));
    await this.has(`${port} => ${entry}`);
  }
}
