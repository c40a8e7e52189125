// Results of a sweep: endings, a map by varied values, and the runs of the selected cell, which can
// be repeated in the studio.
import { computed, signal } from "@preact/signals";
import { active, repeat } from "../debug/run";
import { Severity } from "../screen/icons";
import { report } from "./files";
import { counted, countedAll, grouped, isRepeatable, mapOf, runsOf, sumOf, type Ending, type OutcomeMap, type Run } from "../jobs/sweep";
import { swept, sweptIn } from "../jobs/results";
import { words } from "../words";

const runs = computed(() => runsOf(swept.value));
const sum = computed(() => sumOf(swept.value));
const map = computed(() => mapOf(runs.value));
/** Row and column of the selected cell, with its sweep. */
const chosen = signal<{ of: OutcomeMap; row: number; column: number } | null>(null);
/** Maximum number of listed runs. */
const LISTED = 30;

/** The icon of an ending, since colour is not enough. */
const SIGNS: Record<Ending, string> = {
  ok: "M3 8.5l3.2 3.2L13 4.8",
  interrupted: "M8 3v6M8 12v.6",
  time_limit: "M8 2.2a5.8 5.8 0 1 0 0 11.6A5.8 5.8 0 0 0 8 2.2M8 5v3.4l2.2 1.4",
  error: "M4 4l8 8M12 4l-8 8",
  not_started: "M3 8h10",
  panicked: "M4 4l8 8M12 4l-8 8",
};

const EndingSign = ({ of }: { of: Ending }) => (
  <svg class="ending-sign" viewBox="0 0 16 16" width="12" height="12" aria-hidden="true"><path d={SIGNS[of]} /></svg>
);

export function Sweep() {
  if (!runs.value.length && !sum.value) return null;
  const at = chosen.value?.of === map.value ? chosen.value : null;
  const { runs: done, of } = sum.value ?? { runs: runs.value.length, of: null };
  const cell = at ? map.value.cells[at.row]![at.column]! : null;
  return (
    <div class="sweep">
      <p class="endings" role="status">
        {done !== of && <span class="ending"><Severity of="warning" />{words.sweepCut(done, of)}</span>}
        {countedAll(runs.value, sum.value).map(({ ending, count }) => (
          <span class={`ending ${ending}`} key={ending}><EndingSign of={ending} />{words.endedSo(ending, count)}</span>
        ))}
        {done > runs.value.length && <span class="ending">{words.sweepShown(runs.value.length)}</span>}
      </p>
      {runs.value.length > 0 && (
        <div class="sweep-parts">
          <Cells map={map.value} />
          {cell ? <Chosen runs={cell} /> : <Chosen runs={runs.value} all />}
        </div>
      )}
    </div>
  );
}

/** The map: a table of buttons; arrows move. */
function Cells({ map: { across, down, cells } }: { map: OutcomeMap }) {
  const key = (event: KeyboardEvent & { currentTarget: HTMLTableElement }): void => {
    const way = ({ ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] } as const)[event.key as "ArrowLeft"];
    const here = (event.target as HTMLElement).closest("td");
    if (!way || !here) return;
    event.preventDefault();
    const row = (here.parentElement as HTMLTableRowElement).rowIndex + way[0];
    event.currentTarget.rows[row]?.cells[here.cellIndex + way[1]]?.querySelector("button")?.focus();
  };
  const isChosen = (row: number, column: number): boolean => chosen.value?.of === map.value && chosen.value.row === row && chosen.value.column === column;
  const first = chosen.value?.of === map.value ? chosen.value : { row: 0, column: 0 };
  return (
    <div class="map" role="region" aria-label={words.outcomeMap} tabIndex={-1}>
      {/* Keys of its buttons come up to it. */}
      <table onKeyDown={key}>
        <caption>{words.mapOf(across.name, down.name)}</caption>
        <thead>
          <tr><td />{across.labels.map((label, at) => (label ? <th scope="col" key={at}>{label}</th> : <td key={at} />))}</tr>
        </thead>
        <tbody>
          {cells.map((line, row) => (
            <tr key={row}>
              {down.labels[row] ? <th scope="row">{down.labels[row]}</th> : <td />}
              {line.map((cell, column) => (
                <td key={column}>
                  {cell.length > 0 && (
                    <button aria-pressed={isChosen(row, column)} tabIndex={row === first.row && column === first.column ? 0 : -1}
                      aria-label={words.cellOf(settingOf(cell[0]!, cell.length === 1), counted(cell).map(({ ending, count }) => words.endedSo(ending, count)).join(", "))}
                      onClick={() => (chosen.value = isChosen(row, column) ? null : { of: map.value, row, column })}>
                      <Cell runs={cell} />
                    </button>
                  )}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/**
 * A bar for each ending in proportion to its count; the icon of a single ending, or the number of
 * successes.
 */
function Cell({ runs }: { runs: readonly Run[] }) {
  const all = counted(runs);
  return (
    <svg viewBox="0 0 24 24" width="24" height="24" aria-hidden="true">
      {all.map(({ ending, count }, at) => {
        const before = all.slice(0, at).reduce((sum, part) => sum + part.count, 0);
        return <rect class={ending} x={(24 * before) / runs.length} width={(24 * count) / runs.length} height="24" key={ending} />;
      })}
      {all.length === 1 && <path class={`ending-sign ${all[0]!.ending}`} transform="translate(4 4)" d={SIGNS[all[0]!.ending]} />}
      {runs.some(({ touched }) => Object.keys(touched).length) && <circle class="bumped" cx="20" cy="4" r="2.5" />}
    </svg>
  );
}

const settingOf = (run: Run, withSeed = true): string =>
  [...Object.entries(run.values).map(([name, { text }]) => `${name} = ${text}`), ...(withSeed ? [words.seedOf(run.seed)] : [])].join(", ");

/** The runs of a cell, or all runs, each with a replay button. */
function Chosen({ runs, all = false }: { runs: readonly Run[]; all?: boolean }) {
  const listed = all ? grouped(runs) : runs.map((run) => ({ run, count: 1 }));
  return (
    <section class="chosen" aria-label={all ? words.endings : words.runsOfCell}>
      <h3>{all ? words.endings : words.runsOfCell}</h3>
      <ul>
        {listed.slice(0, LISTED).map(({ run, count }) => (
          <li key={run.run}>
            <span class={`ending ${run.ending}`}><EndingSign of={run.ending} />{all ? words.times(count) : settingOf(run)}</span>
            <span class="how">{words.cameSo(run.ending, run.where, run.why, run.time_s)}{Object.keys(run.touched).length > 0 && ` · ${words.touchedSo(run.touched)}`}</span>
            {isRepeatable(run) ? (
              <button disabled={active.value} title={settingOf(run)} onClick={() => void repeat(run, sweptIn.value).catch(report)}>{all ? words.watchOne : words.watchIt}</button>
            ) : (
              <code>{run.command}</code>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}
