// The language server's completion and hover.
import { snippet, type Completion, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import type { EditorView, Tooltip } from "@codemirror/view";
import { valueAt } from "../debug/run";
import { inOrder, type TextEdit } from "../documents/changes";
import { text } from "../documents/documents";
import { nodes } from "../screen/markdown";
import { offset, position, type Range } from "../documents/positions";
import { lsp } from "../server/session";
import { words } from "../words";
import { fromProtocol } from "./snippets";

interface Item {
  label: string;
  kind?: number;
  detail?: string;
  documentation?: { value: string };
  sortText?: string;
  insertTextFormat?: number;
  textEdit: TextEdit;
  additionalTextEdits?: TextEdit[];
}

/** The protocol's kinds as CodeMirror's, which have icons. */
const KINDS: Record<number, string> = { 3: "function", 6: "variable", 7: "class", 9: "namespace", 10: "property", 11: "constant", 12: "constant", 13: "enum", 14: "keyword", 20: "enum", 22: "type", 23: "interface", 25: "type" };

/** Combines changes of an editor into one history entry. */
export type Together = (run: () => void) => void;

export const completion = (uri: string, together: Together) => async (context: CompletionContext): Promise<CompletionResult | null> => {
  if (!context.explicit && !context.matchBefore(/[\w.>=(:]$/)) return null;
  const now = text(uri);
  const params = { textDocument: { uri }, position: position(now, context.pos) };
  const answer = await lsp().request<{ items: Item[] } | null>("textDocument/completion", params).catch(() => null);
  const items = [...(answer?.items ?? [])].sort((a, b) => ((a.sortText ?? a.label) < (b.sortText ?? b.label) ? -1 : 1));
  if (!items.length || context.aborted) return null;
  const options = items.map((item, rank) => option(item, rank, uri, together));
  return { from: offset(now, items[0]!.textEdit.range.start), options, validFor: /^\w*$/ };
};

function option(item: Item, rank: number, uri: string, together: Together): Completion {
  const { documentation, detail, kind } = item;
  const apply = (view: EditorView, chosen: Completion, from: number, to: number): void =>
    together(() => {
      const others = inOrder(uri, view.state.doc.toString(), item.additionalTextEdits ?? []);
      let moved = 0;
      for (const { from: at, to: end, insert } of others) {
        view.dispatch({ changes: { from: at, to: end, insert } });
        if (end <= from) moved += insert.length - (end - at);
      }
      const { newText } = item.textEdit;
      const written = item.insertTextFormat === 2 ? fromProtocol(newText) : newText.replace(/[{}]/g, "\\$&");
      snippet(written)(view, chosen, from + moved, to + moved);
    });
  return {
    label: item.label,
    boost: Math.max(-99, -rank),
    apply,
    ...(detail ? { detail } : {}),
    ...(kind && KINDS[kind] ? { type: KINDS[kind] } : {}),
    ...(documentation?.value ? { info: () => nodes(documentation.value) } : {}),
  };
}

/** The description of the word at a place; its value in the run comes first. */
export const hover = (uri: string) => async (_view: EditorView, pos: number): Promise<Tooltip | null> => {
  const now = text(uri);
  const params = { textDocument: { uri }, position: position(now, pos) };
  type Answer = { contents: { value: string }; range?: Range };
  const answer = await lsp().request<Answer | null>("textDocument/hover", params).catch(() => null);
  if (!answer) return null;
  const [from, to] = answer.range ? [offset(now, answer.range.start), offset(now, answer.range.end)] : [pos, pos];
  const value = answer.range && (await valueAt(uri, now.slice(from, to), answer.range.start));
  const create = (): { dom: HTMLElement } => {
    const dom = nodes(answer.contents.value);
    if (value) dom.prepend(Object.assign(document.createElement("p"), { className: "in-run", textContent: words.inRun(value) }));
    return { dom };
  };
  return { pos: from, end: to, above: true, create };
};
