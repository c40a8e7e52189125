// Maps source positions to items and back, to keep cursor and selection in sync.
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

/** The item at a source position. */
export const itemAt = (uri: string, position: Position): Promise<Part | null> =>
  lsp().request<Part | null>("afp/itemAt", { textDocument: { uri }, position });

/** The source range of an item or part; optionally with its comments. */
export const spanOf = (uri: string, { item, part }: Part, comments = false): Promise<Range | null> =>
  lsp().request<Range | null>("afp/spanOf", { textDocument: { uri }, item, comments, ...(part ? { part } : {}) });

/** A named item of the folder. */
export interface Named {
  name: string;
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

/** The protocol's symbol kinds of plans, elements and entries. */
const [CLASS, FUNCTION, VARIABLE] = [5, 12, 13];

/** Shows a place in the text, and its item in the drawing. */
export async function reveal(uri: string, range: Range, from: Origin, focus = false): Promise<void> {
  if (!isOpen(uri)) await open(uri);
  if (uri.endsWith(".afp")) current.value = uri;
  shown.value = { uri, range, focus };
  const found = await itemAt(uri, range.start).catch(() => null);
  if (found) select([found], from);
}

/** Shows a place of an open text. The cursor of a typing user stays. */
export async function point(uri: string, range: Range): Promise<void> {
  if (!document.activeElement?.closest(".cm-content")) return reveal(uri, range, "other");
  shown.value = { uri, range, focus: false, stays: true };
  const found = await itemAt(uri, range.start).catch(() => null);
  if (found) select([found], "text");
}

/** After the user moves the cursor, the selection follows with a delay. */
let resting: ReturnType<typeof setTimeout>;
export function cursorAt(uri: string, position: Position): void {
  clearTimeout(resting);
  resting = setTimeout(async () => {
    const found = await itemAt(uri, position).catch(() => null);
    if (found && current.peek() === uri) select([found], "text");
  }, 80);
}

/** Starts to move the cursor to selections in the drawing. */
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
