// Fills visible groups with fragments. A large drawing leaves out invisible ones.
import { all } from "./fragment";
import { legible } from "./legible";
import { carried } from "./lift";
import { boxOf, touches, type Drawing, type Edge, type Element, type Rect } from "./shapes";
import { name, show, size, view, type Stage } from "./stage";
import { FAR, sight } from "./view";

/** Up to this number, all elements are kept in the page; otherwise only visible ones. */
const FEW = 150;
/** Margin beyond each side of the pane, relative to its size: small moves draw nothing new. */
const BEYOND = 0.15;

function beyond([x, y, width, height]: Rect): Rect {
  const [dx, dy] = [width * BEYOND, height * BEYOND];
  return [x - dx, y - dy, width + 2 * dx, height + 2 * dy];
}

/** Replaces a drawing or its preview. */
export function refresh(stage: Stage, before: Drawing | null, after: Drawing | null): void {
  carried.value = null;
  show(stage, before, after);
  if (after) fill(stage, after);
}

/** Scales visible parts to the view, and hides others. */
export function fill(stage: Stage, drawing: Drawing): void {
  // Below this zoom, the canvas shows them.
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
