// The far view: at an illegible zoom, the drawing is painted on one canvas below the SVG, which
// keeps the marks.
import { effect, signal } from "@preact/signals";
import { carried } from "./lift";
import { drawing } from "./model";
import { coloursIn, paint, type Colours } from "./paint";
import { size, view, type Stage } from "./stage";
import { FAR } from "./view";

/** Colours of the drawing. */
export const colours = signal<Colours | null>(null);

const LOOKS = ["(prefers-color-scheme: dark)", "(forced-colors: active)"];

/** Reads the colours, again at theme changes; returns a function that ends it. */
function looks(root: SVGSVGElement): () => void {
  const read = (): void => void (colours.value = coloursIn(root));
  const queries = LOOKS.map((query) => matchMedia(query));
  queries.forEach((query) => query.addEventListener("change", read));
  // The style sheet may load after the page.
  if (document.readyState === "complete") read();
  else window.addEventListener("load", read, { once: true });
  return () => queries.forEach((query) => query.removeEventListener("change", read));
}

/** Keeps the canvas of a pane; returns a function that ends it. */
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
