// The far view: below a zoom at which nothing can be read, the whole drawing is painted on one canvas under the SVG, which
// keeps the marks.
import { effect, signal } from "@preact/signals";
import { carried } from "./lift";
import { drawing } from "./model";
import { coloursIn, paint, type Colours } from "./paint";
import { size, view, type Stage } from "./stage";
import { FAR } from "./view";

/** The colours of drawings, until the page gets others. */
export const colours = signal<Colours | null>(null);

const LOOKS = ["(prefers-color-scheme: dark)", "(forced-colors: active)"];

/** Reads the colours from the page, and again when its look changes; the answer ends that. */
function looks(root: SVGSVGElement): () => void {
  const read = (): void => void (colours.value = coloursIn(root));
  const queries = LOOKS.map((query) => matchMedia(query));
  queries.forEach((query) => query.addEventListener("change", read));
  // The style sheet of the drawing may come after the page.
  if (document.readyState === "complete") read();
  else window.addEventListener("load", read, { once: true });
  return () => queries.forEach((query) => query.removeEventListener("change", read));
}

/** Keeps the canvas of a pane; the answer ends that. */
export function farView(pane: HTMLElement, stage: Stage): () => void {
  const canvas = document.createElement("canvas");
  canvas.className = "far-view";
  canvas.setAttribute("aria-hidden", "true");
  pane.prepend(canvas);
  const ends = [
    looks(stage.root),
    effect(() => {
      const far = view.value.zoom < FAR && drawing.value !== null && colours.value !== null;
      canvas.hidden = !far;
      if (far) paint(canvas, drawing.value!, view.value, size.value, colours.value!, carried.value);
    }),
  ];
  return () => {
    ends.forEach((end) => end());
    canvas.remove();
  };
}
