// Requests of drawing, palette and inspector to the engine, with the types of the answers.
import { current, text } from "../documents/documents";
import { change, type WorkspaceEdit } from "../documents/edits";
import { spanOf } from "../plan/places";
import { offset } from "../documents/positions";
import { lsp } from "../server/session";
import { refuse } from "./say";
import type { Part, PartOf, Point } from "./shapes";
import { words } from "./words";

/** A change for `afp/edit`: one key, its name, with its fields. */
export type Change = Record<string, Record<string, unknown>>;
export type Places = Record<string, Point | null>;

/** A template or plan for new elements. */
export interface Offer {
  template: string;
  kind: "actor" | "computation" | "subplan" | "supervise";
  toolbox: string | null;
  icon: string | null;
  help: string;
  ports: string[];
  exits: string[];
  snippet: string;
  missingUse: string | null;
}

export interface Candidate {
  text: string;
  refused: string | null;
}

export interface PortAnswer {
  candidates: Candidate[];
  type: string;
  value: string | null;
  default: string | null;
  range: [string, string] | null;
  step: number | null;
  unit: string;
  units: string[];
  /** SI value of each unit. */
  scales: number[];
}

const document = (): { textDocument: { uri: string } } => ({ textDocument: { uri: current.peek() } });

const ask = <T>(method: string, params: object): Promise<T> => lsp().request<T>(method, { ...document(), ...params });

export const palette = async (query: string): Promise<Offer[]> => (await ask<Offer[] | null>("afp/palette", { query })) ?? [];

export const targets = async (item: string, outcome: string): Promise<Candidate[]> =>
  (await ask<{ candidates: Candidate[] } | null>("afp/candidates", { item, outcome }))?.candidates ?? [];

export const port = (item: string, port: string): Promise<PortAnswer | null> => ask<PortAnswer | null>("afp/candidates", { item, port });

/** The source of an item or part; empty if it has none. */
export async function written(item: string, part?: PartOf): Promise<string> {
  const range = await spanOf(current.peek(), { item, ...(part ? { part } : {}) });
  const whole = text(current.peek());
  return range ? whole.slice(offset(whole, range.start), offset(whole, range.end)) : "";
}

/** The sources of items with their comments, in source order and with their blank lines. */
export async function inOrder(items: readonly string[]): Promise<string[]> {
  const ranges = (await Promise.all(items.map((item) => spanOf(current.peek(), { item }, true)))).filter((range) => range !== null);
  const whole = text(current.peek());
  const places = ranges.map(({ start, end }) => [offset(whole, start), offset(whole, end)] as const);
  places.sort(([one], [other]) => one - other);
  const isApart = (nth: number): boolean => nth > 0 && /\n\s*\n/.test(whole.slice(places[nth - 1]![1], places[nth]![0]));
  return places.map(([from, to], nth) => `${isApart(nth) ? "\n" : ""}${whole.slice(from, to)}`);
}

/** The help text before an item; empty if it has none. */
export async function help(item: string): Promise<string> {
  const range = await spanOf(current.peek(), { item });
  if (!range) return "";
  const whole = text(current.peek());
  const start = offset(whole, range.start);
  const above = whole.slice(0, start).split("\n").slice(0, -1).reverse();
  const end = above.findIndex((line) => !line.trim().startsWith("///"));
  const lines = end < 0 ? above : above.slice(0, end);
  // A span may begin with its help.
  const own = whole.slice(start).split("\n");
  const first = own.findIndex((line) => !line.trim().startsWith("///"));
  return [...lines.reverse(), ...own.slice(0, Math.max(first, 0))].map((line) => line.trim().replace(/^\/\/\/ ?/, "")).join("\n");
}

/** The note (comment) before an item; empty if it has none. */
export async function note(item: string): Promise<string> {
  const range = await spanOf(current.peek(), { item });
  if (!range) return "";
  const lines = text(current.peek()).split("\n").slice(0, range.start.line).map((line) => line.trim()).reverse();
  const help = lines.findIndex((line) => !line.startsWith("///"));
  const above = help < 0 ? [] : lines.slice(help);
  const end = above.findIndex((line) => !/^\/\/(?!\/)/.test(line));
  return (end < 0 ? above : above.slice(0, end)).reverse().map((line) => line.replace(/^\/\/ ?/, "")).join("\n");
}

interface Made {
  label: string;
  edit: WorkspaceEdit;
  select: string[];
  names: Record<string, string>;
}

/**
 * Applies changes as one history entry, and selects the new items or `chosen`. A rejection is shown
 * and returns null.
 */
export async function edit(changes: Change[], places: Places = {}, chosen?: Part[]): Promise<string[] | null> {
  return attempt(() => ask<Made>("afp/edit", { changes, places }), chosen);
}

/** Pastes items into a plan, or supervisors into an element. */
export const paste = (plan: string, owner: string | null, text: string, at: Point | null): Promise<string[] | null> =>
  attempt(() => ask<Made>("afp/paste", { plan, text, ...(owner ? { owner } : {}), ...(at ? { at } : {}) }));

/** Positions before texts, so that a new item appears at its final place. */
function placed(edit: WorkspaceEdit): WorkspaceEdit {
  const rank = (change: NonNullable<WorkspaceEdit["documentChanges"]>[number]): number =>
    "kind" in change ? 0 : change.textDocument.uri.endsWith(".layout") ? 1 : 2;
  const documentChanges = edit.documentChanges?.slice().sort((one, two) => rank(one) - rank(two));
  return documentChanges ? { ...edit, documentChanges } : edit;
}

async function attempt(make: () => Promise<Made>, chosen?: Part[]): Promise<string[] | null> {
  let added: string[] = [];
  waits();
  try {
    await change(async () => {
      const { label, edit, select } = await make();
      added = select;
      const parts = chosen ?? select.map((item) => ({ item }));
      return { label, edit: placed(edit), ...(parts.length ? { select: parts } : {}) };
    });
    return added;
  } catch (why) {
    refuse(why);
    return null;
  }
}

/** The reason why changes would be rejected; null if accepted. */
export const refused = (changes: Change[]): Promise<string | null> =>
  ask<Made>("afp/edit", { changes }).then(() => null, (why: Error) => why.message);

/** Reports that a change waits for the connection. */
function waits(): void {
  if (!lsp().open.peek()) refuse(words.waits);
}

/**
 * Writes positions of elements; null resets one to the automatic layout. Returns false if rejected.
 */
export async function place(places: Places, label: string): Promise<boolean> {
  waits();
  try {
    await change(async () => ({ label, edit: await ask<WorkspaceEdit>("afp/place", { places }) }));
    return true;
  } catch (why) {
    refuse(why);
    return false;
  }
}
