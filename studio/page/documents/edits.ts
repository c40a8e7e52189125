// Server edits: applied to exactly their text version, as one history entry.
import { inOrder, type TextEdit } from "./changes";
import { open, text, version } from "./documents";
import type { Part } from "../drawing/shapes";
import { push, underWay, type Change } from "./history";
import { LOST, Refused } from "../server/lsp";
import { pen } from "../server/session";
import { words } from "../words";

export interface WorkspaceEdit {
  documentChanges?: (
    | { kind: "create"; uri: string }
    | { textDocument: { uri: string; version: number | null }; edits: TextEdit[] }
  )[];
  changes?: Record<string, TextEdit[]>;
}

/** Applies a server edit as one history entry. Throws `Stale` for another version. */
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

/** The text has changed since the edit was computed; request it again. */
export class Stale extends Error {}

type Ask = () => Promise<{ edit: WorkspaceEdit; label: string; select?: Part[] } | null>;

/** Requests an edit and applies it; retries if the text has changed. */
export const change = (ask: Ask): Promise<void> => underWay(made(ask));

async function made(ask: Ask): Promise<void> {
  for (let attempt = 1; ; attempt++) {
    const found = await asked(ask);
    if (!found) return;
    try {
      return await apply(found.edit, found.label, found.select);
    } catch (why) {
      if (!(why instanceof Stale)) throw why;
      if (attempt === ATTEMPTS) throw new Error(words.stale(found.label));
    }
  }
}

/** Maximum number of requests. */
const ATTEMPTS = 4;

/**
 * Retries if the connection was lost before the answer. This is safe, because edits are applied
 * only here.
 */
async function asked<T>(ask: () => Promise<T>): Promise<T> {
  try {
    return await ask();
  } catch (why) {
    if (why instanceof Refused && why.code === LOST) return ask();
    throw why;
  }
}
