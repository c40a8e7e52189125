// The texts of the page: opened from the room, changed in one place, told to the server, said to be saved by it alone.
import { computed, signal } from "@preact/signals";
import { difference, inOrder, type TextEdit } from "./changes";
import { conflicts, dispute, settle, type Keep } from "./conflicts";
import { attach, clear, push, record, type Change, type Step } from "./history";
import { LOST, Refused, type Lsp } from "./lsp";
import { position, type Range } from "./positions";
import type { Part } from "./drawing/shapes";
import { select } from "./selection";
import { files, lsp, pen, type Kept } from "./session";
import { words } from "./words";

export interface WorkspaceEdit {
  documentChanges?: (
    | { kind: "create"; uri: string }
    | { textDocument: { uri: string; version: number | null }; edits: TextEdit[] }
  )[];
  changes?: Record<string, TextEdit[]>;
}

interface Document extends Kept {
  /** The last version that the room has written. */
  written: number;
  /** The text of that version. */
  base: string;
  failed: string | null;
}

type Taker = (uri: string, changes: Change[], maker: Maker, told: Told[]) => void;

/** Who brought a change about, so that it is not told what it knows. */
export type Maker = "text" | "outside" | "page";

const documents = signal<ReadonlyMap<string, Document>>(new Map());
const opening = new Map<string, Promise<void>>();
/** A change as the server is told it: lines and columns of the text as it was right before. */
export interface Told {
  range: Range;
  text: string;
}

const takers = new Set<Taker>();

/** Texts that the server was told since the one that is known to be written: it may have written any of them. */
const told = new Map<string, string[]>();
/** So many of them are kept. */
const MOST_TOLD = 256;

/** The address of the plan file that is shown; empty without one. */
export const current = signal("");

/** What the server says of the texts: all written, being written, not before somebody has chosen, or why one is not. */
export const saved = computed<"saved" | "saving" | "disputed" | (string & {})>(() => {
  const all = [...documents.value.values()];
  const failed = all.find((each) => each.failed !== null);
  if (failed) return failed.failed!;
  if (conflicts.value.length > 0) return "disputed";
  return all.every(isWritten) ? "saved" : "saving";
});

const isWritten = (document: Document): boolean => document.written >= document.version;

/** Whether something could not be written; then it says why. */
export const isFailed = (state: string): boolean => !["saved", "saving", "disputed"].includes(state);

/** The texts that lie nowhere but here, as far as known. */
export const unsent = computed<readonly { uri: string; text: string }[]>(() => {
  const open = [...documents.value.values()].filter((document) => !isWritten(document));
  const asked = conflicts.value.flatMap(({ uri, mine }) => (mine === null ? [] : [{ uri, text: mine }]));
  return [...asked, ...open.map(({ uri, text }) => ({ uri, text }))];
});

/** The addresses of the texts that are open. */
export const opened = computed<readonly string[]>(() => [...documents.value.keys()]);

export const text = (uri: string): string => documents.value.get(uri)?.text ?? "";
export const version = (uri: string): number => documents.value.get(uri)?.version ?? 0;
export const isOpen = (uri: string): boolean => documents.value.has(uri);
/** What people call a document: its path from the root of the folder. */
export const nameOf = (uri: string): string =>
  files.value.find((file) => file.uri === uri)?.name ?? decodeURIComponent(uri.split("/").at(-1) ?? uri);

/** Hears of every change of a text, after it was made; the answer ends that. */
export function onText(take: Taker): () => void {
  takers.add(take);
  return () => takers.delete(take);
}

const put = (document: Document): void => {
  documents.value = new Map(documents.value).set(document.uri, document);
};

/** Opens a document, unless it is open. A file that is not there yet is empty. */
export function open(uri: string): Promise<void> {
  const before = opening.get(uri);
  if (before) return before;
  const read = lsp().request<Kept>("afp/read", { uri }).then(take);
  opening.set(uri, read);
  read.catch(() => opening.delete(uri));
  return read;
}

