// Drawing a connection: from an exit to the next element, or from an entry to a port.
import { signal } from "@preact/signals";
import { select } from "../plan/selection";
import { pen } from "../server/session";
import * as actions from "./actions";
import * as ask from "./ask";
import { choose } from "./choose";
import { hit } from "./hit";
import { GRID } from "./lift";
import { drawing } from "./model";
import { refuse } from "./say";
import { pathOf } from "./offers";
import { choices, component } from "./parts";
import { centre, holderOf, nameOf, planOf, rectOf, type Drawing, type Part, type Point } from "./shapes";
import { view } from "./stage";
import { turn } from "./turn";
import { toPlan } from "./view";
import { words } from "./words";

/**
 * The new edge: its possible targets, each with the reason if it does not fit, and its end in
 * pixels of the pane.
 */
export const connecting = signal<{ from: Part; targets: ReadonlyMap<string, string | null>; over: string | null; at: Point | null } | null>(null);

const isWhole = ({ part }: Part): boolean => part === undefined || part.kind === "whole";

/** Whether a supervisor is dragged to another element; other whole items are entries. */
export const isSupervisor = (drawn: Drawing, from: Part): boolean => isWhole(from) && !drawn.entries.some((entry) => entry.item === from.item);

/** The permitted targets. */
async function targetsOf(from: Part): Promise<ReadonlyMap<string, string | null>> {
  const drawn = drawing.peek();
  if (!isWhole(from) || !drawn) return actions.fitting(from);
  const all = [...drawn.elements.values()];
  // An entry's ports are checked at the drop; a supervisor on the start watches the whole plan.
  return new Map(all.filter((one) => one.kind !== null || isSupervisor(drawn, from)).map((one) => [nameOf(one.item), null]));
}

export async function begin(from: Part): Promise<void> {
  if (!pen.peek()) return;
  connecting.value = { from, targets: new Map(), over: null, at: null };
  select([from], "drawing");
  try {
    const targets = await targetsOf(from);
    const now = connecting.peek();
    if (now?.from === from) connecting.value = { ...now, targets };
  } catch (why) {
    refuse(why);
  }
}

export function to(at: Point): void {
  const [drawn, now] = [drawing.peek(), connecting.peek()];
  if (!drawn || !now) return;
  const found = hit(drawn, toPlan(view.peek(), at), view.peek().zoom, 0);
  connecting.value = { ...now, over: found && "element" in found ? found.element : null, at };
}

/** Drops on a target, on an invalid one, or on the ground, which asks. */
export async function drop(at: Point): Promise<void> {
  to(at);
  const [drawn, now] = [drawing.peek(), connecting.peek()];
  connecting.value = null;
  if (!drawn || !now) return;
  const place = toPlan(view.peek(), at);
  const found = hit(drawn, place, view.peek().zoom, 0);
  if (isSupervisor(drawn, now.from)) return found && "element" in found ? hand(drawn, now.from, found.element) : refuse(words.noElement);
  if (isWhole(now.from)) return found && "element" in found ? bind(now.from, found.part, at) : refuse(words.portHint);
  const over = now.over === null ? undefined : drawn.elements.get(now.over);
  const reason = over && now.targets.get(nameOf(over.item));
  if (reason) return refuse(reason);
  if (over?.kind) return void (await actions.lead(now.from, nameOf(over.item)));
  const grid = (value: number): number => Math.round(value / GRID) * GRID;
  await actions.whatThen(now.from, at, [grid(place[0] - 60), grid(place[1])]);
}

/** Moves a supervisor to another element, or to the whole plan. */
async function hand(drawn: Drawing, { item }: Part, to: string): Promise<void> {
  if (holderOf(drawn, item)?.item === to) return;
  const plan = planOf(item);
  const owner = drawn.elements.get(to)?.kind === null ? null : nameOf(to);
  const after = pathOf(plan, owner, nameOf(item));
  await ask.edit([{ move: { item, plan, ...(owner ? { owner } : {}) } }], {}, [{ item: after }]);
}

/** Binds a port to an entry; for an element, asks for the port if several fit. */
async function bind(entry: Part, onto: Part, at: Point): Promise<void> {
  const isMine = turn();
  const found = await component(onto.item).catch(() => null);
  if (!found) return refuse(words.portHint);
  const name = nameOf(entry.item);
  const reason = (port: (typeof found.ports)[number]): string | null => {
    const known = port.answer?.candidates.find((candidate) => candidate.text === name);
    return known ? known.refused : words.noFit(name);
  };
  const dropped = onto.part?.kind === "input" || onto.part?.kind === "output" ? found.ports.filter((port) => port.name === onto.part?.name) : found.ports;
  const fits = dropped.filter((port) => reason(port) === null);
  if (fits.length === 0) return refuse(dropped[0] ? (reason(dropped[0]) ?? words.portHint) : words.portHint);
  const list = choices({ ...found, exits: [], ports: fits }).map(({ choice }) => choice);
  if (list.length > 1 && !isMine()) return;
  const chosen = list.length === 1 ? list[0] : await choose(words.whichPort(name), list, at);
  const port = fits.find((one) => `port ${one.name}` === chosen?.id);
  if (port) await ask.edit([{ bind: { component: onto.item, port: port.name, to: port.out ? { out: name } : { in: name } } }], {}, [port.part]);
}

/** The line from its start to the pointer, in units of the plan. */
export function newLine(): Point[] | null {
  const [drawn, now] = [drawing.value, connecting.value];
  const rect = drawn && now?.at && rectOf(drawn, now.from);
  return rect ? [centre(rect), toPlan(view.value, now.at!)] : null;
}
