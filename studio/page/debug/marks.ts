// Marks of a run in the drawing: active element, enclosing plans, polled supervisors, recent edges.
import { effect } from "@preact/signals";
import { svg } from "../drawing/fragment";
import { drawing } from "../drawing/model";
import { rectOf, type Drawing, type Rect } from "../drawing/shapes";
import { stops, type Stop } from "./breakpoints";
import { at, suspendedIn, taken, within, type At } from "./follow";
import { onDrawing } from "../jobs/results";
import { resultMarks } from "./result-marks";
import { active, frames, phase, state } from "./run";
import { words } from "../words";
import { chips, holding, type Held } from "./values";

/** Duration of the highlight of a taken edge, milliseconds. */
const FADES = 600;

export interface Layers {
  root: Element;
  /** Layers of marks: borders below the elements, icons above. */
  below: SVGGElement;
  over: SVGGElement;
  nodes: ReadonlyMap<string, SVGGElement>;
  edges: ReadonlyMap<string, SVGGElement>;
}

function frame([x, y, width, height]: Rect, name: string): SVGElement {
  return svg("rect", { class: name, x: x - 1.5, y: y - 1.5, width: width + 3, height: height + 3, rx: 10.5 });
}

/**
 * A triangle in a corner, or two bars for a stopped run, so that activity is not shown by colour
 * only.
 */
function sign([x, y]: Rect, held: boolean): SVGElement[] {
  const shape = held ? `M${x - 4} ${y - 4}h3v8h-3zm5 0h3v8h-3z` : `M${x - 3} ${y - 4.5}l7 4.5l-7 4.5z`;
  return [svg("circle", { class: `run-sign${held ? " held" : ""}`, cx: x, cy: y, r: 9 }), svg("path", { class: "run-arrow", d: shape })];
}

/** An eye in the corner of an active supervisor. */
function eye([x, y, width]: Rect): SVGElement[] {
  const right = x + width;
  return [
    svg("circle", { class: "run-eye", cx: right, cy: y, r: 8 }),
    svg("path", { class: "run-lid", d: `M${right - 5} ${y}q5 -6 10 0q-5 6 -10 0z` }),
    svg("circle", { class: "run-pupil", cx: right, cy: y, r: 1.6 }),
  ];
}

/** Draws the marks of a run; returns a function that ends it. */
export function marks(layers: Layers): () => void {
  let last: string | null = null;
  let shown = "";
  let before: Drawing | null = null;
  return effect(() => {
    const drawn = drawing.value;
    const now = state.value;
    const runs = (active.value || phase.value === "over") && now !== null;
    layers.root.classList.toggle("running", runs);
    if (!drawn || !runs) {
      [last, shown, before] = [null, "", null];
      return show(layers, [], [], new Set());
    }
    // After the end of a run no supervisor is active.
    const found = at(frames.value, drawn.plan, now.stack, active.value ? now.watching : []);
    const inner = found.active.filter(({ inside }) => inside).map(({ item }) => [item, within(frames.value, drawn.plan, now.stack, item)] as const);
    const aside = active.value ? suspendedIn(frames.value, drawn.plan, now.suspended ?? {}) : [];
    const key = JSON.stringify([found, inner, aside, phase.value]);
    if (key === shown && drawn === before) return;
    [shown, before] = [key, drawn];
    const innermost = found.active.find((each) => !each.inside)?.item ?? null;
    const held = phase.value === "held";
    show(layers, borders(drawn, found, held), [...signs(drawn, found, held), ...inner.flatMap(([item, name]) => place(drawn, item, `▶ ${name}`)), ...aside.flatMap(([item, since]) => setAside(drawn, item, since))], new Set(found.active.map(({ item }) => item)));
    const isPassed = (item: string): boolean => drawn.elements.get(item)?.kind === "computation";
    flash(layers, drawn, taken(drawn.edges.values(), last, innermost, isPassed));
    last = innermost ?? last;
  });
}

function show({ below, over, nodes }: Layers, borders: SVGElement[], signs: SVGElement[], filled: ReadonlySet<string>): void {
  below.replaceChildren(...borders);
  over.replaceChildren(...signs);
  for (const [item, group] of nodes) group.classList.toggle("active", filled.has(item));
}

const borders = (drawn: Drawing, found: At, held: boolean): SVGElement[] =>
  found.active.flatMap(({ item, inside }) => {
    const rect = rectOf(drawn, { item });
    return rect ? [frame(rect, `run-active${inside ? " inside" : ""}${held ? " held" : ""}`)] : [];
  });

/**
 * A disc on the left border: a ring if disabled, with a bar for a condition, a diamond for a
 * logpoint.
 */