/** Makes a file that is not there yet, and opens it. */
export async function create(what: { uri: string; text: string } | { uri: string; example: string }): Promise<void> {
  take(await lsp().request<Kept>("afp/create", what));
  opening.set(what.uri, Promise.resolve());
}

function take(kept: Kept): void {
  put({ ...kept, written: kept.version, base: kept.text, failed: null });
  const { uri, version, text } = kept;
  lsp().notify("textDocument/didOpen", { textDocument: { uri, languageId: "afp", version, text } });
}

/** Makes changes one after the other, tells everybody who shows a text, and the server unless it knows. */
function make(changes: Change[], maker: Maker = "page", tell = true): Step[] {
  const steps: Step[] = [];
  const made = new Map<string, Told[]>();
  for (const { uri, from, to, insert } of changes) {
    const document = documents.peek().get(uri);
    if (!document) continue;
    const before = document.text;
    const range = { start: position(before, from), end: position(before, to) };
    made.set(uri, [...(made.get(uri) ?? []), { range, text: insert }]);
    put({ ...document, text: before.slice(0, from) + insert + before.slice(to) });
    steps.push({ uri, from, removed: before.slice(from, to), inserted: insert });
  }
  for (const [uri, contentChanges] of made) {
    if (tell) {
      const version = documents.peek().get(uri)!.version + 1;
      put({ ...documents.peek().get(uri)!, version });
      lsp().notify("textDocument/didChange", { textDocument: { uri, version }, contentChanges });
      if (lsp().open.peek()) told.set(uri, [...(told.get(uri) ?? []), text(uri)].slice(-MOST_TOLD));
    }
    const own = changes.filter((change) => change.uri === uri);
    takers.forEach((take) => take(uri, own, maker, contentChanges));
  }
  return steps;
}

/** Makes an edit of the server as one entry of the history. Throws where it was made for another version. */
export async function apply(edit: WorkspaceEdit, label: string, chosen?: Part[]): Promise<void> {
  if (!pen.value) throw new Refused(0, words.watching);
  const listed = edit.documentChanges ?? Object.entries(edit.changes ?? {}).map(edited);
  const uris = listed.map((each) => ("kind" in each ? each.uri : each.textDocument.uri));
  await Promise.all(uris.map(open));
  const changes: Change[] = [];
  for (const each of listed) {
    if ("kind" in each) continue;
    const { uri, version: wanted } = each.textDocument;
    if (wanted !== null && wanted !== version(uri)) throw new Stale();
    changes.push(...inOrder(uri, text(uri), each.edits));
  }
  push({ label, changes, ...(chosen ? { select: chosen } : {}) });
}

const edited = ([uri, edits]: [string, TextEdit[]]) => ({ textDocument: { uri, version: null }, edits });

/** An edit is for a text that has changed meanwhile: it is to be asked for again. */
export class Stale extends Error {}

/** Asks for an edit and makes it, again where the text has changed meanwhile. */
export async function change(ask: () => Promise<{ edit: WorkspaceEdit; label: string; select?: Part[] } | null>): Promise<void> {
  for (let attempt = 0; attempt < 4; attempt++) {
    const found = await asked(ask);
    if (!found) return;
    try {
      return await apply(found.edit, found.label, found.select);
    } catch (why) {
      if (!(why instanceof Stale)) throw why;
    }
  }
}

/** Asks once more where the connection was lost before the answer: an edit is computed by the server and made here. */
async function asked<T>(ask: () => Promise<T>): Promise<T> {
  try {
    return await ask();
  } catch (why) {
    if (why instanceof Refused && why.code === LOST) return ask();
    throw why;
  }
}

/** Takes over what was typed in the text pane. Changes are made one after the other. */
export function typed(changes: Change[]): void {
  const steps = make(changes, "text");
  const label = steps.every((step) => step.inserted === "") ? words.deleting : words.typing;
  record({ label, steps, ...(steps.length === 1 ? { typed: Date.now() } : {}) });
}

