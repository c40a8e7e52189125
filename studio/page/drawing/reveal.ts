// Brings into sight what was selected.
import * as actions from "./actions";
import { drawing } from "./model";
import type { Part } from "./shapes";
import { size, view } from "./stage";
import { shown } from "./view";

/** Moves the view as little as brings a part into sight. */
export function reveal(part: Part): void {
  const rect = drawing.peek()?.elements.get(part.item)?.outer ?? actions.rectOfPart(part);
  if (rect) view.value = shown(view.peek(), rect, size.peek());
}
