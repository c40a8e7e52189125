// Marks of an older text are shown at their current positions, since typing is faster than answers.
import type { ChangeSet, Text } from "@codemirror/state";

/** Maximum number of states. */
const MOST = 500;

interface State {
  version: number;
  doc: Text;
  /** The changes since the previous state. */
  changes: ChangeSet | null;
}

export interface Then {
  text: string;
  /** The current position of a place of that text. */
  now(place: number): number;
}

/** The last states of a text, by version. */
export class Late {
  private states: State[];

  constructor(version: number, doc: Text) {
    this.states = [{ version, doc, changes: null }];
  }

  note(version: number, doc: Text, changes: ChangeSet): void {
    this.states = [...this.states, { version, doc, changes }].slice(-MOST);
  }

  /** The text of a version, or the current one; null if dropped. */
  at(version: number | null): Then | null {
    const at = version === null ? this.states.length - 1 : this.states.findLastIndex((state) => state.version <= version);
    const since = this.states.slice(at + 1);
    return at < 0 ? null : { text: this.states[at]!.doc.toString(), now: (place) => since.reduce((to, { changes }) => changes!.mapPos(to), place) };
  }
}
