// The drawing pane: combines stage, pointers, keys and popups, and renders the signals.
import { batch, effect, untracked } from "@preact/signals";
import { render } from "preact";
import { useRef } from "preact/hooks";
import { discs, marks as runMarks, values } from "../debug/marks";
import { isForField, keyName } from "../screen/commands";
import { origin, selected } from "../plan/selection";
import { pen } from "../server/session";
import * as actions from "./actions";
import { target } from "./bring";
import { fill, refresh } from "./fill";
import { beginPlan } from "./first";
import * as catalog from "./catalog";
import { Chooser, Rename, useInSight } from "./choices";
import { question } from "./choose";
import { menu } from "./context";
import { ContextMenu } from "./contextmenu";
import { flows } from "./flow";
import { carries, commands, fit, isMoving, settle } from "./keys";
import { connecting, isSupervisor, newLine } from "./lead";
import { mark } from "./marks";
import { svg } from "./fragment";
import { farView } from "./far";
import * as messages from "./messages";
import { Minimap } from "./minimap";
import { drawing, plan, wanted } from "./model";
import { box, byKeys, hovered, pointers } from "./pointer";
import { NoteField } from "./notefield";
import { noting } from "./note";
import { renaming } from "./rename";
import { reveal } from "./reveal";
import { SeekBar } from "./seekbar";
import { hits } from "./seeking";
import { notice, said, spoken } from "./say";
import { planOf, type Drawing, type Part, type Point } from "./shapes";
import { several, toggle } from "./several";
import { size, stage, view } from "./stage";
import { editing } from "./value";
import { first, shown as broughtIn, STEP, toPane, zoomed, type Size, type View } from "./view";
import { words } from "./words";
import { LivePopup } from "../panes/live";
import { ValuePopup } from "../panes/value";

/** Mounts the drawing of the current document; returns a function that removes it. */
export function mountCanvas(host: HTMLElement): () => void {
  const pane = document.createElement("div");
  pane.className = "board";
  pane.tabIndex = 0;
  pane.setAttribute("role", "application");
  pane.setAttribute("aria-label", words.application);
  const scene = stage();
  const over = document.createElement("div");
  over.className = "board-over";
  pane.append(scene.root, over);
  host.append(pane);
  render(<Over />, over);
  const [below, above, dots, data, held] = [0, 1, 2, 3, 4].map(() => svg("g", { class: "run-layer", "aria-hidden": "true" })) as [SVGGElement, SVGGElement, SVGGElement, SVGGElement, SVGGElement];
  scene.rings.before(below);
  scene.marks.before(data, held, above, dots);
  const watch = new ResizeObserver(() => resized({ width: pane.clientWidth, height: pane.clientHeight }));
  watch.observe(pane);
  const key = (event: KeyboardEvent): void => {
    if ((event.target as Element).closest("input, textarea, select")) return;
    byKeys.value = true;
    if (carries(scene, event)) event.preventDefault();
  };
  const paste = (event: ClipboardEvent): void => {
    if ((event.target as Element).closest("input, textarea, select")) return;
    event.preventDefault();
    void actions.paste(event.clipboardData?.getData("text/plain") ?? "");
  };
  pane.addEventListener("keydown", key);
  pane.addEventListener("paste", paste);
  // Buttons and fields over the drawing handle their own keys.
  over.addEventListener("keydown", (event) => isForField(keyName(event)) && event.stopPropagation());
  const settles = (): void => settle(scene);
  pane.addEventListener("blur", settles);
  pane.addEventListener("pointerdown", settles, true);
  // A pointer press resets it afterwards.
  pane.addEventListener("focus", () => (byKeys.value = true));
  const ends = [catalog.begin(), messages.begin(), commands(), pointers(pane, scene), farView(pane, scene), ...shows(scene, pane), ...sights(), focuses(pane), discs(dots), flows(data), values(scene.root, held), runMarks({ root: scene.root, below, over: above, nodes: scene.nodes, edges: scene.edges })];
  return () => {
    ends.forEach((end) => end());
    watch.disconnect();
    render(null, over);
    pane.remove();
  };
}

