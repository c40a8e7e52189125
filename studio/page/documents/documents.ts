// The page's texts: opened from the room, changed in one place, sent to the server, saved only by
// it.
import type { ChangeSet } from "@codemirror/state";
import { computed, signal } from "@preact/signals";
import { difference, withNewlines } from "./changes";
import { conflicts, dispute, settle, type Keep } from "./conflicts";
import { attach, clear, push, record, type Change, type Step } from "./history";
import { tooLong } from "./limit";
import { LOST, Refused, type Finish, type Lsp } from "../server/lsp";
import * as pending from "./pending";
import { position, type Range } from "./positions";
import { select } from "../plan/selection";
import { files, lsp, pen, type Kept } from "../server/session";
import { words } from "../words";

interface Document extends Kept {
  /** The last version that the room has written. */
  written: number;
  /** The changes since the room's last known text. */
  pending: pending.Pending;
  failed: string | null;
}

type Taker = (uri: string, changes: Change[], maker: Maker, told: Told[]) => void;

/** The author of a change, who is not notified of it. */
export type Maker = "text" | "outside" | "page";

const documents = signal<ReadonlyMap<string, Document>>(new Map());
const opening = new Map<string, Promise<void>>();
/** A change for the server, positioned in the text before it. */
export interface Told {
  range: Range;
  text: string;
}

const takers = new Set<Taker>();

/** Address of the displayed plan file; empty without one. */
export const current = signal("");

/** State of the texts: saved, being saved, waiting for a choice, or an error message. */
export const saved = computed<"saved" | "saving" | "disputed" | (string & {})>(() => {
  const all = [...documents.value.values()];
  const failed = all.find((each) => each.failed !== null);
  if (failed) return failed.failed!;
  if (conflicts.value.length > 0) return "disputed";
  return all.every(isWritten) ? "saved" : "saving";
});

const isWritten = (document: Document): boolean => document.written >= document.version;

/** Whether a write failed; the state is then an error message. */
export const isFailed = (state: string): boolean => !["saved", "saving", "disputed"].includes(state);

/** Texts that exist only in this page, as far as known. */
export const unsent = computed<readonly { uri: string; text: string }[]>(() => {
  const open = [...documents.value.values()].filter((document) => !isWritten(document));
  const asked = conflicts.value.flatMap(({ uri, mine }) => (mine === null ? [] : [{ uri, text: mine }]));
  return [...asked, ...open.map(({ uri, text }) => ({ uri, text }))];
});

/** Addresses of the open texts. */
export const opened = computed<readonly string[]>(() => [...documents.value.keys()]);

export const text = (uri: string): string => documents.value.get(uri)?.text ?? "";
export const version = (uri: string): number => documents.value.get(uri)?.version ?? 0;
export const isOpen = (uri: string): boolean => documents.value.has(uri);
/** The display name of a document: its path relative to the folder. */
export const nameOf = (uri: string): string =>
  files.value.find((file) => file.uri === uri)?.name ?? decodeURIComponent(uri.split("/").at(-1) ?? uri);

/** Subscribes to text changes; returns a function that ends it. */
export function onText(take: Taker): () => void {
  takers.add(take);
  return () => takers.delete(take);
}

const put = (document: Document): void => {
  documents.value = new Map(documents.value).set(document.uri, document);
};

/** Opens a document, unless open. A missing file is empty. */
export function open(uri: string): Promise<void> {
  const before = opening.get(uri);
  if (before) return before;
  const read = lsp().request<Kept>("afp/read", { uri }).then(take);
  opening.set(uri, read);
  read.catch(() => opening.delete(uri));
  return read;
}

/**
 * Creates a file and opens it. If the file was open and another program has removed it, the room
 * sends the new text.
 */
export async function create(what: { uri: string; text: string } | { uri: string; example: string }): Promise<void> {
  const { uri } = what;
  const before = documents.peek().has(uri);
  if (before) expected.set(uri, words.made(nameOf(uri)));
  const kept = await lsp().request<Kept>("afp/create", what).catch((why) => {
    expected.delete(uri);
    throw why;
  });
  if (!before) take(kept);
  else if (kept.text === text(uri)) expected.delete(uri);
  opening.set(uri, Promise.resolve());
}

