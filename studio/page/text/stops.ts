// The gutter with breakpoints: a click sets one or takes it away.
import { RangeSet, StateEffect, StateField, type Extension } from "@codemirror/state";
import { gutter, GutterMarker, type EditorView } from "@codemirror/view";
import { effect } from "@preact/signals";
import { linesOf, toggle } from "../debug/breakpoints";
import { words } from "../words";

class Disc extends GutterMarker {
  override toDOM(): HTMLElement {
    const made = document.createElement("span");
    made.className = "cm-breakpoint";
    made.title = words.breakpoint;
    return made;
  }
}

const disc = new Disc();
const setStops = StateEffect.define<readonly number[]>();

const field = StateField.define<RangeSet<GutterMarker>>({
  create: () => RangeSet.empty,
  update: (before, { state, effects, changes }) => {
    const set = effects.find((each) => each.is(setStops));
    if (!set) return before.map(changes);
    const lines = (set.value as readonly number[]).filter((line) => line < state.doc.lines);
    return RangeSet.of(lines.map((line) => disc.range(state.doc.line(line + 1).from)), true);
  },
});

/** The gutter of a text. */
export const stops = (uri: string): Extension => [
  field,
  gutter({
    class: "cm-stops",
    markers: (view) => view.state.field(field),
    initialSpacer: () => disc,
    domEventHandlers: {
      mousedown: (view, block) => {
        toggle(uri, view.state.doc.lineAt(block.from).number - 1);
        return true;
      },
    },
  }),
];

/** Shows the breakpoints of a text; the answer ends that. */
export const follow = (view: EditorView, uri: string): (() => void) => effect(() => view.dispatch({ effects: setStops.of(linesOf(uri)) }));
