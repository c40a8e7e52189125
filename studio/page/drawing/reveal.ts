// Scrolls selected parts into view.
import * as actions from "./actions";
import { drawing } from "./model";
import type { Part } from "./shapes";
import { size, view } from "./stage";
import { shown } from "./view";

/** Scrolls a part into view with the smallest move. */
export function reveal(part: Part): void {
  const rect = drawing.peek()?.elements.get(part.item)?.outer ?? actions.rectOfPart(part);
  // A hidden drawing has no size.
  if (rect && size.peek().width > 0) view.value = shown(view.peek(), rect, size.peek());
}