/** Closes a document whose file was removed or renamed. */
export function forget(uri: string): void {
  const rest = new Map(documents.peek());
  if (rest.delete(uri)) lsp().notify("textDocument/didClose", { textDocument: { uri } });
  documents.value = rest;
  opening.delete(uri);
}

function take(kept: Kept): void {
  put({ ...kept, written: kept.version, pending: pending.known(kept.text), failed: null });
  const { uri, version, text } = kept;
  lsp().notify("textDocument/didOpen", { textDocument: { uri, languageId: "afp", version, text } });
}

/** Reports changes of a text to the server. */
type Say = (uri: string, told: Told[], changes: ChangeSet) => void;

/**
 * Applies changes in order and notifies the server and all listeners. Applies nothing if a text
 * would get too long.
 */
function make(changes: Change[], maker: Maker = "page", say: Say = own): Step[] {
  const all = documents.peek();
  const steps: Step[] = [];
  const made = new Map<string, { before: string; told: Told[]; changes: Change[] }>();
  for (const change of changes) {
    const { uri, from, to } = change;
    const document = documents.peek().get(uri);
    if (!document) continue;
    const before = document.text;
    const insert = withNewlines(change.insert);
    const one = made.get(uri) ?? { before, told: [], changes: [] };
    one.told.push({ range: { start: position(before, from), end: position(before, to) }, text: insert });
    one.changes.push({ uri, from, to, insert });
    made.set(uri, one);
    put({ ...document, text: before.slice(0, from) + insert + before.slice(to) });
    steps.push({ uri, from, removed: before.slice(from, to), inserted: insert });
  }
  for (const [uri, { before }] of made) {
    const why = maker === "outside" ? null : tooLong(before.length, text(uri));
    if (why === null) continue;
    documents.value = all;
    throw new Error(why);
  }
  for (const [uri, { before, told, changes }] of made) {
    say(uri, told, pending.together(changes, before.length));
    takers.forEach((take) => take(uri, changes, maker, told));
  }
  return steps;
}

/** Sends local changes to the server, or after a reconnection. */
const own: Say = (uri, told, changes) => {
  const version = tell(lsp(), uri, told);
  const document = documents.peek().get(uri)!;
  if (lsp().open.peek()) put({ ...document, pending: pending.told(document.pending, version, changes) });
};

/** Approximate overhead of a change in a message, in characters. */
const AROUND = 100;
/** Number of characters up to which changes are always sent. */
const FEW = 100_000;

/**
 * Sends the next version of a text and returns its number. `taken` is the number of the included
 * room change. For many changes, sends the shorter whole text.
 */
function tell(to: Lsp, uri: string, changes: readonly { range?: Range; text: string }[], taken?: number): number {
  const document = documents.peek().get(uri)!;
  const version = document.version + 1;
  put({ ...document, version });
  const length = changes.reduce((sum, { text }) => sum + text.length + AROUND, 0);
  const contentChanges = length > document.text.length + FEW ? [{ text: document.text }] : changes;
  to.notify("textDocument/didChange", { textDocument: { uri, version }, contentChanges, ...(taken === undefined ? {} : { taken }) });
  return version;
}

/** Applies typing from the text pane, in order. */
export function typed(changes: Change[]): void {
  const steps = make(changes, "text");
  const label = steps.every((step) => step.inserted === "") ? words.deleting : words.typing;
  record({ label, steps, ...(steps.length === 1 ? { typed: Date.now() } : {}) });
}

