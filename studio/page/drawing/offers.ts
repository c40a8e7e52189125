// Templates as texts and changes.
import type { Change, Offer } from "./ask";
import type { Choice } from "./choose";
import { nameOf, planOf, type Drawing, type Edge, type Part } from "./shapes";
import { words } from "./words";

/** Names of the plan's items. */
export function taken(drawing: Drawing): Set<string> {
  const pieces = [...drawing.elements.values()].flatMap((element) => element.pieces);
  return new Set([...pieces.map((piece) => piece.item), ...drawing.entries.map((entry) => entry.item)].map(nameOf));
}

/**
 * A free name for an item of a template: the engine would apply later references of a taken name to
 * the new item.
 */
export function freeName({ name: wished }: Offer, taken: ReadonlySet<string> = new Set()): string {
  let name = wished;
  for (let nth = 2; taken.has(name); nth++) name = `${wished}${nth}`;
  return name;
}

/** The change that imports the toolbox. */
export const using = (offer: Offer): Change[] => (offer.missingUse ? [{ addUse: { toolbox: offer.missingUse } }] : []);

/** The path of a new item of a plan or element. */
export const pathOf = (plan: string, owner: string | null, name: string): string => (owner ? `${plan}.${owner}.${name}` : `${plan}.${name}`);

/** The change that connects an exit, or the start, to an element or a keyword. */
export const leading = (from: Part, to: string): Change =>
  from.part?.kind === "start"
    ? { setStart: { plan: planOf(from.item), to } }
    : { connect: { from: from.item, outcome: from.part?.name ?? "", to } };

/** Adds an item, and connects an exit to it. */
export function added(plan: string, owner: string | null, offer: Offer, from: Part | null, names?: ReadonlySet<string>): Change[] {
  const name = freeName(offer, names);
  const addComponent = { plan, owner, keyword: offer.kind, name, template: offer.template };
  return [...using(offer), { addComponent }, ...(from ? [leading(from, name)] : [])];
}

/** Adds an element between the ends of an edge. */
export function between(plan: string, offer: Offer, edge: Edge, names?: ReadonlySet<string>): Change[] {
  const from: Part = { item: edge.from, part: edge.part };
  const name = freeName(offer, names);
  const on = offer.exits[0];
  const leads = on === undefined ? [] : [{ connect: { from: pathOf(plan, null, name), outcome: on, to: nameOf(edge.to) } }];
  return [...added(plan, null, offer, from, names), ...leads];
}

export const choice = (offer: Offer, label = offer.template): Choice => ({
  id: `new ${offer.toolbox ?? ""}.${offer.template}`,
  label,
  hint: offer.help.split("\n")[0] ?? "",
  icon: offer.icon,
});

/** Offers of elements: possible next elements and starts. */
export const ofElements = (offers: readonly Offer[]): Offer[] => offers.filter((offer) => offer.kind !== "supervise");

/** Offers in their order, but those that the plan uses most come first. */
export function usedFirst(offers: readonly Offer[], drawing: Drawing): Offer[] {
  const used = [...drawing.elements.values()].map((element) => element.template);
  const count = (offer: Offer): number => used.filter((template) => template === offer.template).length;
  return [...offers].sort((one, other) => count(other) - count(one));
}

/** A target among candidates, for a list. */
export function target({ text, refused }: { text: string; refused: string | null }): Choice {
  const known: Record<string, [string, string]> = {
    terminate: [words.end, words.endHint],
    fail: [words.fail, words.failHint],
    ignore: [words.goOn, words.goOnHint],
  };
  const [label, hint] = known[text] ?? [text, ""];
  return { id: text, label, hint, refused };
}
