// Converts events of a run to rows of the timeline: activity, supervisors and writes.

export interface Record {
  at: number;
  step: number;
  kind: string;
  path: string;
  text: string;
  /** Whether it is about a supervisor. */
  supervisor?: boolean;
  entry?: string;
  value?: string;
}

export interface Bar {
  from: number;
  /** End; null while it is active. */
  to: number | null;
  label: string;
}

export interface Mark {
  at: number;
  label: string;
}

export interface Row {
  /** The row: the flow of a plan, a supervisor, an entry, deadlines. */
  kind: "flow" | "supervisor" | "entry" | "misses";
  name: string;
  bars: Bar[];
  marks: Mark[];
}

/** Maximum number of records; the oldest are dropped. */
const MOST = 50_000;

/**
 * Appends records. If a rewound run repeats them, nothing changes; if it takes another course, they
 * replace the later records.
 */
export function extended(before: readonly Record[], more: readonly Record[]): readonly Record[] {
  const first = more[0];
  if (!first) return before;
  const known = (before.at(-1)?.step ?? -1) < first.step ? before.length : before.findIndex(({ step }) => step >= first.step);
  const alike = more.every((record, at) => !before[known + at] || same(record, before[known + at]!));
  if (alike && known + more.length <= before.length) return before;
  return [...before.slice(0, known), ...more].slice(-MOST);
}

const words = new Map<string, string>();
/** Maximum number of shared strings. */
const MOST_WORDS = 5000;

function kept(text: string): string {
  const known = words.get(text);
  if (known !== undefined) return known;
  if (words.size >= MOST_WORDS) words.clear();
  words.set(text, text);
  return text;
}

/** Shares repeated strings, to save memory in long runs. */
export const packed = (record: Record): Record => ({
  ...record,
  kind: kept(record.kind),
  path: kept(record.path),
  text: kept(record.text),
  ...(record.entry === undefined ? {} : { entry: kept(record.entry) }),
});

const same = (one: Record, other: Record): boolean => one.step === other.step && one.kind === other.kind && one.path === other.path && one.text === other.text;

const ENDS = ["finished", "interrupted", "diverted", "ended"];

const planOf = (path: string): string => path.split(".").slice(0, -1).join(".");
const nameOf = (path: string): string => path.split(".").at(-1)!;

/** Rows of all records: plans (outermost first), supervisors, entries, missed deadlines. */
export function rows(records: readonly Record[]): Row[] {
  const all = new Map<string, Row>();
  const row = (kind: Row["kind"], name: string): Row => {
    const key = `${kind} ${name}`;
    const found = all.get(key) ?? { kind, name, bars: [], marks: [] };
    all.set(key, found);
    return found;
  };
  for (const record of records) {
    const { kind, path, at, text } = record;
    if (kind === "committed" && record.entry !== undefined) row("entry", record.entry).marks.push({ at, label: record.value ?? "" });
    else if (kind === "missed") row("misses", "").marks.push({ at, label: text });
    // Another run continues: everything starts again.
    else if (kind === "forked") for (const [, each] of all) close(each, at);
    else if (path) follow(record, record.supervisor ? row("supervisor", path) : row("flow", planOf(path)));
    if (ENDS.includes(kind)) for (const [, inner] of all) if (inner.name.startsWith(`${path}.`) || (inner.name === path && inner.kind === "flow")) close(inner, at);
  }
  const order = ["flow", "supervisor", "entry", "misses"];
  return [...all.values()].filter(({ bars, marks }) => bars.length + marks.length).sort((a, b) => order.indexOf(a.kind) - order.indexOf(b.kind) || depth(a) - depth(b));
}

const depth = ({ kind, name }: Row): number => (kind === "flow" && name ? name.split(".").length : 0);

function follow({ kind, path, at, text }: Record, row: Row): void {
  const label = nameOf(path);
  if (kind === "started") row.bars.push({ from: at, to: null, label });
  else if (kind === "event" || kind === "faulted") row.marks.push({ at, label: text });
  if (ENDS.includes(kind)) {
    const open = row.bars.findLast((bar) => bar.to === null && bar.label === label);
    if (open) open.to = at;
  }
}

/** The end of an element also ends its inner activity and supervisors. */
function close({ bars }: Row, at: number): void {
  const open = bars.at(-1);
  if (open?.to === null) open.to = at;
}

/** Distinct times of records, in order. */
export const moments = (records: readonly Record[]): number[] => [...new Set(records.map(({ at }) => at))].sort((a, b) => a - b);

/** The next or previous moment; null if there is none. */
export function beside(all: readonly number[], at: number, by: -1 | 1): number | null {
  const near = 1e-6;
  const found = by > 0 ? all.find((each) => each > at + near) : all.findLast((each) => each < at - near);
  return found ?? null;
}

/** The visible part of a run, in seconds. */
export interface Window {
  from: number;
  to: number;
}

/** Shortest window, seconds. */
const LEAST = 0.05;

/** Zooms around a moment, within the run. */
export function zoomed({ from, to }: Window, around: number, factor: number, end: number): Window {
  const length = Math.max(LEAST, Math.min((to - from) * factor, Math.max(end, LEAST)));
  const share = to > from ? (around - from) / (to - from) : 0;
  return within({ from: around - share * length, to: around - share * length + length }, end);
}

/** Moves a window to within the run. */
export function within({ from, to }: Window, end: number): Window {
  const length = to - from;
  const begin = Math.max(0, Math.min(from, Math.max(0, end - length)));
  return { from: begin, to: begin + length };
}

/** Positions of about eight scale lines at round seconds. */
export function scale({ from, to }: Window): number[] {
  const rough = (to - from) / 8;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= rough)!;
  const first = Math.ceil(from / step);
  return Array.from({ length: Math.floor(to / step) - first + 1 }, (_, at) => Number(((first + at) * step).toFixed(9)));
}