function disc([x, y, , height]: Rect, { off, condition, log }: Stop): SVGElement[] {
  const middle = y + height / 2;
  const name = `breakpoint${off ? " off" : ""}`;
  const body = log ? svg("path", { class: name, d: `M${x - 7} ${middle}l7 -7l7 7l-7 7z` }) : svg("circle", { class: name, cx: x, cy: middle, r: 6 });
  return condition ? [body, svg("path", { class: "breakpoint-sign", d: `M${x - 3} ${middle - 1.5}h6m-6 3h6` })] : [body];
}

export function discs(layer: SVGGElement): () => void {
  return effect(() => {
    const drawn = drawing.value;
    const made = drawn ? stops.value.flatMap(({ part, stop }) => {
      const rect = rectOf(drawn, part);
      return rect ? disc(rect, stop) : [];
    }) : [];
    layer.replaceChildren(...(drawn ? resultMarks(drawn, onDrawing.value) : []), ...made);
  });
}

function signs(drawn: Drawing, found: At, held: boolean): SVGElement[] {
  const watching = found.watching.flatMap((item) => {
    const rect = rectOf(drawn, { item });
    return rect ? eye(rect) : [];
  });
  const active = found.active.flatMap(({ item, inside }) => {
    const rect = rectOf(drawn, { item });
    return rect && !inside ? sign(rect, held) : [];
  });
  return [...watching, ...active];
}

/** A text on the top border of an element: the active element inside a sub-plan, or a time. */
function place(drawn: Drawing, item: string, words: string, name = ""): SVGElement[] {
  const rect = rectOf(drawn, { item });
  if (!rect) return [];
  const text = svg("text", { class: `run-place-text${name}`, x: rect[0] + 20, y: rect[1] + 4 });
  text.textContent = words;
  return [svg("rect", { class: `run-place${name}`, x: rect[0] + 14, y: rect[1] - 9, width: words.length * 7.6 + 14, height: 18, rx: 9 }), text];
}

/** Distance of the stripes over a suspended element. */
const STRIPES = 8;

/** A suspended element: striped, with the time since when. */
function setAside(drawn: Drawing, item: string, since: number): SVGElement[] {
  const rect = rectOf(drawn, { item });
  if (!rect) return [];
  const [x, y, width, height] = rect;
  const lines = Array.from({ length: Math.floor((width + height) / STRIPES) }, (_, nth) => {
    const along = (nth + 1) * STRIPES;
    const [left, right] = [Math.max(0, along - height), Math.min(width, along)];
    return `M${x + left} ${y + along - left}L${x + right} ${y + along - right}`;
  });
  return [svg("path", { class: "run-aside", d: lines.join("") }), ...place(drawn, item, words.aside(since), " aside")];
}

/** Highlights the edges that were just taken: wider, with rings at their exits and a moving dot. */
function flash({ over, edges }: Layers, drawn: Drawing, ids: readonly string[]): void {
  const groups = ids.flatMap((id) => edges.get(id) ?? []);
  const ways = ids.flatMap((id) => drawn.edges.get(id) ?? []);
  if (!ways.length) return;
  const exits = ways.map((way) => rectOf(drawn, { item: way.from, part: way.part })).filter((rect) => rect !== null);
  const rings = exits.map(([x, y, width, height]) => svg("rect", { class: "run-exit", x: x - 2.5, y: y - 2.5, width: width + 5, height: height + 5, rx: height / 2 + 2.5 }));
  const dot = svg("circle", { class: "run-dot", r: 5 });
  const [first, ...rest] = ways.flatMap((way) => way.points);
  dot.style.offsetPath = `path("M${first!.join(" ")}${rest.map((point) => `L${point.join(" ")}`).join("")}")`;
  for (const group of groups) group.classList.add("taken");
  // The active element and its layer may change meanwhile.
  over.after(dot, ...rings);
  setTimeout(() => {
    for (const group of groups) group.classList.remove("taken");
    for (const each of [dot, ...rings]) each.remove();
  }, FADES);
}

/** Shows the values of entries, and highlights new values for a while. */
export function values(root: Element, layer: SVGGElement): () => void {
  let before: ReadonlyMap<string, Held> = new Map();
  let drawnBefore: Drawing | null = null;
  return effect(() => {
    const drawn = drawing.value;
    const now = active.value || phase.value === "over" ? state.value : null;
    const found = new Map(drawn && now ? drawn.entries.flatMap(({ item }) => {
      const value = holding(frames.value, drawn.plan, now, item);
      return value === null ? [] : [[item, value] as const];
    }) : []);
    if (drawn === drawnBefore && JSON.stringify([...found]) === JSON.stringify([...before])) return;
    const fresh = new Set([...found].filter(([item, { text }]) => before.has(item) && before.get(item)!.text !== text).map(([item]) => item));
    [before, drawnBefore] = [found, drawn];
    root.classList.toggle("holding", found.size > 0);
    layer.replaceChildren(...(drawn ? chips(drawn, found, fresh) : []));
  });
}
