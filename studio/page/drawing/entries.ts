// Adding entries: name, kind, type and value in one line.
import { askLine } from "../screen/dialogs";
import * as actions from "./actions";
import * as ask from "./ask";
import { isName } from "./rename";
import { words } from "./words";

/** Adds an entry of a kind, from a line as in the source: `speed: length = 30 cm`. */
export async function add(): Promise<void> {
  const at = actions.here();
  if (!at) return;
  const wrong = (line: string): string | null => (isName(/^\s*(?:(?:in|out|var|const)\s+)?([^\s:=]*)/.exec(line)?.[1] ?? "") ? null : words.nameHint);
  const line = await askLine(words.addEntry, words.entryHint, words.entryExample, words.addEntry, wrong);
  if (line === null) return;
  const kind = /^\s*(in|out|var|const)\s/.test(line) ? "" : "var ";
  await ask.edit([{ add: { plan: at.plan, text: `${kind}${line.trim()}` } }]);
}
