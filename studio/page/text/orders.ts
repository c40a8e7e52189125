// Commands at the text cursor: definition, rename, fixes, formatting.
import type { EditorView } from "@codemirror/view";
import { ask, askLine } from "../screen/dialogs";
import type { TextEdit } from "../documents/changes";
import { text, version } from "../documents/documents";
import { apply, change, type WorkspaceEdit } from "../documents/edits";
import { report, trouble } from "../panes/files";
import { reveal } from "../plan/places";
import { offset, position, range, type Range } from "../documents/positions";
import { actionsAt, diagnostics, mend } from "../plan/problems";
import { files, lsp } from "../server/session";
import { words } from "../words";

const cursor = (view: EditorView, uri: string) => ({ textDocument: { uri }, position: position(text(uri), view.state.selection.main.head) });

/** Goes to the definition of the word at the cursor. */
export async function definition(view: EditorView, uri: string): Promise<void> {
  type Place = { uri: string; range: Range };
  const answer = await lsp().request<Place | Place[] | null>("textDocument/definition", cursor(view, uri));
  const place = Array.isArray(answer) ? answer[0] : answer;
  if (!place) trouble.value = words.noDefinition;
  else if (files.value.some((file) => file.uri === place.uri)) await reveal(place.uri, place.range, "text", true);
  else trouble.value = words.definitionElsewhere;
}

export async function rename(view: EditorView, uri: string): Promise<void> {
  const at = cursor(view, uri);
  const answer = await lsp().request<{ range: Range; placeholder?: string } | Range | null>("textDocument/prepareRename", at);
  if (!answer) {
    trouble.value = words.noRename;
    return;
  }
  const place = "range" in answer ? answer.range : answer;
  const now = text(uri);
  const before = now.slice(offset(now, place.start), offset(now, place.end));
  const name = await askLine(words.renameTo(before), "", before, words.rename);
  if (!name || name === before) return;
  const edit = await lsp().request<WorkspaceEdit>("textDocument/rename", { ...at, newName: name });
  await apply(edit, words.renamed(before, name));
  view.focus();
}

/** Offers code actions for the selection. */
export async function mendHere(view: EditorView, uri: string): Promise<void> {
  const { from, to } = view.state.selection.main;
  const now = text(uri);
  const near = (diagnostics.value.get(uri)?.list ?? []).filter((each) => offset(now, each.range.start) <= to && from <= offset(now, each.range.end));
  const actions = await actionsAt(uri, range(now, from, to), near);
  if (!actions.length) {
    trouble.value = words.noFix;
    return;
  }
  const chosen = await ask(words.fixes, "", actions.map((each) => each.title));
  const action = actions.find((each) => each.title === chosen);
  if (action) await mend(action);
}

export const format = (uri: string): Promise<void> =>
  change(async () => {
    const textDocument = { uri, version: version(uri) };
    const edits = await lsp().request<TextEdit[] | null>("textDocument/formatting", { textDocument: { uri }, options: { tabSize: 4, insertSpaces: true } });
    return edits?.length ? { label: words.format, edit: { documentChanges: [{ textDocument, edits }] } } : null;
  });

/** Runs a command; an error is shown. */
export const ordered = (run: () => Promise<void>) => (): void => void run().catch(report);
