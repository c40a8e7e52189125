// Entries of the plan: a new one, with its name, kind, type and value, asked for in one line each.
import { askLine } from "../screen/dialogs";
import * as actions from "./actions";
import * as ask from "./ask";
import { isName } from "./rename";
import { words } from "./words";

/** Adds an entry of a kind; its line is written as in the text, `speed: length = 30 cm`. */
export async function add(): Promise<void> {
  const at = actions.here();
  if (!at) return;
  const wrong = (line: string): string | null => (isName(/^\s*(?:(?:in|out|var|const)\s+)?([^\s:=]*)/.exec(line)?.[1] ?? "") ? null : words.nameHint);
  const line = await askLine(words.addEntry, words.entryHint, words.entryExample, words.addEntry, wrong);
  if (line === null) return;
  const kind = /^\s*(in|out|var|const)\s/.test(line) ? "" : "var ";
  await ask.edit([{ add: { plan: at.plan, text: `${kind}${line.trim()}` } }]);
}