/** Connects texts, history and server, with no text open; `ask` puts a question with choices and gives the chosen one. */
export function begin(ask: (title: string, body: string, choices: string[]) => Promise<string | null>): void {
  documents.value = new Map();
  opening.clear();
  attach({
    make,
    select: (parts) => select(parts, "other"),
    agree: async (label) => (await ask(words.undoForeign, words.undoForeignBody(label), [words.undoIt])) === words.undoIt,
  });
  lsp().on("afp/saved", ({ uri, version, failed }) => {
    const document = documents.peek().get(uri);
    if (!document) return;
    const base = version === document.version ? document.text : document.base;
    if (!failed && version === document.version) told.delete(uri);
    put(failed ? { ...document, failed } : { ...document, written: Math.max(document.written, version), base, failed: null });
  });
  lsp().on("afp/changed", ({ uri, text: now, clean }: { uri: string; text: string; clean: boolean }) => {
    if (!documents.peek().has(uri)) return;
    if (clean) {
      settle(uri);
      return arrived(uri, now);
    }
    const choose = async (keep: Keep): Promise<void> => {
      chosen.set(uri, keep);
      await lsp().request<void>("afp/choose", { uri, keep }).catch((why) => {
        chosen.delete(uri);
        throw why;
      });
    };
    if (pen.value) dispute({ uri, choices: ["mine", "theirs", "both"], mine: null, choose });
  });
  lsp().on("afp/pen", hold);
}

/** What was chosen here, while the text that comes of it is on its way. */
const chosen = new Map<string, Keep>();

function hold({ yours }: { yours: boolean }): void {
  // Who begins to change things begins a history of his own.
  if (yours && !pen.peek()) clear();
  pen.value = yours;
}

/** Begins to change things here; who did it before watches. */
export async function takePen(): Promise<void> {
  hold(await lsp().request("afp/pen", { take: true }));
}

/** Asks whether a text that was written here, and lies nowhere else, takes the place of the one that is shown. */
export function offer(uri: string, mine: string): void {
  const choose = async (keep: Keep): Promise<void> => {
    if (keep !== "mine") return;
    if (!pen.peek()) await takePen();
    push({ label: words.keep.mine, changes: difference(uri, text(uri), mine) });
  };
  dispute({ uri, choices: ["mine", "theirs"], mine, choose });
}

/** Takes over a text of the room. What was saved here is so still: theirs lies in the file. */
function arrived(uri: string, now: string, tell = true): void {
  const { text: before, written, version } = documents.peek().get(uri)!;
  const own = chosen.get(uri);
  chosen.delete(uri);
  const steps = before === now ? [] : make(difference(uri, before, now), "outside", tell);
  if (own) record({ label: words.keep[own], steps });
  else record({ label: words.changedOutside(nameOf(uri)), steps, foreign: true });
  const document = documents.peek().get(uri)!;
  put({ ...document, written: written >= version ? document.version : written, base: now, failed: null });
}

/** On a new connection: opens everything again, and sends what the server was not told. */
export async function again(first: Lsp): Promise<void> {
  for (const uri of documents.peek().keys()) {
    const { text: theirs, etag } = await first.request<Kept>("afp/read", { uri });
    const { text: mine, base, version: before } = documents.peek().get(uri)!;
    const version = before + 1;
    // What was killed may have written more than it could say.
    const ours = theirs === base || told.get(uri)?.includes(theirs);
    told.delete(uri);
    first.notify("textDocument/didOpen", { textDocument: { uri, languageId: "afp", version, text: theirs } });
    put({ ...documents.peek().get(uri)!, version, written: version, etag, base: theirs, failed: null });
    if (ours && mine !== theirs && pen.peek()) {
      first.notify("textDocument/didChange", { textDocument: { uri, version: version + 1 }, contentChanges: [{ text: mine }] });
      put({ ...documents.peek().get(uri)!, version: version + 1 });
    } else if (theirs !== mine) {
      arrived(uri, theirs, false);
      if (mine !== base) offer(uri, mine);
    }
  }
}
