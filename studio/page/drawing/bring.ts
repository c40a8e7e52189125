// Dragging a template from the palette to the ground, an element or an edge.
import { signal } from "@preact/signals";
import { pen } from "../server/session";
import { addAt } from "./actions";
import type { Offer } from "./ask";
import { DECIDES } from "./gesture";
import { hit } from "./hit";
import { GRID } from "./lift";
import { drawing } from "./model";
import { holderOf, type Point, type Rect } from "./shapes";
import { view } from "./stage";
import { toPlan } from "./view";

/** The dragged template, and its position in page pixels. */
export const carried = signal<{ offer: Offer; at: Point } | null>(null);
/** The drop target: an element's box in units of the plan, or an edge. */
export const target = signal<{ rect: Rect } | { edge: string } | null>(null);

type Where = Parameters<typeof addAt>[1];

/** The drop place under a point of the page; null outside the drawing. */
function where(offer: Offer, [x, y]: Point): Where | null {
  const board = document.querySelector<HTMLElement>(".board");
  const drawn = drawing.peek();
  const box = board?.getBoundingClientRect();
  if (!box || !drawn || x < box.left || x > box.right || y < box.top || y > box.bottom) return null;
  const at = toPlan(view.peek(), [x - box.left, y - box.top]);
  const found = hit(drawn, at, view.peek().zoom);
  if (offer.kind === "supervise") return found && "element" in found ? { owner: { item: found.element } } : { place: at };
  const edge = found && "edge" in found ? drawn.edges.get(found.edge) : undefined;
  const grid = (value: number): number => Math.round(value / GRID) * GRID;
  return edge ? { edge } : { place: [grid(at[0] - 24), grid(at[1] - 24)] };
}

function show(to: Where | null): void {
  const drawn = drawing.peek();
  if (!to || !drawn || "place" in to) target.value = null;
  else if ("edge" in to) target.value = { edge: to.edge.id };
  else {
    const holder = holderOf(drawn, to.owner.item);
    target.value = holder ? { rect: holder.rect } : null;
  }
}

/**
 * Handles a press on a template: after some pixels it is dragged until it is dropped or `Escape`
 * cancels.
 */
export function grab(offer: Offer, event: PointerEvent & { currentTarget: HTMLElement }): void {
  if (event.button !== 0 || !pen.peek()) return;
  const { currentTarget: button, pointerId, clientX, clientY } = event;
  const move = (moved: PointerEvent): void => {
    const far = Math.hypot(moved.clientX - clientX, moved.clientY - clientY) >= DECIDES;
    if (!carried.peek() && !far) return;
    if (!carried.peek()) button.setPointerCapture(pointerId);
    carried.value = { offer, at: [moved.clientX, moved.clientY] };
    show(where(offer, [moved.clientX, moved.clientY]));
  };
  const end = (drop: boolean) => (): void => {
    for (const [name, take] of own) window.removeEventListener(name, take, true);
    const known = carried.peek();
    const to = known && drop ? where(offer, known.at) : null;
    target.value = null;
    // The click after a drag must be ignored.
    setTimeout(() => (carried.value = null));
    if (to) void addAt(offer, to);
  };
  const escape = (key: KeyboardEvent): void => {
    if (key.key !== "Escape" || !carried.peek()) return;
    key.preventDefault();
    key.stopPropagation();
    end(false)();
  };
  const own: [string, (event: any) => void][] = [["pointermove", move], ["pointerup", end(true)], ["pointercancel", end(false)], ["keydown", escape]];
  for (const [name, take] of own) window.addEventListener(name, take, true);
}
