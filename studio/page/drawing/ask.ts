// Requests of drawing, palette and inspector to the engine, with the types of the answers.
import { current } from "../documents/documents";
import { change, type WorkspaceEdit } from "../documents/edits";
import type { Position } from "../documents/positions";
import { lsp } from "../server/session";
import { refuse } from "./say";
import type { Part, Point } from "./shapes";
import { words } from "./words";

/** A change for `afp/edit`: one key, its name, with its fields. */
export type Change = Record<string, Record<string, unknown>>;
export type Places = Record<string, Point | null>;

/** A template or plan for new elements. */
export interface Offer {
  template: string;
  /** The usual name of a new item. */
  name: string;
  kind: "actor" | "computation" | "subplan" | "supervise";
  toolbox: string | null;
  icon: string | null;
  help: string;
  ports: string[];
  exits: string[];
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
  /** Whether a run accepts values for the entry. */
  writable?: boolean;
  reading: Reading;
}

/** A text in the field of a value, as the engine reads it. */
export interface Reading {
  text: string;
  /** Null for another formula. */
  number: number | null;
  unit: string;
  step: number | null;
  /** The ends of a slider. */
  slider: [least: number, most: number] | null;
  /** Whether an operation waits for its right operand. */
  pending: boolean;
}

/** A control next to a value, which changes its text. */
export type Control = "more" | "less" | "negate" | { number: number } | { unit: string } | { operation: string } | { operand: string };

/** A value: the port of a component, or an entry of a file. */
export interface Valued {
  uri?: string;
  item: string;
  port?: string;
}

const document = (): { textDocument: { uri: string } } => ({ textDocument: { uri: current.peek() } });

const ask = <T>(method: string, params: object): Promise<T> => lsp().request<T>(method, { ...document(), ...params });

export const palette = async (query: string): Promise<Offer[]> => (await ask<Offer[] | null>("afp/palette", { query })) ?? [];

export const targets = async (item: string, outcome: string): Promise<Candidate[]> =>
  (await ask<{ candidates: Candidate[] } | null>("afp/candidates", { item, outcome }))?.candidates ?? [];

/** A value with its candidates; `text` replaces it, and `control` then changes the text. */
export const value = ({ uri, ...of }: Valued, text?: string, control?: Control): Promise<PortAnswer | null> =>
  ask<PortAnswer | null>("afp/candidates", { ...of, text, control, ...(uri ? { textDocument: { uri } } : {}) });

/** The parts of an item, as `afp/parts` returns them. */
export interface Parts {
  /** The keyword of an element or supervisor; empty for another item. */
  kind: string;
  template: string;
  templateAt: Position | null;
  ports: { name: string; out: boolean; answer: PortAnswer | null }[];
  exits: { name: string; to: string }[];
  timing: { every: string; deadline: string } | null;
  help: string;
  note: string;
  computation: Computation | null;
  types: string[];
}

/** A computation that the file declares. The condition of the last state is null. */
export interface Computation {
  name: string;
  states: { name: string; condition: string | null; writes: [output: string, formula: string][] }[];
}

export const parts = (item: string): Promise<Parts | null> => ask<Parts | null>("afp/parts", { item });

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

/** Items as text, with the `use` lines and the start that they need. */
export const copied = async (items: readonly string[]): Promise<string> => (await ask<{ text: string }>("afp/copy", { items })).text;

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