/** Follows the size of the pane. A drawing that was in sight as a whole stays so, if there is room. */
function resized(to: Size): void {
  const [before, drawn, now] = [size.peek(), drawing.peek(), view.peek()];
  const isInSight = (view: View, size: Size): boolean => drawn !== null && broughtIn(view, drawn.bounds, size) === view;
  const after = drawn ? broughtIn(now, drawn.bounds, to) : now;
  batch(() => {
    size.value = to;
    if (drawn && to.width > 0 && isInSight(now, before) && isInSight(after, to)) view.value = after;
  });
}

/** Renders changes: the drawing, its marks, the screen reader's focus. */
function shows(scene: ReturnType<typeof stage>, pane: HTMLElement): (() => void)[] {
  let before: Drawing | null = null;
  return [
    effect(() => {
      const after = drawing.value;
      void [view.value, size.value];
      if (before !== after) refresh(scene, before, after);
      else if (after) fill(scene, after);
      before = after;
    }),
    effect(() => {
      pane.toggleAttribute("data-keys", byKeys.value);
    }),
    effect(() => {
      const drawn = drawing.value;
      const known = connecting.value;
      const fits = known && drawn ? new Set([...drawn.elements.keys()].filter((item) => known.targets.get(item.slice(item.lastIndexOf(".") + 1)) === null)) : null;
      const keys = byKeys.value;
      mark(scene, drawn, { selected: selected.value, keys, fits: known?.targets.size ? fits : null, over: known?.over ?? null, unreached: messages.unreached.value, found: hits.value, target: target.value, box: box.value, line: newLine(), zoom: view.value.zoom });
    }),
    effect(() => {
      const last = selected.value.at(-1);
      const id = last && drawing.value ? scene.idOf(last, drawing.value) : null;
      if (id) pane.setAttribute("aria-activedescendant", id);
      else pane.removeAttribute("aria-activedescendant");
    }),
  ];
}

/** Last view of each plan. */
const views = new Map<string, View>();

/** Stores the view of each plan, and reveals external selections. */
function sights(): (() => void)[] {
  let shown = "";
  let pending: Part | null = null;
  const key = (): string => `${drawing.value?.uri ?? ""} ${drawing.value?.plan ?? ""}`;
  return [
    effect(() => {
      const drawn = drawing.value;
      const { width } = size.value;
      if (!drawn || width === 0 || key() === shown) return;
      shown = key();
      const known = views.get(shown);
      view.value = known ?? untracked(() => first(drawn, size.value));
    }),
    effect(() => {
      const now = view.value;
      if (shown && untracked(key) === shown) views.set(shown, now);
    }),
    effect(() => {
      const last = selected.value.at(-1);
      pending = last && origin.peek() !== "drawing" ? last : null;
    }),
    effect(() => {
      const drawn = drawing.value;
      void selected.value;
      if (!drawn || !pending) return;
      const name = planOf(pending.item);
      if (name !== drawn.plan && drawn.plans.includes(name)) return void (wanted.value = name);
      if (untracked(() => actions.rectOfPart(pending!)) === null) return;
      untracked(() => reveal(pending!));
      pending = null;
    }),
  ];
}

/** Returns the focus to the drawing when a popup closes. */
function focuses(pane: HTMLElement): () => void {
  let open = false;
  return effect(() => {
    const now = question.value !== null || renaming.value !== null || editing.value !== null || menu.value !== null || noting.value !== null;
    if (open && !now && (document.activeElement === document.body || pane.contains(document.activeElement))) {
      const keys = byKeys.peek();
      pane.focus({ preventScroll: true });
      byKeys.value = keys;
    }
    open = now;
  });
}

