// The gutter with breakpoints; a click toggles one.
import { RangeSet, StateEffect, StateField, type Extension } from "@codemirror/state";
import { gutter, GutterMarker, type EditorView } from "@codemirror/view";
import { effect } from "@preact/signals";
import { stopsOf, toggle, type Stop } from "../debug/breakpoints";
import { words } from "../words";

class Disc extends GutterMarker {
  constructor(private readonly stop: Stop) {
    super();
  }

  override eq(other: GutterMarker): boolean {
    return other instanceof Disc && JSON.stringify(other.stop) === JSON.stringify(this.stop);
  }

  override toDOM(): HTMLElement {
    const made = document.createElement("span");
    const { off, condition, log } = this.stop;
    made.className = `cm-breakpoint${off ? " off" : ""}${log ? " speaks" : ""}`;
    made.textContent = condition ? "=" : "";
    made.title = log ?? condition ?? words.breakpoint;
    return made;
  }
}

const plain = new Disc({ line: 0 });
const setStops = StateEffect.define<readonly Stop[]>();

const field = StateField.define<RangeSet<GutterMarker>>({
  create: () => RangeSet.empty,
  update: (before, { state, effects, changes }) => {
    const set = effects.find((each) => each.is(setStops));
    if (!set) return before.map(changes);
    const known = (set.value as readonly Stop[]).filter(({ line }) => line < state.doc.lines);
    return RangeSet.of(known.map((stop) => new Disc(stop).range(state.doc.line(stop.line + 1).from)), true);
  },
});

export const stops = (uri: string): Extension => [
  field,
  gutter({
    class: "cm-stops",
    markers: (view) => view.state.field(field),
    initialSpacer: () => plain,
    domEventHandlers: {
      mousedown: (view, block) => {
        toggle(uri, view.state.doc.lineAt(block.from).number - 1);
        return true;
      },
    },
  }),
];

/** Shows the breakpoints of a text; returns a function that ends it. */
export const follow = (view: EditorView, uri: string): (() => void) => effect(() => view.dispatch({ effects: setStops.of(stopsOf(uri)) }));
