// Results of scenarios, sweeps and builds, until the next ones.
import { batch, computed, signal } from "@preact/signals";
import { uriOf } from "../documents/addresses";
import { openLogAt } from "../debug/logs";
import { world } from "../debug/run";
import { current, nameOf, onText } from "../documents/documents";
import { drawing } from "../drawing/model";
import { run, takeUp, type Done } from "./jobs";
import { mistakes, type Mistake, type Place } from "./mistakes";
import { report, trouble } from "../panes/files";
import { itemAt } from "../plan/places";
import type { Position } from "../documents/positions";
import type { Going, Order } from "../server/session";
import { words } from "../words";

/** An expectation that was not met. */
export interface Broken {
  text: string;
  /** The paths and words in it. */
  names: readonly string[];
  at_s: number;
  why: string;
}

export interface Result {
  scenario: string;
  plan: string;
  file: string;
  line: number;
  passed: boolean;
  log: string | null;
  simulated_s?: number;
  broken?: readonly Broken[];
  /** An error of the scenario itself. */
  error?: string;
}

/** Usage count of an item in scenarios, by path. */
export interface Part {
  kind: string;
  name: string;
  count: number;
}

export const results = signal<readonly Result[] | null>(null);
export const coverage = signal<readonly { coverage: string; parts: readonly Part[] }[]>([]);
/** Whether the drawing shows usage. */
export const shown = signal(true);
/** The running scenarios. */
export const busy = signal("");

/** Results of the last sweep: a line per run, the summary, and the world (null for the plan's). */
export const swept = signal<readonly object[]>([]);
export const sweptIn = signal<string | null>(null);
/** An error with its document, if known, and the item of that document's drawing. */
export interface Wrong extends Mistake {
  uri: string | null;
  item: string | null;
}

/** Result of the last build, with its errors. */
export const built = signal<{ ok: boolean; wrong: readonly Wrong[] } | null>(null);

async function doing<T>(what: string, work: () => Promise<T>): Promise<T | null> {
  if (busy.peek()) return null;
  busy.value = what;
  trouble.value = null;
  try {
    return await work();
  } catch (why) {
    report(why);
    return null;
  } finally {
    busy.value = "";
  }
}

/** A kind of job: name, progress text, and the handling of results. */
interface Kind {
  title: string;
  meanwhile: string;
  take(done: Done, order: Order): unknown;
}

const KINDS: { readonly [kind: string]: Kind } = {
  generate: {
    title: words.writeSome,
    meanwhile: words.writing,
    take(done) {
      if (!done.ok) failed(done);
      // The other results no longer cover all scenarios.
      results.value = null;
    },
  },
  test: {
    title: words.runScenarios,
    meanwhile: words.runningScenarios,
    take(done) {
      const all = done.results.filter((one): one is Result => typeof one.scenario === "string");
      coverage.value = done.results.filter((one) => typeof one.coverage === "string");
      results.value = all.length ? [...all.filter(({ passed }) => !passed), ...all.filter(({ passed }) => passed)] : null;
      if (!all.length) failed(done);
    },
  },
  sweep: {
    title: words.sweep,
    meanwhile: words.sweeping,
    take(done, { world }) {
      const runs = done.results.filter(({ severity }) => severity !== "error");
      batch(() => ([swept.value, sweptIn.value] = [runs, typeof world === "string" ? world : null]));
      if (!runs.length) failed(done);
    },
  },
  build: {
    title: words.build,
    meanwhile: words.building,
    async take(done) {
      built.value = { ok: done.ok, wrong: await Promise.all(mistakes(done.results).map(placed)) };
      textsChange ??= onText(outdate);
    },
  },
};

const start = (kind: string, more: object = {}): Promise<void | null> => {
  const [{ title, meanwhile, take }, order] = [KINDS[kind]!, { kind, ...more }];
  return doing(meanwhile, async () => {
    const done = await run(title, order);
    if (done) await take(done, order);
  });
};

/** Resumes a job that continued during a reload. */
export function resume(job: Going): void {
  const kind = KINDS[job.order.kind];
  const done = takeUp(job, kind?.title ?? words.newProject);
  if (kind) void doing(kind.meanwhile, async () => void (await kind.take(await done, job.order)));
}

const shownPlan = () => ({ file: current.peek(), plan: drawing.peek()?.plan ?? "" });

