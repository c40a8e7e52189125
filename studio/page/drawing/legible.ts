// Texts of a zoomed-out drawing: those below 10 px are hidden, others grow against the zoom and are
// fitted into their box or pill.
import type { Drawing } from "./shapes";
import type { Stage } from "./stage";
import { FAR, NEAR } from "./view";

/** Minimum screen size of a name and of a pill's text, pixels. */
const NAME = 10.5;
const PILL = 10;
/** Maximum size of a pill's text, in units of the plan. */
const TALLEST = 17;
/**
 * Maximum widening of a text, so that it stays off the round ends of its pill, and the space that a
 * name gains from its hidden icon.
 */
const SPARE = 6;
const ICON = { element: 36, supervisor: 28 };

const isName = (text: SVGTextElement): boolean => text.classList.contains("name");
const isPill = (text: SVGTextElement): boolean => text.getAttribute("text-anchor") === "middle" && !text.classList.contains("port");

/** Fits visible texts to the zoom. */
export function legible(stage: Stage, drawing: Drawing, zoom: number): void {
  // In steps of a fiftieth: finer ones are not visible.
  const step = zoom >= NEAR ? 1 : zoom < FAR ? 0 : Math.round(zoom * 50) / 50;
  for (const [item, group] of stage.nodes) {
    if (group.dataset.zoom === String(step) || group.hasAttribute("display") || !stage.filled.has(group)) continue;
    if (step !== 1 || group.dataset.zoom !== undefined) fit(group, step, drawing.elements.get(item)?.rect[2] ?? 0);
    group.dataset.zoom = String(step);
  }
}

function fit(group: SVGGElement, step: number, width: number): void {
  let own = true;
  for (const text of group.querySelectorAll("text")) {
    const name = isName(text);
    if (!name && !isPill(text)) continue;
    natural(text);
    if (step === 1 || step === 0) continue;
    const size = Number(text.getAttribute("font-size"));
    const wanted = Math.max(size, (name ? NAME : PILL) / step);
    const legible = name || wanted <= TALLEST;
    text.toggleAttribute("data-tiny", !legible);
    if (!legible) continue;
    const long = text.getComputedTextLength();
    const supervisor = name && (!own || size < 13);
    const gained = text.classList.contains("bare") ? 0 : supervisor ? ICON.supervisor : ICON.element;
    if (name) text.style.transform = `translate(${-gained}px, 4px)`;
    const room = !name ? long + SPARE : supervisor ? long + (gained || SPARE) : Math.max(width - 20, long);
    text.style.fontSize = `${wanted}px`;
    if (long * (wanted / size) > room) {
      text.setAttribute("textLength", String(room));
      text.setAttribute("lengthAdjust", "spacingAndGlyphs");
    }
    if (name) own = false;
  }
}

/** Resets to the engine's text. */
function natural(text: SVGTextElement): void {
  text.style.removeProperty("font-size");
  text.style.removeProperty("transform");
  for (const attribute of ["textLength", "lengthAdjust", "data-tiny"]) text.removeAttribute(attribute);
}