/**
 * Connects texts, history and server, without open texts; `ask` shows a question and returns the
 * choice.
 */
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
    const written = { written: Math.max(document.written, version), pending: pending.reached(document.pending, version), failed: null };
    put({ ...document, ...(failed ? { failed } : written) });
  });
  lsp().on("afp/changed", ({ uri, text: now, clean, version, number }: { uri: string; text: string; clean: boolean; version: number; number: number }) => {
    if (!documents.peek().has(uri)) return;
    if (clean) {
      settle(uri);
      return arrived(uri, now, version, number);
    }
    const choose = async (keep: Keep): Promise<void> => {
      expected.set(uri, words.keep[keep]);
      await lsp().request<void>("afp/choose", { uri, keep }).catch((why) => {
        expected.delete(uri);
        throw why;
      });
    };
    if (pen.value) dispute({ uri, choices: ["mine", "theirs", "both"], mine: null, choose });
  });
  lsp().on("afp/pen", hold);
}

/** The local change whose text is expected from the room. */
const expected = new Map<string, string>();

function hold({ yours }: { yours: boolean }): void {
  // A new editing client begins with an empty history.
  if (yours && !pen.peek()) clear();
  pen.value = yours;
}

/** Takes the edit lock; the previous holder becomes read-only. */
export async function takePen(): Promise<void> {
  hold(await lsp().request("afp/pen", { take: true }));
}

/** Asks whether a text that exists only here replaces the displayed one. */
export function offer(uri: string, mine: string): void {
  const choose = async (keep: Keep): Promise<void> => {
    if (keep !== "mine") return;
    if (!pen.peek()) await takePen();
    push({ label: words.keep.mine, changes: difference(uri, text(uri), mine) });
  };
  dispute({ uri, choices: ["mine", "theirs"], mine, choose });
}

/** Applies a text of the room that is based on a known version. A text saved here stays saved. */
function arrived(uri: string, now: string, seen: number, number: number): void {
  const before = documents.peek().get(uri)!;
  const [rest, changes] = pending.arrived(uri, before.pending, seen, now);
  put({ ...before, pending: rest });
  const say: Say = (uri, told) => void tell(lsp(), uri, told, number);
  takeOver(uri, changes, say);
  // The room waits for an acknowledgement, even without a change.
  if (changes.length === 0) tell(lsp(), uri, [], number);
  const { written, version } = before;
  const document = documents.peek().get(uri)!;
  put({ ...document, written: written >= version ? document.version : written, failed: null });
}

/** Applies changes of the room as a history entry. */
function takeOver(uri: string, changes: Change[], say: Say): void {
  const label = expected.get(uri);
  expected.delete(uri);
  const steps = make(changes, "outside", say);
  if (label !== undefined) record({ label, steps });
  else record({ label: words.changedOutside(nameOf(uri)), steps, foreign: true });
}

/** After a reconnection, reads all open texts again, reopens them and sends pending changes. */
export async function again(first: Lsp): Promise<Finish> {
  const uris = [...documents.peek().keys()];
  const all = await Promise.all(uris.map((uri) => first.request<Kept>("afp/read", { uri }).catch(refused)));
  // All at once, since later typing is sent as usual.
  return () => all.forEach((kept, at) => reopen(first, uris[at]!, kept));
}

/** The reason why a text cannot be read; other errors are rethrown. */
function refused(why: unknown): Refused {
  if (why instanceof Refused && why.code !== LOST) return why;
  throw why;
}

function reopen(first: Lsp, uri: string, kept: Kept | Refused): void {
  const before = documents.peek().get(uri)!;
  // The other texts continue; this one is reported as not saved.
  if (kept instanceof Refused) return put({ ...before, failed: kept.message });
  const { text: theirs, etag } = kept;
  const mine = before.text;
  const version = before.version + 1;
  first.notify("textDocument/didOpen", { textDocument: { uri, languageId: "afp", version, text: theirs } });
  put({ ...before, version, written: version, etag, pending: pending.known(theirs), failed: null });
  if (mine === theirs) return;
  // A killed job may have written more than it reported.
  if (pen.peek() && pending.mayBe(before.pending, theirs)) {
    const version = tell(first, uri, [{ text: mine }]);
    const changes = pending.together(difference(uri, theirs, mine), theirs.length);
    put({ ...documents.peek().get(uri)!, pending: pending.told(pending.known(theirs), version, changes) });
  } else {
    takeOver(uri, difference(uri, mine, theirs), () => {});
    if (mine !== before.pending.base) offer(uri, mine);
  }
}
