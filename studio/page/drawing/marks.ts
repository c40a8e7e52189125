// The overlay: rings of selection and focus, handles of exits, drop targets, selection box, new
// line.
import { svg } from "./fragment";
import { holderOf, keyOf, rectOf, type Drawing, type Part, type Point, type Rect } from "./shapes";
import type { Stage } from "./stage";
import { words } from "./words";

export interface Marked {
  selected: readonly Part[];
  /** Whether to draw focus rings for keyboard users. */
  keys: boolean;
  /** Elements that fit a new edge, and the hovered one. */
  fits: ReadonlySet<string> | null;
  over: string | null;
  /** Unreachable elements. */
  unreached: ReadonlySet<string>;
  /** Results of the last search. */
  found: readonly Part[];
  /** Drop target of a template. */
  target: { rect: Rect } | { edge: string } | null;
  box: Rect | null;
  line: readonly Point[] | null;
  zoom: number;
}

export function mark(stage: Stage, drawing: Drawing | null, marked: Marked): void {
  const made: SVGElement[] = [];
  const below: SVGElement[] = [];
  const last = marked.selected.at(-1);
  if (drawing) {
    const entries = new Set(drawing.entries.map(({ item }) => item));
    const isWhole = ({ part }: Part): boolean => part === undefined || part.kind === "whole";
    // Exits are above the ring of their element, entries above the configuration's box.
    const layer = (part: Part): SVGElement[] => (isWhole(part) && !entries.has(part.item) ? below : made);
    for (const part of marked.selected) {
      const rect = rectOf(drawing, part);
      if (rect) layer(part).push(...ring(rect, marked, part === last));
      if (isWhole(part)) made.push(...handles(drawing, part.item, marked.zoom));
    }
    for (const [item, { rect }] of drawing.elements) if (marked.unreached.has(keyOf({ item }))) below.push(...never(rect));
    for (const part of marked.found) {
      const rect = rectOf(drawing, part);
      if (rect) layer(part).push(outline(rect, 2, "found"));
    }
    for (const item of marked.fits ?? []) {
      const element = drawing.elements.get(item);
      if (element) made.push(outline(element.rect, 4, marked.over === item ? "fits over" : "fits"));
    }
  }
  if (marked.target && "rect" in marked.target) made.push(outline(marked.target.rect, 4, "fits over"));
  if (marked.box) made.push(outline(marked.box, 0, "box-selection"));
  if (marked.line) made.push(svg("path", { class: "new-edge", d: `M${marked.line.map((point) => point.join(" ")).join("L")}` }));
  stage.rings.replaceChildren(...below);
  stage.marks.replaceChildren(...made);
  fade(stage, drawing, marked);
}

const outline = ([x, y, width, height]: Rect, more: number, name: string): SVGElement =>
  svg("rect", { class: name, x: x - more, y: y - more, width: width + 2 * more, height: height + 2 * more, rx: more === 0 ? 2 : 9 + more / 2 });

/** A dotted border with its meaning. */
function never(rect: Rect): SVGElement[] {
  const text = svg("text", { class: "unreached-text", x: rect[0] + rect[2], y: rect[1] - 6 });
  text.textContent = words.neverReached;
  return [outline(rect, 2, "unreached"), text];
}

function ring(rect: Rect, { keys, zoom }: Marked, last: boolean): SVGElement[] {
  const more = 3 / Math.min(zoom, 1);
  const rings = [outline(rect, more, "ring")];
  if (keys && last) rings.push(outline(rect, more + 2 / zoom, "ring second"), outline(rect, more + 3.5 / zoom, "ring third"));
  return rings;
}

/** Drag handles for the exits of the selection. */
function handles(drawing: Drawing, item: string, zoom: number): SVGElement[] {
  const exits = (holderOf(drawing, item)?.pieces ?? []).filter((piece) => piece.item === item && piece.part.kind === "exit");
  return exits.map(({ rect: [x, y, width, height] }) => {
    const aside = item.split(".").length > 2 || !drawing.elements.has(item);
    const at = aside ? { cx: x + width, cy: y + height / 2 } : { cx: x + width / 2, cy: y + height };
    return svg("circle", { class: "handle", ...at, r: 4 / Math.min(zoom, 1) });
  });
}

let faded: readonly unknown[] = [];

/** A selected edge fades the others; while connecting, invalid targets fade. */
function fade(stage: Stage, drawing: Drawing | null, { selected, fits, target }: Marked): void {
  const now = [stage, drawing, selected, fits, target];
  if (now.every((each, at) => each === faded[at])) return;
  faded = now;
  const exits = selected.filter((part) => part.part?.kind === "exit" || part.part?.kind === "start");
  const edges = [...(drawing?.edges.values() ?? [])];
  const chosen = new Set(edges.filter((edge) => exits.some((part) => part.item === edge.from && part.part?.name === edge.part.name)).map((edge) => edge.id));
  const one = exits.length > 0 && exits.length === selected.length && chosen.size > 0;
  stage.root.classList.toggle("one-way", one);
  stage.root.classList.toggle("leading", fits !== null);
  for (const [id, group] of stage.edges) group.classList.toggle("chosen", (one && chosen.has(id)) || (target !== null && "edge" in target && target.edge === id));
  for (const [item, group] of stage.nodes) group.classList.toggle("unfit", fits !== null && !fits.has(item));
}
