// Changes from the drawing: each is one request and one history entry.
import { select, selected } from "../plan/selection";
import * as ask from "./ask";
import * as catalog from "./catalog";
import { choose, type Choice } from "./choose";
import { beginPlan } from "./first";
import { drawing, enter, plan } from "./model";
import * as offers from "./offers";
import { renaming } from "./rename";
import { refuse, say } from "./say";
import { holderOf, nameOf, planOf, rectOf, type Drawing, type Edge, type Part, type Point, type Rect } from "./shapes";
import { view } from "./stage";
import { turn } from "./turn";
import { toPane } from "./view";
import { words } from "./words";

/** The part for gestures and keys: the last selected one. */
export const focused = (): Part | null => selected.peek().at(-1) ?? null;

/** The drawing and its plan; null without a plan. */
export function here(): { drawn: Drawing; plan: string } | null {
  const drawn = drawing.peek();
  const name = plan.peek();
  return drawn && name !== null ? { drawn, plan: name } : null;
}

export const rectOfPart = (part: Part): Rect | null => (drawing.peek() ? rectOf(drawing.peek()!, part) : null);

/** A place below a part, for a popup. */
export function below(part: Part): Point | null {
  const rect = rectOfPart(part);
  return rect ? toPane(view.peek(), [rect[0], rect[1] + rect[3] + 6]) : null;
}

/** A place below an element with all its parts. */
export function beneath(part: Part): Point | null {
  const outer = (part.part?.kind ?? "whole") === "whole" ? drawing.peek()?.elements.get(part.item)?.outer : undefined;
  return outer ? toPane(view.peek(), [outer[0], outer[1] + outer[3]]) : below(part);
}

/** Exits of an item, unconnected ones first. */
export function exitsOf(drawn: Drawing, item: string): { part: Part; open: boolean }[] {
  const holder = holderOf(drawn, item);
  const pieces = holder?.pieces.filter((piece) => piece.item === item && piece.part.kind === "exit") ?? [];
  const exits = pieces.map(({ item, part, tag }) => ({ part: { item, part }, open: tag !== null }));
  return [...exits.filter((exit) => exit.open), ...exits.filter((exit) => !exit.open)];
}

/** The owner of a new supervisor: the part's element, or the plan. */
const ownerOf = (drawn: Drawing, part: Part): string | null => {
  const holder = holderOf(drawn, part.item);
  return holder && holder.kind !== null ? nameOf(holder.item) : null;
};

/**
 * Adds a template after the selection, connected to its first free exit; adds a supervisor to the
 * selection. If there is no plan, it starts one.
 */
export async function addAfter(offer: ask.Offer): Promise<void> {
  const at = here();
  if (!at) return beginPlan(offer);
  const part = focused();
  if (offer.kind === "supervise") {
    await ask.edit(offers.added(at.plan, part && ownerOf(at.drawn, part), offer, null));
    return;
  }
  const exits = part ? exitsOf(at.drawn, part.item) : [];
  const own = part?.part?.kind === "exit" ? exits.find((exit) => exit.part.part?.name === part.part?.name) : exits[0];
  await ask.edit(offers.added(at.plan, null, offer, own?.open ? own.part : null, offers.taken(at.drawn)));
}

/** Adds a template at its drop target: the ground, an element, an edge. */
export async function addAt(offer: ask.Offer, to: { place: Point } | { owner: Part } | { edge: Edge }): Promise<void> {
  const at = here();
  if (!at) return beginPlan(offer);
  const names = offers.taken(at.drawn);
  const name = offers.freeName(offer, names);
  const supervises = offer.kind === "supervise";
  if ("owner" in to && supervises) {
    await ask.edit(offers.added(at.plan, ownerOf(at.drawn, to.owner), offer, null));
  } else if (supervises) {
    refuse(words.noElement);
  } else if ("edge" in to && to.edge.from !== to.edge.to) {
    await ask.edit(offers.between(at.plan, offer, to.edge, names));
  } else {
    const places = "place" in to ? { [offers.pathOf(at.plan, null, name)]: to.place } : {};
    await ask.edit(offers.added(at.plan, null, offer, null, names), places);
  }
}

/** Connects an exit, or the start, to an element or a keyword. */
export const lead = (from: Part, to: string): Promise<string[] | null> => ask.edit([offers.leading(from, to)], {}, [from]);

/**
 * Asks for the next element of an exit or of the start; a new element is placed at `place`, if
 * given.
 */
export async function whatThen(from: Part, at: Point | null = below(from), place: Point | null = null): Promise<void> {
  const found = here();
  if (!found) return;
  const start = from.part?.kind === "start";
  const name = from.part?.name ?? "";
  const isMine = turn();
  try {
    const targets = await fitting(from);
    if (!isMine()) return;
    const fresh = offers.usedFirst(offers.ofElements(catalog.offers.peek()), found.drawn);
    const known = [...targets].map(([text, refused]) => offers.target({ text, refused }));
    const list = [...known, ...fresh.map((offer) => offers.choice(offer, words.newOne(offer.template)))];
    const chosen = await choose(start ? words.startWith : words.whatThen(name), list, at);
    if (!chosen) return;
    const offer = fresh.find((offer) => offers.choice(offer).id === chosen.id);
    if (!offer) return void (await lead(from, chosen.id));
    const names = offers.taken(found.drawn);
    const places = place ? { [offers.pathOf(found.plan, null, offers.freeName(offer, names))]: place } : {};
    await ask.edit(offers.added(found.plan, null, offer, from, names), places);
  } catch (why) {
    refuse(why);
  }
}

