// The page's commands: history, panes, files, keys.
import { command } from "./commands";
import { finding, showingKeys } from "./finder";
import { redo, redoLabel, undo, undoLabel } from "../documents/history";
import { bottom, isBottom, narrow, palette, right, show, world, type Narrow } from "./layout";
import { makeNew, report } from "../panes/files";
import { current } from "../documents/documents";
import { isWritten } from "../debug/written";
import { refuse } from "../drawing/say";
import { sought } from "../plan/seek";
import { words } from "../words";

export function register(): void {
  command({ id: "find", label: words.commands, key: "Ctrl+K", run: () => (finding.value = "commands") });
  command({ id: "seek", label: words.seek, key: "Ctrl+F", enabled: () => current.value !== "", run: () => (sought.value ??= "") });
  command({ id: "goto", label: words.goto, key: "Ctrl+P", run: () => (finding.value = "things") });
  command({ id: "keys", label: words.keys, key: "?", run: () => (showingKeys.value = true) });
  command({ id: "undo", label: words.undo("…"), key: "Ctrl+Z", run: () => void undo().catch(report), enabled: () => undoLabel.value !== null });
  command({ id: "redo", label: words.redo("…"), key: ["Ctrl+Shift+Z", "Ctrl+Y"], run: () => void redo().catch(report), enabled: () => redoLabel.value !== null });
  command({ id: "save", label: words.save, key: "Ctrl+S", run: () => void announce() });
  command({ id: "pane-next", label: words.nextPane, key: "F6", run: () => step(1) });
  command({ id: "pane-before", label: words.lastPane, key: "Shift+F6", run: () => step(-1) });
  command({ id: "palette", label: words.palette, run: () => toggle("palette") });
  command({ id: "world", label: words.world, run: () => toggle("world") });
  command({ id: "text", label: words.text, key: "Ctrl+E", run: () => toggle("text") });
  command({ id: "inspector", label: words.inspector, run: () => toggle("inspector") });
  command({ id: "problems", label: words.problems, key: "Ctrl+Shift+M", run: () => toggle("problems") });
  command({ id: "run-pane", label: words.runPaneCommand, key: "Ctrl+Shift+U", run: () => toggle("run") });
  command({ id: "timeline", label: words.timeline, key: "Ctrl+Shift+Y", run: () => toggle("timeline") });
  command({ id: "scenarios", label: words.scenarios, run: () => toggle("scenarios") });
  command({ id: "jobs", label: words.jobs, run: () => toggle("jobs") });
  command({ id: "outline", label: words.outline, run: () => toggle("outline") });
  command({ id: "new", label: words.newPlan, run: makeNew });
}

/** Announces that everything is saved: saving is automatic. */
async function announce(): Promise<void> {
  refuse((await isWritten()) ? words.savedBySelf : words.notSaved);
}

function toggle(name: Narrow): void {
  const open = name === "palette" ? palette.value : name === "world" ? world.value : bottom.value === name || right.value === name;
  if (!open) {
    show(name);
    enterSoon(name);
  } else if (name === "palette") palette.value = false;
  else if (name === "world") world.value = false;
  else if (isBottom(name)) bottom.value = null;
  else right.value = null;
  if (open) narrow.value = "drawing";
}

/** Focuses the next or previous pane. */
function step(by: number): void {
  const panes = [...document.querySelectorAll("[data-pane], .bar")];
  const at = panes.findIndex((each) => each.contains(document.activeElement));
  const start = at < 0 && by < 0 ? 0 : at;
  enter(panes[(start + by + panes.length) % panes.length] ?? null);
}

/** Focuses a pane when it appears, unless the focus has moved. */
function enterSoon(name: string, before = document.activeElement, end = performance.now() + ENTERED_WITHIN): void {
  const pane = document.querySelector(`[data-when=${name}]`);
  // The editor appears a frame after its pane.
  const early = !pane || (name === "text" && !pane.querySelector(".cm-content"));
  if (!early) enter(pane);
  else if (document.activeElement === before && performance.now() < end) requestAnimationFrame(() => enterSoon(name, before, end));
}

/** Maximum time for a pane to appear, milliseconds: the editor is loaded on first use. */
const ENTERED_WITHIN = 10_000;

/** The first focusable part of a pane. */
const ENTRIES = [".cm-content", "[role=application]", ".body input:enabled", ".body button:enabled", ".body", "button:enabled"];

function enter(pane: Element | null): void {
  const inside = ENTRIES.map((each) => pane?.querySelector<HTMLElement>(each)).find((each) => each);
  inside?.focus();
}
