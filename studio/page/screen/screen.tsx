// The screen: bar, palette, drawing, right and bottom panes, depending on the window size.
import { h, type ComponentChild } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { pathOf } from "../documents/addresses";
import { Bar, Tool } from "./bar";
import { Book } from "./book";
import { Dialogs } from "./dialogs";
import { conflicts } from "../documents/conflicts";
import { current, isFailed, nameOf, saved, takePen } from "../documents/documents";
import { EndCard } from "../debug/controls";
import { mountCanvas } from "../drawing/canvas";
import { Finder } from "./finder";
import { Sign } from "./icons";
import { bottom, clamp, narrow, palette, right, show, widths, world, type Bottom as Lower, type Narrow, type Right } from "./layout";
import { removed } from "../documents/files";
import { putFileBack, report, trouble, Welcome } from "../panes/files";
import { ForcedBar } from "../panes/forced";
import { Guide } from "../panes/guide";
import { Inspector } from "../panes/inspector";
import { Jobs } from "../panes/jobs";
import { NewEntry } from "../panes/newentry";
import { Outline } from "../panes/outline";
import { Palette } from "../panes/palette";
import { Problems } from "../panes/problems";
import { RobotBar } from "../panes/robot";
import { RunPane } from "../panes/run";
import { Scenarios } from "../panes/scenarios";
import { TextPane } from "../panes/text";
import { Timeline } from "../panes/timeline";
import { WhyCard } from "../panes/why";
import { WorldPane } from "../panes/world";
import { hello, lsp, pen } from "../server/session";
import { words } from "../words";

export function Screen() {
  if (!hello.value) return <p class="connecting" role="status">{words.connecting}</p>;
  return (
    <div class="studio" data-narrow={narrow.value}>
      <Bar />
      <div>
        <RobotBar />
        <ForcedBar />
        <Banners />
      </div>
      <main class="middle">
        {palette.value && current.value && <Side />}
        <Centre />
        <RightPanes />
      </main>
      <Bottom />
      {current.value && <NarrowBar />}
      <Dialogs />
      <NewEntry />
      <Book />
      <Finder />
    </div>
  );
}

function Banners() {
  return (
    <div class="banners" role="status">
      {!lsp().open.value && <p class="banner warning">{words.offline(pathOf(hello.value!.root), location.port)}</p>}
      {isFailed(saved.value) && <p class="banner error">{words.notSavedBecause(saved.value)}</p>}
      {!pen.value && (
        <p class="banner">
          {words.watching} <button onClick={() => void takePen().catch(report)}>{words.takePen}</button>
        </p>
      )}
      {conflicts.value.map(({ uri, choices, mine, choose }) => (
        <p class="banner warning" key={uri}>
          {(mine === null ? words.conflict : words.unsent)(nameOf(uri))}
          <span class="choices">
            {choices.map((keep) => <button onClick={() => void choose(keep).catch(report)} key={keep}>{words.keep[keep]}</button>)}
          </span>
        </p>
      ))}
      {removed.value && (
        <p class="banner">
          {words.removedFile(removed.value[0]!.name)} <button onClick={putFileBack}>{words.putFileBack}</button>
          <Tool icon="close" label={words.close(words.files)} run={() => (removed.value = null)} />
        </p>
      )}
      {trouble.value && (
        <p class="banner error">
          {trouble.value} <Tool icon="close" label={words.close(words.problems)} run={() => (trouble.value = null)} />
        </p>
      )}
    </div>
  );
}

const Side = () => (
  <section class="pane palette" data-pane="palette" data-when="palette" aria-label={words.palette}>
    <header>
      <h2>{words.palette}</h2>
      <Tool icon="close" label={words.close(words.palette)} run={() => (palette.value = false)} />
    </header>
    <div class="body" tabIndex={-1}><Palette /></div>
  </section>
);

function Centre() {
  return (
    <section class="pane drawing" data-pane="drawing" data-when="drawing" aria-label={words.drawing}>
      <Guide />
      <div class="sheet">
        {current.value ? <Canvas /> : <Welcome />}
        <EndCard />
        <WhyCard />
      </div>
      {!palette.value && current.value && (
        <button class="opener" onClick={() => (palette.value = true)} aria-label={words.open(words.palette)} title={words.open(words.palette)}>
          <Sign name="palette" />
        </button>
      )}
    </section>
  );
}

function Canvas() {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => mountCanvas(host.current!), []);
  return <div class="canvas" ref={host} />;
}

type Beside = "world" | Right;

const TABS: { name: Beside; label: string }[] = [
  { name: "world", label: words.world },
  { name: "inspector", label: words.inspector },
  { name: "text", label: words.text },
  { name: "outline", label: words.outline },
];