/** Connects an exit of the selection; asks if there are several. */
export async function connect(): Promise<void> {
  const at = here();
  const part = focused();
  if (!at || !part) return refuse(words.selectFirst);
  if (part.part?.kind === "exit" || part.part?.kind === "start") return whatThen(part);
  if (part.item === at.plan) return whatThen({ item: at.plan, part: { kind: "start", nth: 1 } });
  const exits = exitsOf(at.drawn, part.item);
  const list: Choice[] = exits.map((exit) => ({ id: exit.part.part?.name ?? "", label: exit.part.part?.name ?? "", hint: exit.open ? words.open : "" }));
  if (list.length === 0) return refuse(words.noExit);
  const chosen = list.length === 1 ? list[0]! : await choose(words.whichExit, list, below(part));
  const exit = exits.find((exit) => exit.part.part?.name === chosen?.id);
  if (exit) await whatThen(exit.part);
}

/** Removes items and disconnects exits. */
export async function remove(parts: readonly Part[]): Promise<void> {
  const at = here();
  const whole = new Set(parts.filter((part) => (part.part?.kind ?? "whole") === "whole").map((part) => part.item));
  const changes: ask.Change[] = [];
  for (const { item, part } of parts) {
    // An item with a selected owner is removed with it.
    const owner = item.split(".").slice(0, 2).join(".");
    if (!item.includes(".") || (item !== owner && whole.has(owner))) continue;
    if (part?.kind === "exit") changes.push({ disconnect: { from: item, outcome: part.name } });
    else if (part?.kind === "input" || part?.kind === "output") changes.push({ unbind: { component: item, port: part.name } });
    else changes.push({ remove: { item } });
  }
  if (!at || changes.length === 0) return refuse(words.notHere);
  const done = await ask.edit(changes, {}, parts.filter((part) => part.part?.kind === "exit"));
  if (done) select([], "drawing");
}

export async function start(): Promise<void> {
  const part = focused();
  const element = part && drawing.peek() && holderOf(drawing.peek()!, part.item);
  if (!element || element.kind === null) return refuse(words.selectFirst);
  await ask.edit([{ setStart: { plan: planOf(element.item), to: nameOf(element.item) } }], {}, [{ item: element.item }]);
}

export function rename(part: Part): void {
  const drawn = drawing.peek();
  const rect = drawn && rectOf(drawn, { item: part.item });
  if (!rect) return refuse(words.selectFirst);
  const { zoom } = view.peek();
  const [x, y] = toPane(view.peek(), [rect[0], rect[1]]);
  const name = nameOf(part.item);
  renaming.value = {
    name,
    rect: [x, y, rect[2] * zoom, rect[3] * zoom],
    done: async (to) => {
      const isDone = to === null || to === name || (await ask.edit([{ rename: { item: part.item, to } }], {}, [{ item: renamed(part.item, to) }])) !== null;
      if (isDone) renaming.value = null;
      return isDone;
    },
  };
}

const renamed = (item: string, to: string): string => [...item.split(".").slice(0, -1), to].join(".");

/** Resets the selected elements, or all, to the automatic layout. */
export async function automatic(): Promise<void> {
  const drawn = drawing.peek();
  if (!drawn) return;
  const chosen = selected.peek().map((part) => holderOf(drawn, part.item)?.item ?? part.item);
  const items = chosen.length ? chosen : [...drawn.elements.keys()];
  await ask.place(Object.fromEntries(items.map((item) => [item, null])), words.automaticPlaces);
}

/** The selected items as text, with their toolboxes and the start. */
export async function copied(): Promise<string> {
  const items = [...new Set(selected.peek().map((part) => part.item))].filter((item) => item.includes("."));
  const text = await ask.copied(items);
  say(words.copied(items.length));
  return text;
}

/** Pastes items; supervisors go to the selected element. */
export async function paste(text: string): Promise<void> {
  const at = here();
  if (!at || text.trim() === "") return;
  const part = focused();
  const rect = part && rectOf(at.drawn, { item: part.item });
  const place: Point | null = rect ? [Math.round(rect[0] + 24), Math.round(rect[1] + 24)] : null;
  await ask.paste(at.plan, part && ownerOf(at.drawn, part), text, place);
}

export const duplicate = async (): Promise<void> => paste(await copied());

/** Targets for an exit or the start by name, each with the reason if it does not fit. */
export async function fitting(from: Part): Promise<ReadonlyMap<string, string | null>> {
  if (from.part?.kind !== "start") {
    const list = await ask.targets(from.item, from.part?.name ?? "");
    return new Map(list.map(({ text, refused }) => [text, refused]));
  }
  const all = [...(drawing.peek()?.elements.values() ?? [])];
  return new Map(all.filter((one) => one.kind !== null).map((one) => [nameOf(one.item), null]));
}

/** Double click: opens a sub-plan, or edits a name. */
export function open(part: Part): void {
  if (drawing.peek()?.elements.get(part.item)?.plan) into(part);
  else rename(part);
}

/** Opens the plan of a sub-plan. */
export function into(part: Part | null): void {
  const element = part && drawing.peek()?.elements.get(part.item);
  if (element?.plan) void enter(element.plan, element.file).catch(refuse);
  else refuse(words.noSubPlan);
}

/** Changes the template of the selected element and keeps bindings and edges. */
export async function template(): Promise<void> {
  const part = focused();
  const isMine = turn();
  const found = part && (await ask.parts(part.item).catch(() => null));
  if (!isMine()) return;
  const list = catalog.offers.peek().filter((offer) => offer.kind === found?.kind);
  if (!part || list.length === 0) return refuse(words.selectFirst);
  const chosen = await choose(words.whichTemplate, list.map((offer) => offers.choice(offer)), below(part));
  const offer = list.find((offer) => offers.choice(offer).id === chosen?.id);
  if (offer) await ask.edit([...offers.using(offer), { setTemplate: { component: part.item, template: offer.template } }], {}, [{ item: part.item }]);
}
