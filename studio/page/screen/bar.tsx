// The top bar: file, plans, saved state, undo and redo, problems.
import { batch } from "@preact/signals";
import { current, isFailed, nameOf, saved } from "../documents/documents";
import { Controls } from "../debug/controls";
import { log } from "../debug/run";
import { drawing, isEmpty, leave, plan, trail, wanted } from "../drawing/model";
import { finding } from "./finder";
import { redo, redoLabel, undo, undoLabel } from "../documents/history";
import { Severity, Sign, type Icon } from "./icons";
import { bottom, show } from "./layout";
import { Menu } from "./menu";
import { Files, report } from "../panes/files";
import { number } from "../plan/problems";
import { words } from "../words";

export function Bar() {
  return (
    <header class="bar">
      {current.value && <h1 class="hidden">{words.title(nameOf(current.value))}</h1>}
      <Menu label={current.value ? words.menuOf(nameOf(current.value)) : words.menu} class="file" button={<FileName />}>
        {(done) => <Files done={done} />}
      </Menu>
      <Breadcrumb />
      <Saved />
      <span class="gap" />
      <Tool icon="undo" label={words.undo(undoLabel.value)} disabled={!undoLabel.value} run={() => undo().catch(report)} />
      <Tool icon="redo" label={words.redo(redoLabel.value)} disabled={!redoLabel.value} run={() => redo().catch(report)} />
      <ProblemCount />
      {current.value && <Controls />}
      <Tool icon="search" label={`${words.commands} (Ctrl+K)`} run={() => (finding.value = "commands")} />
    </header>
  );
}

const FileName = () => (
  <>
    <Sign name="menu" />
    <span>{current.value ? nameOf(current.value) : words.menu}</span>
    <Sign name="down" />
  </>
);

/** The path to the displayed plan, and the file's other plans. */
function Breadcrumb() {
  const plans = drawing.value?.plans ?? [];
  if (!current.value || !plan.value) return null;
  return (
    <nav class="crumbs" aria-label={words.plans}>
      {trail.value.map(({ plan: name }, at) => (
        <button onClick={() => leave(at)} title={words.out(name)} key={at}>{name}</button>
      ))}
      {plans.length < 2 && <span aria-current="page">{plan.value}</span>}
      {plans.length > 1 && (
        <Menu label={words.plans} button={<><span aria-current="page">{plan.value}</span><Sign name="down" /></>}>
          {(done) => (
            <div class="menu" role="menu" aria-label={words.plans}>
              {plans.map((name) => (
                <button role="menuitemradio" aria-checked={name === plan.value} onClick={() => { done(); goTo(name); }} key={name}>
                  <Sign name={name === plan.value ? "check" : "drawing"} />
                  {name}
                </button>
              ))}
            </div>
          )}
        </Menu>
      )}
    </nav>
  );
}

/** Shows a plan by name, without a path. */
function goTo(name: string): void {
  batch(() => {
    [trail.value, wanted.value] = [[], name];
  });
}

function Saved() {
  const state = saved.value;
  if (!current.value) return null;
  const failed = isFailed(state);
  const not = failed || state === "disputed";
  // A log is displayed instead of a text.
  const shown = log.value.split("/").at(-1);
  if (shown && !not) return <span class="saved log" role="status" title={words.logOf(shown)}>{words.logShown(shown)}</span>;
  return (
    <span class={`saved ${not ? "failed" : state}`} role="status" title={failed ? words.notSavedBecause(state) : ""}>
      {not ? words.notSaved : state === "saved" ? words.saved : words.saving}
    </span>
  );
}

/** Whether the displayed file is drawn and has no plan. */
export const hasNoPlan = (): boolean => drawing.value?.uri === current.value && drawing.value.plan === null;

function ProblemCount() {
  if (!current.value) return null;
  // A plan without elements has not gone wrong yet.
  const [errors, warnings] = isEmpty.value ? [0, 0] : [number("error"), number("warning")];
  const said = isEmpty.value ? words.emptySoFar : [errors && words.errors(errors), warnings && words.warnings(warnings)].filter(Boolean).join(", ") || (hasNoPlan() ? words.noPlan : words.ready);
  const toggle = (): void => (bottom.value === "problems" ? void (bottom.value = null) : show("problems"));
  return (
    <button class="count" onClick={toggle} aria-label={words.showProblems(said)} aria-expanded={bottom.value === "problems"}>
      {errors > 0 ? <Severity of="error" /> : warnings > 0 ? <Severity of="warning" /> : !hasNoPlan() && !isEmpty.value && <Sign name="check" />}
      <span>{said}</span>
    </button>
  );
}

/** An icon button; its name is its label and tooltip. */
export const Tool = ({ icon, label, run, disabled = false }: { icon: Icon; label: string; run: () => unknown; disabled?: boolean }) => (
  <button class="tool" aria-label={label} title={label} disabled={disabled} onClick={() => void run()}>
    <Sign name={icon} />
  </button>
);
