// Pointers on the drawing: feeds the state machine of `gesture.ts` and performs its effects.
import { signal } from "@preact/signals";
import { pen } from "../server/session";
import { select, selected } from "../plan/selection";
import * as actions from "./actions";
import * as ask from "./ask";
import { openMenu } from "./context";
import { refresh } from "./fill";
import { IDLE, next, RESTS, type Effect, type Event, type State } from "./gesture";
import { hit, NEAR_EDGE, NEAR_FINGER, onOf, type Hit } from "./hit";
import { carry, movable, places, snapped } from "./lift";
import * as lead from "./lead";
import { drawing, hold, release } from "./model";
import { say } from "./say";
import { several } from "./several";
import { planOf, same, touches, type Point, type Rect } from "./shapes";
import { size, view, type Stage } from "./stage";
import { pressed } from "./turn";
import { editing } from "./value";
import * as live from "../debug/live";
import { chipAt } from "../debug/values";
import { panned, toPane, toPlan, wheelFactor, zoomed } from "./view";
import { words } from "./words";

/** The selection box, in units of the plan. */
export const box = signal<Rect | null>(null);
/** The item under the pointer, and its place. */
export const hovered = signal<{ hit: Hit; at: Point } | null>(null);
/** Whether the keys made the selection: only then the focus has separate rings. */
export const byKeys = signal(false);

let state: State = IDLE;
let lifted: readonly string[] = [];
/** Timer of a resting finger. */
let resting: ReturnType<typeof setTimeout>;

/** Whether the space bar is held: a drag then pans, as with the middle button. */
let spaced = false;

/** Whether a drag is in progress. */
export const busy = (): boolean => state.is !== "idle";