/** The right pane: the world, and below it the open pane. */
function RightPanes() {
  // A world is available before a plan.
  const open = current.value ? right.value : null;
  const of: Beside | null = open ?? (world.value ? "world" : null);
  const isOpen = (name: Beside): boolean => (name === "world" ? world.value : open === name);
  const toggle = (name: Beside): void => {
    if (!isOpen(name)) show(name);
    else if (name === "world") world.value = false;
    else right.value = null;
  };
  return (
    <>
      {of && <Divider of={of} />}
      {of && (
        <div class="column" ref={(node) => { node?.style.setProperty("--width", `${widths.value[of]}px`); }}>
          {world.value && (
            <section class="pane right around" data-pane="world" data-when="world" aria-label={words.world}>
              <div class="body" tabIndex={-1}><WorldPane /></div>
            </section>
          )}
          {open && (
            <section class="pane right" data-pane="right" data-when={open} aria-label={words[open]}>
              <div class="body" tabIndex={-1}>{open === "text" ? <TextPane /> : open === "outline" ? <Outline /> : <Inspector />}</div>
            </section>
          )}
        </div>
      )}
      <nav class="rail" aria-label={words.panes}>
        {TABS.filter(({ name }) => current.value || name === "world").map(({ name, label }) => (
          <button aria-pressed={isOpen(name)} onClick={() => toggle(name)} key={name}>
            <Sign name={name} />
            <span>{label}</span>
          </button>
        ))}
      </nav>
    </>
  );
}

/** The divider between drawing and pane: dragged, or moved by arrows. */
function Divider({ of }: { of: Beside }) {
  const put = (width: number): void => {
    widths.value = { ...widths.value, [of]: clamp(width) };
  };
  const down = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    const [start, width] = [event.clientX, widths.value[of]];
    const line = event.currentTarget;
    line.setPointerCapture(event.pointerId);
    line.onpointermove = (moved) => put(width + start - moved.clientX);
    line.onpointerup = line.onpointercancel = () => {
      line.onpointermove = null;
    };
  };
  const key = (event: KeyboardEvent): void => {
    const step = { ArrowLeft: 24, ArrowRight: -24 }[event.key];
    if (!step) return;
    event.preventDefault();
    put(widths.value[of] + step);
  };
  return (
    <div class="divider" role="separator" aria-orientation="vertical" tabIndex={0} aria-label={words.resize(words[of])}
      aria-valuenow={widths.value[of]} aria-valuemin={220} aria-valuemax={900} onPointerDown={down} onKeyDown={key} />
  );
}

const LOWER: { name: Lower; label: string }[] = [
  { name: "problems", label: words.problems },
  { name: "run", label: words.runPane },
  { name: "timeline", label: words.timeline },
  { name: "scenarios", label: words.scenarios },
  { name: "jobs", label: words.jobs },
];

const LOWER_PANES: Record<Lower, () => ComponentChild> = { problems: Problems, run: RunPane, timeline: Timeline, scenarios: Scenarios, jobs: Jobs };

/** The bottom pane; on a narrow page, the selected pane. */
function Bottom() {
  const alone = LOWER.find(({ name }) => name === narrow.value)?.name;
  const open = alone ?? bottom.value;
  if (!current.value || !open) return null;
  const close = (): void => {
    [bottom.value, narrow.value] = [null, "drawing"];
  };
  return (
    <section class="pane bottom" data-pane="bottom" data-when={open} aria-label={LOWER.find(({ name }) => name === open)!.label}>
      <header>
        <div class="tabs" role="tablist" aria-label={words.panes}>
          {LOWER.map(({ name, label }) => (
            <button role="tab" aria-selected={open === name} onClick={() => show(name)} key={name}>{label}</button>
          ))}
        </div>
        <Tool icon="close" label={words.close(words.pane)} run={close} />
      </header>
      <div class="body" tabIndex={-1}>{h(LOWER_PANES[open], {})}</div>
    </section>
  );
}

const NARROW: { name: Narrow; label: string }[] = [
  { name: "palette", label: words.palette },
  { name: "drawing", label: words.drawing },
  ...TABS,
  ...LOWER,
];

/** Selects the pane of a narrow page. */
const NarrowBar = () => (
  <nav class="narrow" aria-label={words.panes}>
    {NARROW.map(({ name, label }) => (
      <button aria-pressed={narrow.value === name} onClick={() => show(name)} key={name}>
        <Sign name={name} />
        <span>{name === "jobs" ? words.jobsShort : label}</span>
      </button>
    ))}
  </nav>
);
