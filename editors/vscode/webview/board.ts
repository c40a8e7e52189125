// The display of a drawing: fragments of the engine in one SVG, with a ring around the selected
// part and one around each active part. It uses the studio's modules to parse, find and measure.
import { at } from "../../../studio/page/debug/follow";
import { all, nodes, svg } from "../../../studio/page/drawing/fragment";
import { rectOf, type Drawing, type Part, type Point, type Rect } from "../../../studio/page/drawing/shapes";
import { first, fitted, shown, toPlan, type Size, type View } from "../../../studio/page/drawing/view";
import type { Run } from "../src/drawing";

export class Board {
  private readonly root = svg("svg", { class: "afp-plan", role: "img" });
  private readonly defs = svg("defs");
  private readonly world = svg("g");
  private readonly layers = [svg("g"), svg("g")] as const;
  // The ring of a box is below its exits; that of an exit or port is above the box.
  private readonly below = svg("g", { class: "rings" });
  private readonly above = svg("g", { class: "rings" });
  drawing: Drawing | null = null;
  view: View = { x: 0, y: 0, zoom: 1 };
  private marked: Part | null = null;
  private run: Run = { plan: null, stack: [], held: false, older: false };

  constructor(private readonly host: HTMLElement) {
    const [edges, elements] = this.layers;
    this.world.append(edges, this.below, elements, this.above);
    this.root.append(this.defs, this.world);
    host.append(this.root);
  }

  get size(): Size {
    return { width: this.host.clientWidth, height: this.host.clientHeight };
  }

  /** Shows a drawing in place of the last one; another plan is shown from its start. */
  show(drawing: Drawing): void {
    const before = this.drawing;
    this.drawing = drawing;
    const known = new Set([...this.defs.children].map(({ id }) => id));
    for (const symbol of drawing.symbols) if (!known.has(symbol.id)) this.defs.append(...nodes(symbol.svg));
    this.fill(0, [...drawing.edges.values()].map((edge) => [edge.id, edge.svg]));
    this.fill(1, [...drawing.elements.values()].map((element) => [element.item, element.svg]));
    this.root.setAttribute("aria-label", drawing.plan ?? "");
    if (before?.plan !== drawing.plan || before.uri !== drawing.uri) this.look(first(drawing, this.size));
    this.rings();
  }

  private fill(layer: 0 | 1, pieces: [id: string, svg: string][]): void {
    const drawn = all(pieces.map(([, text]) => text));
    const groups = pieces.map(([id], nth) => {
      const group = svg("g");
      group.dataset.id = id;
      group.append(...drawn[nth]!);
      return group;
    });
    this.layers[layer].replaceChildren(...groups);
  }

  look(view: View): void {
    this.view = view;
    this.world.setAttribute("transform", `matrix(${view.zoom} 0 0 ${view.zoom} ${view.x} ${view.y})`);
  }

  fit(): void {
    if (this.drawing) this.look(fitted(this.drawing.bounds, this.size));
  }

  /** The point of the plan at a position on the page. */
  at(event: MouseEvent): Point {
    const { left, top } = this.host.getBoundingClientRect();
    return toPlan(this.view, [event.clientX - left, event.clientY - top]);
  }

  /** Marks a part and scrolls to it. */
  mark(part: Part | null): void {
    this.marked = part;
    const rect = part && this.drawing && rectOf(this.drawing, part);
    if (rect) this.look(shown(this.view, rect, this.size));
    this.rings();
  }

  /** Marks the active parts of the outermost plan. */
  runs(run: Run): void {
    this.run = run;
    this.rings();
  }

  private rings(): void {
    const drawing = this.drawing;
    if (!drawing) return;
    const ring = (part: Part, name: string, more: number): SVGElement[] => {
      const rect = rectOf(drawing, part);
      return rect ? [frame(rect, name, more)] : [];
    };
    const frames = [{ path: "", plan: this.run.plan ?? drawing.plans[0] ?? "" }];
    const found = at(frames, drawing.plan, this.run.stack, []).active;
    const active = found.flatMap(({ item }) => ring({ item }, this.run.held ? "runs held" : "runs", 1.5));
    const marked = this.marked ? ring(this.marked, "ring", 3) : [];
    const isWhole = (this.marked?.part?.kind ?? "whole") === "whole";
    this.below.replaceChildren(...active, ...(isWhole ? marked : []));
    this.above.replaceChildren(...(isWhole ? [] : marked));
  }
}

const frame = ([x, y, width, height]: Rect, name: string, more: number): SVGElement =>
  svg("rect", { class: name, x: x - more, y: y - more, width: width + 2 * more, height: height + 2 * more, rx: 10 });
