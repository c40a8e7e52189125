// Puts fragments into the groups that are in sight. Of a large drawing the rest is left out until it comes into sight.
import { all } from "./fragment";
import { legible } from "./legible";
import { carried } from "./lift";
import { boxOf, touches, type Drawing, type Edge, type Element, type Rect } from "./shapes";
import { name, show, size, view, type Stage } from "./stage";
import { FAR, sight } from "./view";

/** So many elements are all kept in the page; of more, only those in sight. */
const FEW = 150;
/**
 * The margin drawn beyond each side of the pane, as a share of its size: a small move draws nothing
 * new.
 */
const BEYOND = 0.15;

function beyond([x, y, width, height]: Rect): Rect {
  const [dx, dy] = [width * BEYOND, height * BEYOND];
  return [x - dx, y - dy, width + 2 * dx, height + 2 * dy];
}

/** Shows a drawing in place of another one, or of a preview of it. */
export function refresh(stage: Stage, before: Drawing | null, after: Drawing | null): void {
  carried.value = null;
  show(stage, before, after);
  if (after) fill(stage, after);
}

/** Shows what is in sight as large as the view says, and hides what is not. */
export function fill(stage: Stage, drawing: Drawing): void {
  // Small, it is painted on a canvas.
  if (view.peek().zoom < FAR) return;
  const seen = drawing.elements.size > FEW ? beyond(sight(view.peek(), size.peek())) : null;
  layer(stage, stage.edges, drawing.edges, (edge) => seen === null || touches(boxOf(edge), seen));
  layer(stage, stage.nodes, drawing.elements, (element) => seen === null || touches(element.outer, seen), (group, element) => name(group, element, drawing));
  legible(stage, drawing, view.peek().zoom);
}

function layer<T extends Element | Edge>(
  stage: Stage,
  groups: ReadonlyMap<string, SVGGElement>,
  shown: ReadonlyMap<string, T>,
  isSeen: (one: T) => boolean,
  made: (group: SVGGElement, one: T) => void = () => {},
): void {
  const anew: { group: SVGGElement; one: T }[] = [];
  for (const [id, one] of shown) {
    const group = groups.get(id);
    if (!group) continue;
    const seen = isSeen(one);
    if (seen === group.hasAttribute("display")) {
      if (seen) group.removeAttribute("display");
      else group.setAttribute("display", "none");
    }
    if (seen && stage.filled.get(group) !== one) anew.push({ group, one });
  }
  const drawn = all(anew.map(({ one }) => one.svg));
  anew.forEach(({ group, one }, nth) => {
    delete group.dataset.zoom;
    group.replaceChildren(...drawn[nth]!);
    stage.filled.set(group, one);
    made(group, one);
  });
}
