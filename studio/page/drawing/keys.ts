// Keys of the drawing, each also a command in `Ctrl+K`.
import { signal } from "@preact/signals";
import { command, type Command } from "../screen/commands";
import { active, dismiss, ended } from "../debug/run";
import * as layout from "../screen/layout";
import { pen } from "../server/session";
import { select, selected } from "../plan/selection";
import * as actions from "./actions";
import * as ask from "./ask";
import { pressed, type Carrying } from "./carry";
import { offers } from "./catalog";
import { choose, type Choice } from "./choose";
import * as flow from "./flow";
import { fold } from "./folding";
import { carry, movable, named, snapped } from "./lift";
import { drawing, hold, leave, trail } from "./model";
import { home, reading, step, type Direction } from "./navigate";
import * as note from "./note";
import { choice } from "./offers";
import { choices, component } from "./parts";
import { byKeys, placed, putBack } from "./pointer";
import { renaming } from "./rename";
import { reveal } from "./reveal";
import { chosen as elements, extract, inline, isSubPlan } from "./restructure";
import { refuse, say, spoken } from "./say";
import { around, nameOf, same, type Part } from "./shapes";
import { several, toggle } from "./several";
import { size, view, type Stage } from "./stage";
import { turn } from "./turn";
import { discard, editing } from "./value";
import { fitted, panned, STEP, zoomed } from "./view";
import { words } from "./words";
import * as entries from "./entries";

const moving = signal<Carrying | null>(null);
/** Whether keys are moving the selection. */
export const isMoving = (): boolean => moving.value !== null;

/** Selects by a key, announces it, and scrolls it into view. */
function go(part: Part | null, add = false): void {
  const drawn = drawing.peek();
  if (!part || !drawn) return;
  byKeys.value = true;
  const before = selected.peek();
  select(add ? [...before.filter((other) => !same(other, part)), part] : [part], "drawing");
  reveal(part);
  say(spoken(drawn, part));
}

function walk(direction: Direction): void {
  const drawn = drawing.peek();
  const from = actions.focused();
  if (drawn) go(from ? step(drawn, from, direction) : home(drawn));
}

function everything(): void {
  const drawn = drawing.peek();
  if (!drawn) return;
  const all = reading(drawn).filter((element) => element.kind !== null);
  select(all.map((element) => ({ item: element.item })), "drawing");
  say(words.selectedMany(all.length));
}

const middle = (): [number, number] => [size.peek().width / 2, size.peek().height / 2];

const zoom = (factor: number): void => void (view.value = zoomed(view.peek(), factor, middle()));

export const fit = (): void => {
  const drawn = drawing.peek();
  if (drawn) view.value = fitted(drawn.bounds, size.peek());
};

function zoomSelection(): void {
  const rects = selected.peek().map(actions.rectOfPart).filter((rect) => rect !== null);
  const rect = around(rects);
  if (rect) view.value = fitted(rect, size.peek());
}

/** Lists name, ports and exits of the focused element. */
async function parts(): Promise<void> {
  const part = actions.focused();
  const drawn = drawing.peek();
  if (!part || !drawn) return go(drawn && home(drawn));
  if (part.part?.kind === "exit" || part.part?.kind === "start") return actions.whatThen(part);
  if (part.part?.kind === "input" || part.part?.kind === "output") return void (editing.value = { part, at: actions.below(part) });
  const isMine = turn();
  const known = await component(part.item).catch(() => null);
  if (!isMine()) return;
  const found = known ? choices(known) : [];
  const list: Choice[] = [{ id: "name", label: nameOf(part.item), hint: words.rename }, ...found.map(({ choice }) => choice)];
  const chosen = await choose(words.whichPart(nameOf(part.item)), list, actions.below(part));
  if (chosen?.id === "name") return actions.rename(part);
  const one = found.find(({ choice }) => choice.id === chosen?.id)?.part;
  if (!one) return;
  select([one], "drawing");
  await parts();
}

/** Begins to move the selection with the arrows. */
function lift(): void {
  const drawn = drawing.peek();
  const elements = drawn ? movable(drawn, selected.peek().map((part) => part.item)) : [];
  if (elements.length === 0) return refuse(words.selectFirst);
  hold();
  moving.value = { elements, by: [0, 0] };
  say(words.moving(named(elements)));
}

/** Handles a key during a move; returns false otherwise. */
export function carries(stage: Stage, event: KeyboardEvent): boolean {
  const drawn = drawing.peek();
  const before = moving.peek();
  const found = before && drawn && pressed(before, event);
  if (!before || !drawn || !found) return before !== null && event.key !== "Tab";
  const [after, outcome] = found;
  moving.value = after;
  if (outcome.do === "putBack") {
    putBack(stage);
    say(words.putBack);
    return true;
  }
  const by = snapped(drawn, before.elements, outcome.by, false);
  carry(stage, drawn, before.elements, by);
  const first = drawn.elements.get(before.elements[0] ?? "");
  say(words.moved(named(before.elements), (first?.rect[0] ?? 0) + by[0], (first?.rect[1] ?? 0) + by[1]));
  if (outcome.do === "drop") void placed(stage, before.elements, by);
  return true;
}

/** Reverts a move by keys, because something else was pressed. */
export function settle(stage: Stage): void {
  if (!moving.peek()) return;
  moving.value = null;
  putBack(stage);
}

async function add(): Promise<void> {
  const part = actions.focused();
  const list = async (typed: string): Promise<Choice[]> => (typed ? await ask.palette(typed) : offers.peek()).map((offer) => choice(offer));
  const chosen = await choose(words.add, list, part && actions.below(part));
  const offer = offers.peek().find((offer) => choice(offer).id === chosen?.id);
  if (offer) await actions.addAfter(offer);
}