/** Generates scenarios for the displayed plan. */
export const writeSome = () => start("generate", { file: current.peek() });

export const runAll = () => start("test");

/** Runs the plan many times, in the selected world. */
export const sweep = (seeds: string, vary: readonly string[], until: string) =>
  start("sweep", { ...shownPlan(), seeds, vary, until, ...(world.peek() === null ? {} : { world: world.peek() }) });

export const build = () => start("build", shownPlan());

let textsChange: (() => void) | null = null;

/** After a change of a text, the items of its errors are unknown. */
function outdate(uri: string): void {
  const last = built.peek();
  if (!last?.wrong.some((one) => one.uri === uri && one.item)) return;
  built.value = { ...last, wrong: last.wrong.map((one) => (one.uri === uri ? { ...one, item: null } : one)) };
}

/** Adds the document and item of an error. */
async function placed(mistake: Mistake): Promise<Wrong> {
  const { place } = mistake;
  if (!place) return { ...mistake, uri: null, item: null };
  const uri = uriOf(place.file);
  const found = uri.endsWith(".afp") ? await itemAt(uri, placeOf(place)).catch(() => null) : null;
  return { ...mistake, uri, item: found?.item ?? null };
}

export const placeOf = ({ line, column }: Place): Position => ({ line: line - 1, character: column - 1 });

/** The page's fields, by option of the command line. */
const FIELDS: { readonly [option: string]: string } = { seeds: words.seeds, vary: words.vary, until: words.until };

/** Throws the reason why a job has no result. */
function failed({ results, said }: Done): never {
  const wrong = results.find(({ severity, option }) => severity === "error" && option !== undefined);
  const field = FIELDS[wrong?.option ?? ""];
  if (wrong && field) throw new Error(`${words.fieldWrong(field, wrong.value ?? "")}${wrong.message}`);
  throw new Error(wrong?.message || said.trim() || words.jobFailed);
}

/** Shows the moment of a scenario's failure. */
export async function showFailure({ log, broken, file }: Result): Promise<void> {
  if (!log) {
    trouble.value = words.noLog(nameOf(uriOf(file)));
    return;
  }
  await openLogAt(uriOf(log), broken?.[0]?.at_s ?? 0);
}

/** The items of a plan that names of an expectation mean: for each name, the longest path. */
export function named(names: readonly string[], plan: string, items: Iterable<string>): string[] {
  const known = new Set(items);
  const found = names.flatMap((name) => {
    const parts = name.split(".");
    const items = parts.map((_, end) => [plan, ...parts.slice(0, end + 1)].join("."));
    return items.findLast((item) => known.has(item)) ?? [];
  });
  return [...new Set(found)];
}

/** The items of the drawing: elements and their parts. */
export const itemsOf = (drawn: { elements: ReadonlyMap<string, { item: string; pieces: readonly { item: string }[] }> }): Set<string> =>
  new Set([...drawn.elements.values()].flatMap(({ item, pieces }) => [item, ...pieces.map((piece) => piece.item)]));

/** Number of failed scenarios and build errors per item, and unused items. */
export const onDrawing = computed<{ failed: ReadonlyMap<string, number>; unused: ReadonlySet<string> }>(() => {
  const [drawn, all, wrong] = [drawing.value, results.value, built.value?.wrong ?? []];
  const failed = new Map<string, number>();
  if (!drawn?.plan) return { failed, unused: new Set() };
  const items = itemsOf(drawn);
  for (const { uri, item } of wrong) if (uri === drawn.uri && item && items.has(item)) failed.set(item, (failed.get(item) ?? 0) + 1);
  if (!all || !shown.value) return { failed, unused: new Set() };
  for (const { plan, passed, broken } of all) {
    if (passed || plan !== drawn.plan) continue;
    const found = new Set((broken ?? []).flatMap(({ names }) => named(names, plan, items)));
    for (const item of found) failed.set(item, (failed.get(item) ?? 0) + 1);
  }
  const parts = coverage.value.find(({ coverage }) => coverage === drawn.plan)?.parts ?? [];
  const unused = parts.filter(({ count, kind }) => count === 0 && kind === "elements").map(({ name }) => `${drawn.plan}.${name}`);
  return { failed, unused: new Set(unused.filter((item) => items.has(item))) };
});
