// The page of the drawing: shows messages of the editor, and sends clicks to it.
import { changed, whole } from "../../../studio/page/drawing/differences";
import { hit } from "../../../studio/page/drawing/hit";
import { nameOf, type Drawing, type Part } from "../../../studio/page/drawing/shapes";
import { panned, STEP, wheelFactor, zoomed } from "../../../studio/page/drawing/view";
import type { FromPage, ToPage } from "../src/drawing";
import { Board } from "./board";

declare function acquireVsCodeApi(): { postMessage(message: FromPage): void };

const editor = acquireVsCodeApi();
const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const [host, plans, said, why, older] = [element("board"), element<HTMLSelectElement>("plans"), element("said"), element("why"), element("older")];
const board = new Board(host);

/** The greatest movement of a click; beyond it, it is a drag. */
const STILL = 4;
/** The movement of the drawing by an arrow key. */
const STRIDE = 60;

const take: { [Kind in ToPage["kind"]]: (message: Extract<ToPage, { kind: Kind }>) => void } = {
  drawing: ({ uri, answer }) => show(whole(uri, answer)),
  changed: ({ change }) => board.drawing && show(changed(board.drawing, change)),
  select: ({ part }) => board.mark(part),
  run: (run) => {
    board.runs(run);
    older.hidden = !run.older;
  },
  nothing: (message) => tell(message.why),
};

window.addEventListener("message", ({ data }: MessageEvent<ToPage>) => {
  const known = Object.hasOwn(take, data?.kind) ? (take[data.kind] as (message: ToPage) => void) : null;
  known?.(data);
});

function show(drawing: Drawing): void {
  tell(drawing.elements.size === 0 ? "There is no plan in this file." : "");
  board.show(drawing);
  plans.replaceChildren(...drawing.plans.map((name) => new Option(name, name, false, name === drawing.plan)));
  plans.hidden = drawing.plans.length < 2;
}

function tell(text: string): void {
  why.textContent = text;
  why.hidden = text === "";
}

function select(part: Part, kind: "select" | "open"): void {
  board.mark(part);
  said.textContent = nameOf(part.item);
  editor.postMessage({ kind, part });
}

function enter(name: string): void {
  if (board.drawing?.plans.includes(name)) editor.postMessage({ kind: "plan", name });
}

let down: { x: number; y: number; moved: boolean } | null = null;

host.addEventListener("pointerdown", (event) => {
  if (event.button !== 0) return;
  down = { x: event.clientX, y: event.clientY, moved: false };
  host.setPointerCapture(event.pointerId);
});

host.addEventListener("pointermove", (event) => {
  if (!down) return;
  const [dx, dy] = [event.clientX - down.x, event.clientY - down.y];
  if (!down.moved && Math.hypot(dx, dy) < STILL) return;
  down = { x: event.clientX, y: event.clientY, moved: true };
  host.classList.add("panning");
  board.look(panned(board.view, dx, dy));
});

host.addEventListener("pointerup", (event) => {
  const was = down;
  down = null;
  host.classList.remove("panning");
  if (!was || was.moved || !board.drawing) return;
  const found = hit(board.drawing, board.at(event), board.view.zoom);
  if (found) select(found.part, "select");
});

host.addEventListener("pointercancel", () => (down = null));

// Opens the plan of a sub-plan, or the text of any other part.
host.addEventListener("dblclick", (event) => {
  const found = board.drawing && hit(board.drawing, board.at(event), board.view.zoom);
  if (!found) return;
  const plan = board.drawing!.elements.get(found.part.item)?.plan;
  if (plan) enter(plan);
  else select(found.part, "open");
});

host.addEventListener(
  "wheel",
  (event) => {
    event.preventDefault();
    const { left, top } = host.getBoundingClientRect();
    const at = [event.clientX - left, event.clientY - top] as const;
    board.look(event.ctrlKey ? zoomed(board.view, wheelFactor(event.deltaY), at) : panned(board.view, -event.deltaX, -event.deltaY));
  },
  { passive: false },
);

let chosen = -1;

/** The next or previous element, in the order of their names. */
function step(by: 1 | -1): void {
  const items = [...(board.drawing?.elements.keys() ?? [])];
  if (items.length === 0) return;
  chosen = (chosen + by + items.length) % items.length;
  select({ item: items[chosen]! }, "select");
}

const middle = (): readonly [number, number] => [host.clientWidth / 2, host.clientHeight / 2];

const KEYS: Record<string, () => void> = {
  "+": () => board.look(zoomed(board.view, STEP, middle())),
  "-": () => board.look(zoomed(board.view, 1 / STEP, middle())),
  "0": () => board.fit(),
  n: () => step(1),
  p: () => step(-1),
  Enter: () => {
    const item = [...(board.drawing?.elements.keys() ?? [])][chosen];
    if (item) select({ item }, "open");
  },
  ArrowLeft: () => board.look(panned(board.view, STRIDE, 0)),
  ArrowRight: () => board.look(panned(board.view, -STRIDE, 0)),
  ArrowUp: () => board.look(panned(board.view, 0, STRIDE)),
  ArrowDown: () => board.look(panned(board.view, 0, -STRIDE)),
};

host.addEventListener("keydown", (event) => {
  const does = event.ctrlKey || event.metaKey || event.altKey ? undefined : KEYS[event.key];
  if (!does) return;
  event.preventDefault();
  does();
});

plans.addEventListener("change", () => enter(plans.value));
element("fit").addEventListener("click", () => board.fit());

/** Takes the colours of the editor's theme. */
function themed(): void {
  const { classList } = document.body;
  const isDark = classList.contains("vscode-dark") || (classList.contains("vscode-high-contrast") && !classList.contains("vscode-high-contrast-light"));
  classList.toggle("dark", isDark);
  element<HTMLStyleElement>("light").sheet!.disabled = isDark;
  element<HTMLStyleElement>("dark").sheet!.disabled = !isDark;
}

new MutationObserver(() => {
  const before = document.body.classList.contains("dark");
  const isDark = document.body.classList.contains("vscode-dark");
  if (before !== isDark) themed();
}).observe(document.body, { attributeFilter: ["class"] });
themed();
editor.postMessage({ kind: "ready" });
