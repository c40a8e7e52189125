// The drawing in the page: one SVG with a group for each element and edge, updated only if the
// drawing has changed. `fill.ts` fills a group when it becomes visible.
import { effect, signal } from "@preact/signals";
import { nodes, svg } from "./fragment";
import { spoken } from "./say";
import type { Drawing, Edge, Element, Part } from "./shapes";
import { FAR, NEAR, type Size, type View } from "./view";

/** The position of the plan in the pane, and the size of the pane, in CSS pixels. */
export const view = signal<View>({ x: 0, y: 0, zoom: 1 });
export const size = signal<Size>({ width: 0, height: 0 });

export interface Stage {
  root: SVGSVGElement;
  /** Layers below the elements and above everything, in units of the plan. */
  rings: SVGGElement;
  marks: SVGGElement;
  layers: { edges: SVGGElement; nodes: SVGGElement };
  /** Groups of elements and edges, by item and id. */
  nodes: Map<string, SVGGElement>;
  edges: Map<string, SVGGElement>;
  /** Content of each group. A missing group is empty or shows a preview. */
  filled: WeakMap<SVGGElement, Element | Edge>;
  /** The page's id of a part's group. */
  idOf(part: Part, drawing: Drawing): string | null;
}

/** Duration of an element's move, milliseconds. */
const TRAVELS = 160;

const still = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

export function stage(): Stage {
  const root = svg("svg", { class: "afp-plan stage", "aria-hidden": "false", focusable: "false" });
  const defs = svg("defs");
  const world = svg("g");
  const layer = (name: string): SVGGElement => svg("g", { "aria-hidden": "true", class: name });
  const [edges, rings, nodes, marks] = [layer("ways"), layer("marks"), svg("g", { class: "nodes" }), layer("marks")];
  world.append(edges, rings, nodes, marks);
  root.append(defs, world);
  effect(() => {
    const { x, y, zoom } = view.value;
    world.setAttribute("transform", `matrix(${zoom} 0 0 ${zoom} ${x} ${y})`);
    root.classList.toggle("middle", zoom < NEAR && zoom >= FAR);
    root.classList.toggle("far", zoom < FAR);
  });
  return {
    root,
    rings,
    marks,
    layers: { edges, nodes },
    nodes: new Map(),
    edges: new Map(),
    filled: new WeakMap(),
    idOf: (part, drawing) => (drawing.elements.has(part.item) ? domId(part.item) : null),
  };
}

const domId = (item: string): string => `element-${item.replace(/[^\w.-]/g, "_")}`;

/** Replaces a drawing. */
export function show(stage: Stage, before: Drawing | null, after: Drawing | null): void {
  symbols(stage, after);
  [stage.rings, stage.marks].forEach((layer) => layer.removeAttribute("transform"));
  const same = before !== null && after !== null && before.uri === after.uri && before.plan === after.plan;
  const old = same ? before : null;
  if (!same) for (const [, group] of [...stage.nodes, ...stage.edges]) group.remove();
  if (!same) [stage.nodes, stage.edges].forEach((map) => map.clear());
  replace(stage, "edges", after?.edges ?? new Map<string, Edge>());
  replace(stage, "nodes", after?.elements ?? new Map<string, Element>());
  for (const [item, element] of old?.elements ?? []) {
    const now = after!.elements.get(item);
    if (now && now !== element) travel(stage.nodes.get(item)!, element, now);
  }
  // The description of these depends on other items, too.
  const counted = [...(after?.elements.values() ?? [])].filter((element) => element.kind === null).map((element) => element.item);
  for (const item of new Set([started(old), started(after), ...counted])) {
    const [group, element] = [stage.nodes.get(item), after?.elements.get(item)];
    if (group && element) name(group, element, after!);
  }
}

const started = (drawing: Drawing | null): string => [...(drawing?.edges.values() ?? [])].find((edge) => edge.kind === "start")?.to ?? "";

function symbols(stage: Stage, drawing: Drawing | null): void {
  const defs = stage.root.firstElementChild!;
  const known = new Set([...defs.children].map((symbol) => symbol.id));
  const missing = (drawing?.symbols ?? []).filter(({ id }) => !known.has(id));
  for (const { svg } of missing) defs.append(...nodes(svg));
}

/** Creates and removes groups to match the elements or edges. */
function replace(stage: Stage, layer: "edges" | "nodes", after: ReadonlyMap<string, unknown>): void {
  const groups = stage[layer];
  for (const [id, group] of groups) {
    if (after.has(id)) continue;
    group.remove();
    groups.delete(id);
  }
  const fresh: SVGGElement[] = [];
  for (const id of after.keys()) {
    const known = groups.get(id);
    // A preview may remain if the answer changes nothing.
    known?.removeAttribute("transform");
    if (known) continue;
    const group = svg("g", { class: layer === "edges" ? "way" : "node", display: "none" });
    groups.set(id, group);
    fresh.push(group);
  }
  stage.layers[layer].append(...fresh);
}

/** Sets the accessible description of an element. */
export function name(group: SVGGElement, element: Element, drawing: Drawing): void {
  group.id = domId(element.item);
  group.setAttribute("role", "img");
  group.setAttribute("aria-label", spoken(drawing, { item: element.kind === null ? (drawing.plan ?? element.item) : element.item }));
}

/** Animates an element that the engine has moved; a dragged one is already there. */
function travel(group: SVGGElement, from: Element, to: Element): void {
  const [dx, dy] = [from.outer[0] - to.outer[0], from.outer[1] - to.outer[1]];
  if ((dx === 0 && dy === 0) || still() || group.dataset.dropped || group.hasAttribute("display")) return;
  group.animate([{ transform: `translate(${dx}px, ${dy}px)` }, { transform: "none" }], { duration: TRAVELS, easing: "ease-out" });
}
