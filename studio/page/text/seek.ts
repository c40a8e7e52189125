// Search marks in the text; a search in the text's own panel is marked in the drawing.
import { getSearchQuery, searchPanelOpen } from "@codemirror/search";
import { StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, type DecorationSet } from "@codemirror/view";
import { effect } from "@preact/signals";
import { sought } from "../plan/seek";

/** Maximum number of marks. */
const MOST = 1000;

const seek = StateEffect.define<string>();
const mark = Decoration.mark({ class: "cm-sought" });

function places(text: string, wanted: string): DecorationSet {
  const found = [];
  const [all, small] = [text.toLowerCase(), wanted.toLowerCase()];
  for (let at = all.indexOf(small); small && at >= 0 && found.length < MOST; at = all.indexOf(small, at + small.length)) found.push(mark.range(at, at + small.length));
  return Decoration.set(found);
}

const wanted = StateField.define<string>({
  create: () => "",
  update: (before, transaction) => transaction.effects.find((each) => each.is(seek))?.value ?? before,
});

const marked = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update: (before, transaction) => {
    const asked = transaction.effects.some((each) => each.is(seek));
    return asked || transaction.docChanged ? places(transaction.newDoc.toString(), transaction.state.field(wanted)) : before;
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** Passes the panel's search to the drawing. */
const told = EditorView.updateListener.of(({ state, startState }) => {
  const [now, before] = [getSearchQuery(state).search, getSearchQuery(startState).search];
  if (searchPanelOpen(state) && (now !== before || !searchPanelOpen(startState))) sought.value = now;
  else if (searchPanelOpen(startState) && !searchPanelOpen(state)) sought.value = null;
});

export const seeking = [wanted, marked, told];

/** Marks matches in a view; returns a function that ends it. */
export const follow = (view: EditorView): (() => void) => effect(() => view.dispatch({ effects: seek.of(sought.value ?? "") }));
