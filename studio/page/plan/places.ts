// Places of the text and items of the plan, each found by the other, so that cursor and selection go together.
import { effect, signal } from "@preact/signals";
import { current, isOpen, open } from "../documents/documents";
import type { Position, Range } from "../documents/positions";
import { lsp } from "../server/session";
import type { Part } from "../drawing/shapes";
import { origin, select, selected, type Origin } from "./selection";

/**
 * The place where the text pane puts its cursor, or that it scrolls into view: set by selections
 * elsewhere, used by the pane.
 */
export const shown = signal<{ uri: string; range: Range; focus: boolean; stays?: boolean } | null>(null);

/** The item at a place of the text. */
export const itemAt = (uri: string, position: Position): Promise<Part | null> =>
  lsp().request<Part | null>("afp/itemAt", { textDocument: { uri }, position });

/** The place of an item, or of a part of it; of an item with the comments that belong to it, where they are wanted. */
export const spanOf = (uri: string, { item, part }: Part, comments = false): Promise<Range | null> =>
  lsp().request<Range | null>("afp/spanOf", { textDocument: { uri }, item, comments, ...(part ? { part } : {}) });

/** Something of the folder that has a name. */
export interface Named {
  name: string;
  /** Its parent. */
  container: string;
  uri: string;
  range: Range;
}

/** Every plan, element and entry of the folder, plans first. */
export async function symbols(): Promise<Named[]> {
  type Symbol = { name: string; kind: number; containerName?: string | null; location: { uri: string; range: Range } };
  const all = (await lsp().request<Symbol[] | null>("workspace/symbol", { query: "" })) ?? [];
  const rank = [CLASS, FUNCTION, VARIABLE];
  const known = all.filter(({ kind }) => rank.includes(kind)).sort((one, two) => rank.indexOf(one.kind) - rank.indexOf(two.kind));
  return known.map(({ name, containerName, location }) => ({ name, container: containerName ?? "", ...location }));
}

/** The protocol's numbers of what plans, elements and entries are. */
const [CLASS, FUNCTION, VARIABLE] = [5, 12, 13];

/** Shows a place in the text, and its item in the drawing. */
export async function reveal(uri: string, range: Range, from: Origin, focus = false): Promise<void> {
  if (!isOpen(uri)) await open(uri);
  if (uri.endsWith(".afp")) current.value = uri;
  shown.value = { uri, range, focus };
  const found = await itemAt(uri, range.start).catch(() => null);
  if (found) select([found], from);
}

/** Shows a place of a text that is open. The cursor of who writes in the text stays: the next letter goes where it was. */
export async function point(uri: string, range: Range): Promise<void> {
  if (!document.activeElement?.closest(".cm-content")) return reveal(uri, range, "other");
  shown.value = { uri, range, focus: false, stays: true };
  const found = await itemAt(uri, range.start).catch(() => null);
  if (found) select([found], "text");
}

/** The cursor of the text was moved by a person: the selection follows, once it rests. */
let resting: ReturnType<typeof setTimeout>;
export function cursorAt(uri: string, position: Position): void {
  clearTimeout(resting);
  resting = setTimeout(async () => {
    const found = await itemAt(uri, position).catch(() => null);
    if (found && current.peek() === uri) select([found], "text");
  }, 80);
}

/** Begins to move the cursor where something is selected in the drawing. */
export function begin(): void {
  effect(() => {
    const last = selected.value.at(-1);
    const uri = current.peek();
    if (!last || origin.peek() === "text" || !uri) return;
    spanOf(uri, last)
      .then((range) => {
        if (range && selected.peek().at(-1) === last) shown.value = { uri, range, focus: false };
      })
      .catch(() => {});
  });
}
