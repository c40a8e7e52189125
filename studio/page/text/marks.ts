// Semantic colours and inlay hints from the server; they move with the text until updated.
import { StateEffect, StateField, type EditorState, type Extension, type Range as Placed } from "@codemirror/state";
import { Decoration, EditorView, ViewPlugin, WidgetType, type DecorationSet, type ViewUpdate } from "@codemirror/view";
import { legend, lsp } from "../server/session";
import type { Position } from "../documents/positions";

interface Hint {
  position: Position;
  label: string;
  tooltip?: string;
}

const setColours = StateEffect.define<DecorationSet>();
const setHints = StateEffect.define<DecorationSet>();

const kept = (effect: typeof setColours): StateField<DecorationSet> =>
  StateField.define<DecorationSet>({
    create: () => Decoration.none,
    update: (before, transaction) => {
      const set = transaction.effects.find((each) => each.is(effect));
      return set ? (set.value as DecorationSet) : before.map(transaction.changes);
    },
    provide: (field) => EditorView.decorations.from(field),
  });

/** The offset of a position; null if outside the text. */
function at({ doc }: EditorState, { line, character }: Position): number | null {
  if (line >= doc.lines) return null;
  const { from, length } = doc.line(line + 1);
  return character <= length ? from + character : null;
}

const DECLARES = 1;

/** Decodes the protocol's semantic tokens: five relative numbers each. */
export function colours(state: EditorState, data: number[], names: string[]): DecorationSet {
  const marks: Placed<Decoration>[] = [];
  let [line, character] = [0, 0];
  for (let index = 0; index + 4 < data.length; index += 5) {
    const [lines, columns, length, kind, modifiers] = data.slice(index, index + 5) as [number, number, number, number, number];
    [line, character] = lines ? [line + lines, columns] : [line, character + columns];
    const from = at(state, { line, character });
    const to = from === null ? 0 : Math.min(from + length, state.doc.length);
    if (from === null || to <= from) continue;
    const name = `afp-${names[kind] ?? "plain"}${modifiers & DECLARES ? " afp-declares" : ""}`;
    marks.push(Decoration.mark({ class: name }).range(from, to));
  }
  return Decoration.set(marks, true);
}

class HintWidget extends WidgetType {
  constructor(readonly label: string, readonly why: string) {
    super();
  }
  override eq(other: HintWidget): boolean {
    return other.label === this.label && other.why === this.why;
  }
  override toDOM(): HTMLElement {
    const made = document.createElement("span");
    made.className = "cm-hint";
    made.textContent = this.label;
    made.title = this.why;
    return made;
  }
}

function hints(state: EditorState, list: Hint[]): DecorationSet {
  const made = list.flatMap(({ position, label, tooltip }) => {
    const place = at(state, position);
    return place === null ? [] : [Decoration.widget({ widget: new HintWidget(label, tooltip ?? ""), side: 1 }).range(place)];
  });
  return Decoration.set(made, true);
}

/** Pause in typing before a request, milliseconds. */
const PAUSE = 120;

/** Requests colours and hints after a pause in typing or a refresh. */
const asker = (uri: string) =>
  ViewPlugin.define((view) => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const ask = async (): Promise<void> => {
      const { doc } = view.state;
      const textDocument = { uri };
      const end = { line: doc.lines, character: 0 };
      const [tokens, shown] = await Promise.all([
        lsp().request<{ data: number[] } | null>("textDocument/semanticTokens/full", { textDocument }),
        lsp().request<Hint[] | null>("textDocument/inlayHint", { textDocument, range: { start: { line: 0, character: 0 }, end } }),
      ]);
      // Marks of an older text are requested again.
      if (view.state.doc !== doc) return;
      const effects = [setColours.of(colours(view.state, tokens?.data ?? [], legend.value.tokenTypes)), setHints.of(hints(view.state, shown ?? []))];
      view.dispatch({ effects });
    };
    const soon = (wait: number): void => {
      clearTimeout(timer);
      timer = setTimeout(() => ask().catch(() => {}), wait);
    };
    const quiet = ["workspace/semanticTokens/refresh", "workspace/inlayHint/refresh"].map((method) => lsp().on(method, () => soon(0)));
    soon(0);
    return {
      update: (update: ViewUpdate) => {
        if (update.docChanged) soon(PAUSE);
      },
      destroy: () => {
        clearTimeout(timer);
        quiet.forEach((end) => end());
      },
    };
  });

export const marks = (uri: string): Extension => [kept(setColours), kept(setHints), asker(uri)];
