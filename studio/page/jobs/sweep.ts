// Outcome map of a sweep: each run in the cell of its values. Pure, for tests without a page.

/** Endings in the command line's terms, successful ones first. */
export const ENDINGS = ["ok", "interrupted", "time_limit", "error", "not_started", "panicked"] as const;
export type Ending = (typeof ENDINGS)[number];

export interface Run {
  run: number;
  ending: Ending;
  where: string;
  why: string;
  time_s: number;
  seed: number;
  /** Null for the plan's world. */
  world: string | null;
  /** The varied values, as text and in SI units. */
  values: Readonly<Record<string, { text: string; si: number }>>;
  /** Touched objects with durations, in seconds. */
  touched: Readonly<Record<string, number>>;
  /** Command that repeats only this run. */
  command: string;
}

export interface Axis {
  name: string;
  labels: readonly string[];
}

/** Runs by columns and rows: `cells[row][column]`. */
export interface OutcomeMap {
  across: Axis;
  /** Without a name if rows continue the columns. */
  down: Axis;
  cells: readonly (readonly (readonly Run[])[])[];
}

/** Seeds per row, if only the seed varies. */
export const ROW = 20;

export const SEED = "seed";
const WORLD = "world";

/** An axis of runs: the label of each value, and its order. */
interface Difference {
  name: string;
  of: (run: Run) => string;
  order: (run: Run) => number;
}

export interface Sum {
  runs: number;
  /** Planned number of runs. */
  of: number;
  endings: Readonly<Partial<Record<Ending, number>>>;
}

/** The summary: the last line of a sweep, unless it was killed. */
export const sumOf = (lines: readonly unknown[]): Sum | null => (lines.at(-1) as { summary?: Sum } | undefined)?.summary ?? null;

/** The lines that are runs; the last line is the summary. */
export const runsOf = (lines: readonly unknown[]): Run[] => lines.filter((line): line is Run => typeof (line as Run).run === "number");

function differences(runs: readonly Run[]): Difference[] {
  const names = [...new Set(runs.flatMap(({ values }) => Object.keys(values)))];
  const varied = names.map((name) => ({ name, of: (run: Run) => run.values[name]?.text ?? "", order: (run: Run) => run.values[name]?.si ?? 0 }));
  const others: Difference[] = [
    { name: WORLD, of: ({ world }) => world?.split("/").at(-1) ?? "", order: ({ run }) => run },
    { name: SEED, of: ({ seed }) => String(seed), order: ({ seed }) => seed },
  ];
  return [...varied, ...others].filter(({ of }) => new Set(runs.map(of)).size > 1);
}

function axis(runs: readonly Run[], { name, of, order }: Difference): Axis {
  const labels = new Map([...runs].sort((one, two) => order(one) - order(two)).map((run) => [of(run), null]));
  return { name, labels: [...labels.keys()] };
}

/** The map of runs. Values of a third axis share a cell. */
export function mapOf(runs: readonly Run[]): OutcomeMap {
  const [first, second] = differences(runs);
  if (!first) return { across: { name: "", labels: [""] }, down: { name: "", labels: [""] }, cells: [[runs]] };
  const across = axis(runs, first);
  if (!second) return wrapped(runs, across, first);
  const down = axis(runs, second);
  const cells = down.labels.map((row) => across.labels.map((column) => runs.filter((run) => first.of(run) === column && second.of(run) === row)));
  return { across, down, cells };
}

/** A single axis: many values wrap into rows. */
function wrapped(runs: readonly Run[], { name, labels }: Axis, { of }: Difference): OutcomeMap {
  const all = labels.map((label) => runs.filter((run) => of(run) === label));
  const rows = Array.from({ length: Math.ceil(all.length / ROW) }, (_, row) => all.slice(row * ROW, (row + 1) * ROW));
  if (rows.length < 2) return { across: { name, labels }, down: { name: "", labels: [""] }, cells: rows };
  const columns = Array.from({ length: ROW }, (_, column) => (name === SEED ? `+${column}` : ""));
  return { across: { name, labels: columns }, down: { name: "", labels: rows.map((_, row) => labels[row * ROW]!) }, cells: rows };
}

/** Number of runs per ending, from the summary, since not all runs are listed. */
export const countedAll = (runs: readonly Run[], sum: Sum | null): { ending: Ending; count: number }[] =>
  sum ? ENDINGS.map((ending) => ({ ending, count: sum.endings[ending] ?? 0 })).filter(({ count }) => count > 0) : counted(runs);

/** Number of runs per ending, in order, without zeros. */
export const counted = (runs: readonly Run[]): { ending: Ending; count: number }[] =>
  ENDINGS.map((ending) => ({ ending, count: runs.filter((run) => run.ending === ending).length })).filter(({ count }) => count > 0);

/** Runs with equal results and their number; the most frequent first. */
export function grouped(runs: readonly Run[]): { run: Run; count: number }[] {
  const groups = new Map<string, { run: Run; count: number }>();
  for (const run of runs) {
    const key = [run.ending, run.where, run.why].join("\n");
    const known = groups.get(key);
    if (known) known.count++;
    else groups.set(key, { run, count: 1 });
  }
  return [...groups.values()].sort((one, two) => two.count - one.count);
}

/** Whether the studio can repeat a run: only the command line varies worlds. */
export const isRepeatable = ({ values }: Run): boolean => !Object.keys(values).some((name) => name.startsWith("world."));