/** Focuses the inspector. */
function inspect(): void {
  layout.show("inspector");
  requestAnimationFrame(() => document.querySelector<HTMLElement>(".inspector input")?.focus());
}

/** Copies the selection; returns false if the browser denies the clipboard. */
async function copy(): Promise<boolean> {
  const text = await actions.copied();
  return navigator.clipboard.writeText(text).then(() => true, () => (refuse(words.noClipboard), false));
}

const cut = async (): Promise<void> => {
  if (await copy()) await actions.remove(selected.peek());
};

async function paste(): Promise<void> {
  const text = await navigator.clipboard.readText().catch(() => null);
  if (text === null) return refuse(words.noPaste);
  await actions.paste(text);
}

/** Leaves the innermost mode; the selection is last. */
function escape(): void {
  if (renaming.peek()) return void renaming.peek()!.done(null);
  if (editing.peek()) return discard();
  if (several.peek()) return toggle(false);
  if (ended.peek() && !active.peek()) return dismiss();
  select([], "drawing");
  say(words.nothingSelected);
}

/** Registers the drawing's commands; returns a function that removes them. */
export function commands(): () => void {
  const any = (): boolean => selected.peek().length > 0;
  const may = (): boolean => pen.peek() && drawing.peek()?.plan !== null;
  const chosen = (): boolean => may() && any();
  const pan = (dx: number, dy: number) => (): void => void (view.value = panned(view.peek(), dx, dy));
  const list: Omit<Command, "where">[] = [
    { id: "down", label: words.goDown, key: "Down", run: () => walk("down") },
    { id: "up", label: words.goUp, key: "Up", run: () => walk("up") },
    { id: "left", label: words.goLeft, key: "Left", run: () => walk("left") },
    { id: "right", label: words.goRight, key: "Right", run: () => walk("right") },
    { id: "home", label: words.goHome, key: "Home", run: () => drawing.peek() && go(home(drawing.peek()!)) },
    { id: "all", label: words.selectAll, key: "Ctrl+A", run: everything },
    { id: "keep", label: words.addToSelection, key: "Space", enabled: any, run: () => go(actions.focused(), true) },
    { id: "escape", label: words.escape, key: "Escape", run: escape },
    { id: "parts", label: words.parts, key: "Enter", run: parts },
    { id: "add", label: words.add, key: "A", enabled: may, run: add },
    { id: "move", label: words.move, key: "M", enabled: chosen, run: lift },
    { id: "automatic", label: words.automatic, key: "Ctrl+Shift+L", enabled: may, run: actions.automatic },
    { id: "connect", label: words.connect, key: "C", enabled: chosen, run: actions.connect },
    { id: "entry", label: words.addEntry, key: "E", enabled: may, run: entries.add },
    { id: "start", label: words.setStart, key: "S", enabled: chosen, run: actions.start },
    { id: "inspect", label: words.inspect, key: "I", enabled: any, run: inspect },
    { id: "template", label: words.template, key: "T", enabled: chosen, run: actions.template },
    { id: "rename-item", label: words.rename, key: "F2", enabled: chosen, run: () => actions.rename(actions.focused()!) },
    { id: "remove", label: words.remove, key: "Delete", enabled: chosen, run: () => actions.remove(selected.peek()) },
    { id: "duplicate", label: words.duplicate, key: "Ctrl+D", enabled: chosen, run: actions.duplicate },
    { id: "extract", label: words.extract, key: "Ctrl+G", enabled: () => may() && elements().length > 0, run: extract },
    { id: "inline", label: words.inline, key: "Ctrl+Shift+G", enabled: () => may() && isSubPlan(), run: inline },
    { id: "fold", label: words.fold, key: "F", enabled: any, run: fold },
    { id: "note", label: words.writeNote, key: "N", enabled: chosen, run: note.write },
    { id: "flow", label: words.flow, key: "V", run: flow.cycle },
    { id: "paste", label: words.paste, enabled: may, run: paste },
    { id: "several", label: words.several, run: () => toggle() },
    { id: "copy", label: words.copy, key: "Ctrl+C", enabled: any, run: copy },
    { id: "cut", label: words.cut, key: "Ctrl+X", enabled: chosen, run: cut },
    { id: "into", label: words.into, key: "Ctrl+Enter", enabled: isSubPlan, run: () => actions.into(actions.focused()) },
    { id: "out", label: words.out, key: "Backspace", enabled: () => trail.peek().length > 0, run: leave },
    { id: "fit", label: words.zoomFit, key: "0", run: fit },
    { id: "one", label: words.zoomOne, key: "1", run: () => zoom(1 / view.peek().zoom) },
    { id: "zoom-in", label: words.zoomIn, key: ["+", "="], run: () => zoom(STEP) },
    { id: "zoom-out", label: words.zoomOut, key: "-", run: () => zoom(1 / STEP) },
    { id: "zoom-selection", label: words.zoomSelection, key: "Z", enabled: any, run: zoomSelection },
    { id: "pan-left", label: words.pan.left, key: "Shift+Left", run: pan(60, 0) },
    { id: "pan-right", label: words.pan.right, key: "Shift+Right", run: pan(-60, 0) },
    { id: "pan-up", label: words.pan.up, key: "Shift+Up", run: pan(0, 60) },
    { id: "pan-down", label: words.pan.down, key: "Shift+Down", run: pan(0, -60) },
  ];
  const ends = list.map((one) => command({ ...one, id: `drawing.${one.id}`, where: "drawing" }));
  return () => ends.forEach((end) => end());
}
