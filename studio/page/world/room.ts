// The editor of a room: boxes, walls and the robot's start. The server writes the world file; the
// page applies its text as a change that can be undone.
import { computed, signal } from "@preact/signals";
import { pathOf, uriOf } from "../documents/addresses";
import { current, isOpen, onText, open, text } from "../documents/documents";
import { change } from "../documents/edits";
import { isWritten } from "../debug/written";
import { active, log, world as chosen } from "../debug/run";
import { refuse } from "../drawing/say";
import { hello, lsp, pen } from "../server/session";
import { words } from "../words";
import type { Point, Pose } from "./geometry";
import type { Held } from "./hand";
import { choose, reload, surroundings } from "./surroundings";

export type Tool = "move" | "box" | "wall" | "remove";

/** The selected tool; null while the room is not edited. */
export const chosenTool = signal<Tool | null>(null);
/** The tool in use: never during a run or in a log. */
export const tool = computed(() => (active.value || log.value || !file.value ? null : chosenTool.value));
/** The corners of the box, or the ends of the wall, that the pointer draws. */
export const sketch = signal<readonly Point[] | null>(null);

/** The address of the shown world's file; null for another world. */
export const file = computed(() => {
  const name = chosen.value ?? surroundings.value?.worlds[0]?.name ?? "";
  const root = hello.value ? pathOf(hello.value.root) : "";
  return root && name.startsWith(`${root}/`) ? uriOf(name) : null;
});

/** Grid of the drawn corners, metres. */
const GRID = 0.05;
const snapped = ([x, y]: Point): Point => [Math.round(x / GRID) * GRID, Math.round(y / GRID) * GRID];

/** Makes an empty room, and edits it. */
export async function begin(): Promise<void> {
  try {
    const taken = new Set((surroundings.peek()?.worlds ?? []).map(({ name }) => name.split("/").at(-1)));
    let nth = 1;
    while (taken.has(`${words.roomFile(nth)}.toml`)) nth += 1;
    const { uri } = await lsp().request<{ uri: string }>("afp/newWorld", { plan: current.peek(), name: words.roomFile(nth) });
    choose(pathOf(uri));
    await reload();
    chosenTool.value = "box";
  } catch (why) {
    refuse(why);
  }
}

/** Changes the world file. */
async function furnish(wanted: object, label: string): Promise<void> {
  const uri = file.peek();
  if (!uri || !pen.peek()) return refuse(words.watching);
  try {
    await open(uri);
    await change(async () => {
      const before = text(uri);
      const { text: newText } = await lsp().request<{ text: string }>("afp/furnish", { uri, change: wanted });
      const lines = before.split("\n");
      const range = { start: { line: 0, character: 0 }, end: { line: lines.length - 1, character: lines.at(-1)!.length } };
      return { label, edit: { documentChanges: [{ textDocument: { uri, version: null }, edits: [{ range, newText }] }] } };
    });
  } catch (why) {
    refuse(why);
  }
}

/** Draws a box between two corners, or a wall between two ends. */
export function draw(from: Point, to: Point): void {
  const [a, b] = [snapped(from), snapped(to)];
  const [width, depth] = [Math.abs(b[0] - a[0]), Math.abs(b[1] - a[1])];
  if (tool.peek() === "wall" && width + depth > 0) void furnish({ addWall: { points: [a, b] } }, words.drawWall);
  if (tool.peek() === "box" && width > 0 && depth > 0) void furnish({ addBox: { pose: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0], size: [width, depth] } }, words.drawBox);
}

/** The outline of the sketch. */
export const outlined = (from: Point, to: Point): Point[] => {
  const [a, b] = [snapped(from), snapped(to)];
  return tool.peek() === "wall" ? [a, b] : [a, [b[0], a[1]], b, [a[0], b[1]]];
};

/** Writes the new place of the robot or a box. */
export const put = (what: Held, pose: Pose): void =>
  void (what === "robot" ? furnish({ start: { pose } }, words.moveStart) : furnish({ move: { thing: what.id, pose } }, words.moveThing));

export const remove = (what: Held): void => void (what !== "robot" && furnish({ remove: { thing: what.id } }, words.removeThing));

/** Shows the room again after each change of its text, also by undo. */
export const follow = (): (() => void) =>
  onText((uri) => {
    if (uri === file.peek() && isOpen(uri)) void isWritten().then((done) => (done ? reload() : undefined));
  });