export function pointers(host: HTMLElement, stage: Stage): () => void {
  const at = (event: MouseEvent): Point => {
    const { left, top } = host.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  const under = (place: Point, touch: boolean): Hit | null => {
    const drawn = drawing.peek();
    return drawn && hit(drawn, toPlan(view.peek(), place), view.peek().zoom, touch ? NEAR_FINGER : NEAR_EDGE);
  };
  const feed = (event: Event): void => {
    const [after, effects] = next(state, event);
    state = after;
    host.dataset.state = after.is;
    effects.forEach((effect) => run(stage, effect));
  };
  const down = (event: PointerEvent): void => {
    pressed();
    if (event.button > 1 || (event.target as Element).closest(".over")) return;
    host.setPointerCapture(event.pointerId);
    host.focus({ preventScroll: true });
    byKeys.value = false;
    const place = at(event);
    const touch = event.pointerType === "touch";
    const drawn = drawing.peek();
    const selection = drawn ? movable(drawn, selected.peek().map((part) => part.item)) : [];
    const { pointerId: id } = event;
    feed({ type: "down", id, at: place, hit: under(place, touch), shift: event.shiftKey || several.peek(), middle: event.button === 1 || spaced, touch, selection });
    clearTimeout(resting);
    if (touch) resting = setTimeout(() => feed({ type: "rest", id }), RESTS);
    event.preventDefault();
  };
  const move = (event: PointerEvent): void => {
    if (state.is !== "idle") return feed({ type: "move", id: event.pointerId, at: at(event), free: event.altKey });
    const place = at(event);
    const found = (event.target as Element).closest(".over") ? null : under(place, false);
    host.dataset.over = found?.on ?? "";
    hovered.value = found && { hit: found, at: place };
  };
  const up = (event: PointerEvent): void => feed({ type: "up", id: event.pointerId, at: at(event), free: event.altKey });
  const cancel = (): void => feed({ type: "cancel" });
  const space = (event: KeyboardEvent): void => {
    if (event.key === " ") spaced = event.type === "keydown";
  };
  const escape = (event: KeyboardEvent): void => {
    if (event.key !== "Escape" || state.is === "idle") return;
    event.preventDefault();
    event.stopPropagation();
    cancel();
    say(words.putBack);
  };
  const wheel = (event: WheelEvent): void => {
    if ((event.target as Element).closest(".over")) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    const [dx, dy] = event.shiftKey && event.deltaX === 0 ? [event.deltaY, 0] : [event.deltaX, event.deltaY];
    view.value = event.ctrlKey || event.metaKey ? zoomed(view.peek(), wheelFactor(event.deltaY * lines), at(event)) : panned(view.peek(), -dx * lines, -dy * lines);
  };
  const twice = (event: MouseEvent): void => {
    const found = (event.target as Element).closest(".over") ? null : under(at(event), false);
    if (!found || found.on === "exit" || found.on === "port" || "edge" in found) return;
    actions.open(found.part);
  };
  const asked = (event: MouseEvent): void => {
    event.preventDefault();
    if ((event.target as Element).closest(".over") || state.is !== "idle") return;
    // A key opens the menu of the selection, at its place.
    const part = actions.focused();
    const byKey = event.button !== 2 && !(event instanceof PointerEvent && event.pointerType === "touch");
    if (byKey) openMenu(drawing.peek() && part && onOf(drawing.peek()!, part), (part && actions.below(part)) ?? at(event));
    else run(stage, { do: "menu", hit: under(at(event), false), at: at(event) });
  };
  const out = (): void => void (hovered.value = null);
  const all: [string, (event: any) => void, AddEventListenerOptions?][] = [
    ["pointerdown", down], ["pointermove", move], ["pointerup", up], ["pointercancel", cancel], ["lostpointercapture", () => state.is !== "pinching" && state.is !== "idle" && cancel()],
    ["wheel", wheel, { passive: false }], ["dblclick", twice], ["contextmenu", asked], ["pointerleave", out],
  ];
  for (const [name, take, options] of all) host.addEventListener(name, take, options);
  window.addEventListener("keydown", escape, true);
  for (const type of ["keydown", "keyup"] as const) window.addEventListener(type, space, true);
  return () => {
    for (const [name, take] of all) host.removeEventListener(name, take);
    window.removeEventListener("keydown", escape, true);
    for (const type of ["keydown", "keyup"] as const) window.removeEventListener(type, space, true);
  };
}

function run(stage: Stage, effect: Effect): void {
  const drawn = drawing.peek();
  switch (effect.do) {
    case "pan":
      view.value = panned(view.peek(), ...effect.by);
      return;
    case "zoom":
      view.value = zoomed(view.peek(), effect.factor, effect.at);
      return;
    case "click":
      return click(effect.hit, effect.at, effect.add);
    case "menu":
      return about(effect.hit, effect.at);
    case "lift":
      return lift(effect.elements);
    case "drag":
      if (drawn && pen.peek()) carry(stage, drawn, lifted, snapped(drawn, lifted, scaled(effect.by), effect.free));
      return;
    case "drop":
      return void drop(stage, effect.by, effect.free);
    case "putBack":
      return putBack(stage);
    case "box":
    case "boxed":
      return boxed(effect.from, effect.to, effect.do === "boxed");
    case "unbox":
      box.value = null;
      return;
    case "draw":
      hovered.value = null;
      return void lead.begin(effect.from);
    case "lead":
      return lead.to(effect.at);
    case "connect":
      return void lead.drop(effect.at);
    case "undraw":
      lead.connecting.value = null;
  }
}

/** Lifts elements, and selects one that was not selected. */
function lift(elements: readonly string[]): void {
  const drawn = drawing.peek();
  lifted = elements;
  hovered.value = null;
  hold();
  const known = drawn ? movable(drawn, selected.peek().map((part) => part.item)) : [];
  if (!elements.every((item) => known.includes(item))) select(elements.map((item) => ({ item: drawn?.elements.get(item)?.kind === null ? planOf(item) : item })), "drawing");
}

/** Opens the menu of a pressed item, and selects it. */
function about(found: Hit | null, at: Point): void {
  hovered.value = null;
  if (found && !selected.peek().some((other) => same(other, found.part))) select([found.part], "drawing");
  openMenu(found?.on ?? null, beside(found, at));
}

/** Space for the menu, pixels. */
const MENU = 300;

/** A place next to the pressed element, so that its menu does not cover it. */
function beside(found: Hit | null, at: Point): Point {
  const outer = found && "element" in found ? drawing.peek()?.elements.get(found.element)?.outer : undefined;
  if (!outer) return at;
  const [left] = toPane(view.peek(), [outer[0], outer[1]]);
  const [right] = toPane(view.peek(), [outer[0] + outer[2], outer[1]]);
  if (right + MENU < size.peek().width) return [right + 8, at[1]];
  return left > MENU ? [left - MENU, at[1]] : at;
}

const scaled = ([x, y]: Point): Point => [x / view.peek().zoom, y / view.peek().zoom];

function click(found: Hit | null, at: Point, add: boolean): void {
  const before = selected.peek();
  const held = add ? null : chipAt(toPlan(view.peek(), at));
  if (held !== null) return void (live.open({ item: held }) || select([{ item: held }], "drawing"));
  if (!found) return add ? undefined : select([], "drawing");
  const { part } = found;
  const known = before.some((other) => same(other, part));
  select(add ? (known ? before.filter((other) => !same(other, part)) : [...before, part]) : [part], "drawing");
  if (!add && found.on === "entry") live.open(part);
  if (add || !pen.peek()) return;
  // Below the click, so that it stays visible.
  if (found.on === "exit") void actions.whatThen(part);
  if (found.on === "port") editing.value = { part, at: actions.below(part) ?? at };
}

/** Drops elements: one request, whose answer replaces the preview. */
async function drop(stage: Stage, by: Point, free: boolean): Promise<void> {
  const drawn = drawing.peek();
  const elements = lifted;
  if (!drawn || !pen.peek()) return putBack(stage);
  const moved = snapped(drawn, elements, scaled(by), free);
  if (moved[0] === 0 && moved[1] === 0) return putBack(stage);
  await placed(stage, elements, moved);
}

/** Writes the positions of elements that are already shown there. */
export async function placed(stage: Stage, elements: readonly string[], by: Point): Promise<void> {
  const drawn = drawing.peek();
  if (!drawn) return;
  for (const item of elements) stage.nodes.get(item)?.setAttribute("data-dropped", "yes");
  release();
  const done = await ask.place(places(drawn, elements, by), words.movePlaces);
  if (!done && drawing.peek() === drawn) refresh(stage, drawn, drawn);
  setTimeout(() => elements.forEach((item) => stage.nodes.get(item)?.removeAttribute("data-dropped")), 500);
}

export function putBack(stage: Stage): void {
  const drawn = drawing.peek();
  release();
  if (drawn && drawing.peek() === drawn) refresh(stage, drawn, drawn);
}

function boxed(from: Point, to: Point, done: boolean): void {
  const [[ax, ay], [bx, by]] = [toPlan(view.peek(), from), toPlan(view.peek(), to)];
  const rect: Rect = [Math.min(ax, bx), Math.min(ay, by), Math.abs(ax - bx), Math.abs(ay - by)];
  box.value = done ? null : rect;
  const drawn = drawing.peek();
  if (!done || !drawn) return;
  const inside = [...drawn.elements.values()].filter((element) => element.kind !== null && touches(element.rect, rect));
  const items = inside.map((element) => ({ item: element.item }));
  select([...selected.peek().filter((part) => !items.some((other) => same(other, part))), ...items], "drawing");
}