function Over() {
  return (
    <>
      {drawing.value === null && <p class="board-empty late" role="status">{words.comes}</p>}
      {drawing.value !== null && plan.value === null && (
        <div class="board-empty">
          <p>{words.noPlan}</p>
          <button type="button" class="over" disabled={!pen.value} onClick={() => void beginPlan()}>{words.beginPlan}</button>
        </div>
      )}
      <FirstPlace />
      <Chooser key="chooser" />
      <Rename />
      <ContextMenu />
      <NoteField />
      <SeekBar />
      <ValuePopup />
      <LivePopup />
      <Tip />
      {notice.value && <p class="over board-notice">{notice.value}</p>}
      <div class="over board-tools" role="group">
        <Tool label={words.zoomIn} sign="+" run={() => grow(STEP)} />
        <Tool label={words.zoomOut} sign="−" run={() => grow(1 / STEP)} />
        <Tool label={words.zoomFit} sign="⤢" run={fit} />
        {several.value && <button type="button" class="tool on" aria-pressed="true" onClick={() => toggle(false)}>{words.several}</button>}
        <span class="board-zoom">{Math.round(view.value.zoom * 100)} %</span>
      </div>
      <Minimap />
      <p class="hidden" role="status">{said.value}</p>
    </>
  );
}

/** Position of the first element of an empty plan, below its start. */
function FirstPlace() {
  const [start, more] = drawing.value?.elements.values() ?? [];
  if (!start || more || start.kind !== null || plan.value === null) return null;
  const [left, top, width, height] = start.outer;
  const [x, y] = toPane(view.value, [left + width / 2, top + height]);
  return <p class="first-place" style={{ left: `${x}px`, top: `${y}px` }}>{words.firstPlace}</p>;
}

const grow = (factor: number): void => void (view.value = zoomed(view.peek(), factor, [size.peek().width / 2, size.peek().height / 2]));

const Tool = ({ label, sign, run }: { label: string; sign: string; run(): void }) => (
  <button type="button" class="tool" aria-label={label} title={label} onClick={run}>{sign}</button>
);

/** Problems of the hovered or focused part, or the reason why a target does not fit. */
function Tip() {
  const popup = useRef<HTMLDivElement>(null);
  const drawn = drawing.value;
  const found = drawn ? tip() : null;
  useInSight(found && [found.at[0] + 14, found.at[1] + 16], popup, found?.texts.length);
  if (!found || found.texts.length === 0) return null;
  return (
    <div class="over tip-box" ref={popup} role="tooltip">
      {found.texts.map((text, nth) => <p key={nth} class={text.help ? "help" : ""}>{text.text}</p>)}
    </div>
  );
}

function tip(): { at: Point; texts: { text: string; help?: boolean }[] } | null {
  const drawn = drawing.value!;
  const known = connecting.value;
  if (known) {
    const reason = known.over === null ? null : known.targets.get(known.over.slice(known.over.lastIndexOf(".") + 1));
    const whole = (known.from.part?.kind ?? "whole") === "whole";
    const hint = !whole ? words.connectHint : isSupervisor(drawn, known.from) ? words.handHint : words.portHint;
    return known.at && { at: known.at, texts: [{ text: reason ?? hint }] };
  }
  const last = selected.value.at(-1);
  const focus = byKeys.value && last ? { part: last, at: actions.beneath(last) } : null;
  const over = hovered.value;
  const at = over?.at ?? focus?.at ?? null;
  const part = over?.hit.part ?? focus?.part;
  if (!at || !part || isMoving() || menu.value || question.value || editing.value || renaming.value || noting.value) return null;
  const texts = messages.messagesOf(drawn, part).flatMap(({ message, help }) => [{ text: message }, ...(help ? [{ text: help, help: true }] : [])]);
  return { at, texts };
}

/** The name of a part, for other panes. */
export const called = (part: Part): string => (drawing.value ? spoken(drawing.value, part) : part.item);
