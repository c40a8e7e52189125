// The run of a plan: start, pause, step and end, and its state in the page.
import { computed, effect, signal } from "@preact/signals";
import { pathOf } from "../documents/addresses";
import { connect, type Dap } from "../server/dap";
import { current } from "../documents/documents";
import { report, trouble } from "../panes/files";
import { reveal } from "../plan/places";
import type { Position } from "../documents/positions";
import { words } from "../words";
import { files } from "../server/session";
import { sensed, type Sensed } from "../world/sensed";
import * as arranged from "./arranged";
import { find, pathThere, robot, roles, uriHere, type Roles } from "./attached";
import { asked, breakpoints, filters } from "./breakpoints";
import type { Frame } from "./follow";
import { olderThan } from "./older";
import { canRun, toRun } from "./ready";
import type { Ended, Phase, Said, State } from "./told";
import { extended, packed, type Record } from "./trace";

export const phase = signal<Phase>("idle");
export const state = signal<State | null>(null);
export const ended = signal<Ended | null>(null);
export const said = signal<readonly Said[]>([]);
/** The running plan and its active sub-plans, outermost first. */
export const frames = signal<readonly Frame[]>([]);
export const older = olderThan(state);
/** Simulation speed; null is as fast as possible. */
export const speed = signal<number | null>(1);
/** World of the next run; null for the project's. */
export const world = signal<string | null>(null);
/** Noise seed of the next run. */
export const seed = signal(0);
/** Inputs of the next runs, with units; others use the plan's values. */
export const given = signal<{ readonly [input: string]: string }>({});
export const records = signal<readonly Record[]>([]);
/** The displayed log; empty for a run. */
export const log = signal("");
/** The moment at which the run continues a log, in seconds; null for other runs. */
export const forked = signal<number | null>(null);
/** Reason for the stop. */
export const why = signal("");
/** The debugger's last answer about its abilities, for this run and this page. */
const abilities = signal<{ supportsSetVariable?: boolean; supportsStepBack?: boolean }>({});
export const active = computed(() => phase.value === "running" || phase.value === "held" || phase.value === "starting");

/** Whether entries can be changed. */
export const changes = computed(() => active.value && abilities.value.supportsSetVariable === true);
/** Whether the run can go back. */
export const turns = computed(() => abilities.value.supportsStepBack === true);

/** Time for the debugger to report the end of a run, milliseconds. */
const FAREWELL = 2000;
/** Maximum number of lines. */
const MOST = 1000;

let dap: Dap | null = null;
/** File of the current or last plan. */
let ran = "";

export const address = (): string => `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/dap`;

/** Runs the displayed plan, or the plan that led to it; otherwise shows the reason. */
export async function start(hold = false): Promise<void> {
  if (active.value) return;
  try {
    const { uri, plan } = toRun();
    if (!(await canRun(given.value)) || active.value) return;
    const program = `${pathOf(uri)}${plan ? `:${plan}` : ""}`;
    ran = uri;
    await launch({ program, ...wantedWorld(), ...{ stopOnEntry: hold, seed: seed.value, set: given.value } }, plan);
  } catch (why) {
    report(why);
  }
}

const wantedWorld = (): object => ({
  ...(world.value === null ? {} : { world: world.value }),
  ...(arranged.start.value ? { start: arranged.start.value } : {}),
});

/** Opens a log at its beginning. */
export async function openLog(path: string): Promise<void> {
  await leave();
  trouble.value = null;
  const still = { stopOnEntry: true };
  await launch({ log: path, ...still }, "");
}

/** Joins the run of a robot: a host of ssh, or a socket. */
export async function attach(place: string): Promise<void> {
  await leave();
  trouble.value = null;
  await launch(place.includes("/") ? { socket: place } : { host: place }, "", place);
}

/** Lets a robot drive on without this page, or ends a simulated run. */
export async function leave(): Promise<void> {
  if (!robot.peek()) await stop();
  dap?.close();
  [dap, phase.value] = [null, "idle"];
  dismiss();
}

/** Continues the displayed log in the simulator, with the text of this folder if there is one. */
export async function fork(): Promise<void> {
  const [own, at, begun] = [dap, state.peek()?.at, launched.peek()];
  if (!own || at === undefined || !begun || !log.peek()) return;
  const isHere = files.peek().some(({ uri }) => uri === begun.uri);
  try {
    await own.request("afp/fork", isHere ? { program: `${pathOf(begun.uri)}:${begun.plan}` } : {});
  } catch (why) {
    return report(why);
  }
  // The records of the log stay before those of the simulation, whose steps begin again.
  const last = 1 + (records.peek().at(-1)?.step ?? 0);
  const kept = records.peek().flatMap((record) => (record.at <= at ? [{ ...record, step: record.step - last }] : []));
  records.value = [...kept, { at, step: -1, kind: "forked", path: "", text: words.forkedAt(at) }];
  [log.value, forked.value, ran] = ["", at, begun.uri];
  frames.value = [{ path: "", plan: begun.plan, uri: begun.uri }];
}

type What = { program: string } | { log: string } | { host: string } | { socket: string };

async function launch(what: What, plan: string, place = ""): Promise<void> {
  [phase.value, state.value, ended.value, said.value, why.value] = ["starting", null, null, [], ""];
  sensed.value = null;
  [records.value, log.value] = [[], "log" in what ? what.log : ""];
  [robot.value, roles.value, forked.value] = [place, null, null];
  frames.value = [{ path: "", plan }];
  // A finished run can still be queried.
  dap?.close();
  const own = connect(address(), () => dap === own && lost());
  dap = own;
  hear(own);
  try {
    abilities.value = await own.request("initialize", { adapterID: "afp", clientID: "afp-studio", clientName: words.studio, linesStartAt1: true, columnsStartAt1: true });
    const more = place ? { lease: true } : speed.value === null ? {} : { speed: speed.value };
    const begun = await own.request<Begun | null>(place ? "attach" : "launch", { ...what, ...more });
    if (!begun) return;
    frames.value = [{ path: "", plan: begun.plan }];
    if (place) find(begun.files);
    if (place) ran = uriHere(begun.file);
    if (place || "log" in what) launched.value = { plan: begun.plan, uri: uriHere(begun.file) };
  } catch (reason) {
    failed(reason);
  }
}

interface Begun {
  plan: string;
  file: string;
  files: readonly string[];
}

/** Plan and file of the last log or robot. */
export const launched = signal<{ plan: string; uri: string } | null>(null);

/** Handles the debugger's events. */
function hear(own: Dap): void {
  own.on("initialized", () => void configure(own).catch(failed));
  own.on("afp/state", (now: State) => dap === own && take(own, now));
  own.on("afp/sensed", (now: { at: number; sensed: Sensed[] }) => dap === own && (sensed.value = now));
  own.on("afp/trace", (now: { records: Record[] }) => {
    if (dap === own) records.value = extended(records.peek(), now.records.map(packed));
  });
  own.on("afp/ended", (now: Ended) => dap === own && finish(now));
  own.on("capabilities", ({ capabilities }) => dap === own && (abilities.value = { ...abilities.peek(), ...capabilities }));
  own.on("afp/role", (now) => dap === own && becomes(own, now));
  own.on("continued", () => dap === own && phase.peek() === "held" && (phase.value = "running"));
  own.on("stopped", ({ description }) => {
    if (dap !== own) return;
    hurry(speed.peek());
    [phase.value, why.value] = ["held", description ?? ""];
  });
  own.on("terminated", () => dap === own && phase.value !== "over" && finish(null));
  own.on("output", ({ category, output, source, line }) => {
    const one = { text: String(output).trimEnd(), kind: category ?? "console", path: source?.path ?? null, line: line ?? 0 };
    said.value = [...said.peek(), one].slice(-MOST);
    if (category === "stderr") trouble.value = one.text.trim();
  });
}

/** The debugger, once it accepts breakpoints; null before a run. */
let ready: Dap | null = null;

async function configure(own: Dap): Promise<void> {
  await own.request("afp/subscribe", { state: true, trace: true, sensed: true });
  if (robot.peek() && (await own.request<Roles>("afp/role")).operator === null) await own.request("afp/role", { take: "operator", lease: true });
  ready = own;
  await send(own);
  if (!log.peek() && !robot.peek()) for (const { command, args } of arranged.requests()) await own.request(command, args);
  await own.request("configurationDone");
  if (phase.value === "starting") phase.value = "running";
}

/** A page that takes over a robot sends its breakpoints. They are gone after a lost operator. */
function becomes(own: Dap, now: Roles): void {
  const before = roles.peek();
  roles.value = now;
  if (robot.peek() && before && before.operator !== now.operator && now.operator === now.you && own === ready) void send(own).catch(report);
}

/** Sends the breakpoints. */
async function send(own: Dap): Promise<void> {
  const files = Object.entries(breakpoints.peek()).filter(([uri]) => pathThere(uri));
  const sent = await Promise.all(files.map(([uri, all]) => own.request<{ breakpoints: { message?: string }[] }>("setBreakpoints", { source: { path: pathThere(uri) }, breakpoints: asked(all) })));
  await own.request("setExceptionBreakpoints", { filters: filters.peek() });
  // A file that the plan does not use has breakpoints of other plans.
  const open = sent[files.findIndex(([uri]) => uri === current.peek())];
  const wrong = open?.breakpoints.find(({ message }) => message);
  if (wrong) trouble.value = wrong.message!;
}

function take(own: Dap, told: State): void {
  const before = state.peek();
  const sources = Object.entries(told.sources).map(([path, hash]) => [pathOf(uriHere(path)), hash]);
  const now = { ...told, sources: Object.fromEntries(sources) };
  state.value = now;
  const steady = before !== null && before.stack.join() === now.stack.join();
  if (!steady) void follow(own, now).catch(() => {});
}

/** Requests the plans of the active elements, if there are sub-plans. */
async function follow(own: Dap, now: State): Promise<void> {
  const outermost = { path: "", plan: frames.peek()[0]?.plan ?? "", uri: ran };
  if (now.stack.length < 2) {
    frames.value = [outermost];
    return;
  }
  const { stackFrames } = await own.request<{ stackFrames: { name: string; source?: { path?: string } }[] }>("stackTrace", { threadId: 1 });
  const named = new Map(stackFrames.map(({ name }) => name.split(": ") as [string, string]));
  const files = new Map(stackFrames.map(({ name, source }) => [name.split(": ")[0], source?.path]));
  if (state.peek()?.stack.join() !== now.stack.join()) return;
  const stack = [...now.stack].sort((a, b) => a.length - b.length);
  // A plan's elements are in the plan's file.
  const uri = (at: number): { uri?: string } => (files.get(stack[at + 1]!) ? { uri: uriHere(files.get(stack[at + 1]!)!) } : {});
  frames.value = [outermost, ...stack.slice(0, -1).map((path, at) => ({ path, plan: named.get(path) ?? "", ...uri(at) }))];
}

function finish(how: Ended | null): void {
  phase.value = "over";
  if (how) ended.value = how;
}

function lost(): void {
  if (active.peek()) report(new Error(robot.peek() ? words.robotLost(robot.peek()) : words.runLost));
  phase.value = ended.peek() ? "over" : "idle";
  if (!ended.peek()) robot.value = "";
  dap = null;
}

function failed(reason: unknown): void {
  report(reason);
  dap?.close();
  [dap, robot.value] = [null, ""];
  phase.value = "idle";
}

/** Sends a request to the run; a rejection is shown. */
export const order = (command: string, args: object = { threadId: 1 }): Promise<unknown> | undefined => dap?.request(command, args).catch(report);

/** Sends a request in the background; null without a run or if rejected. */
export const ask = <T>(command: string, args: object = {}): Promise<T | null> => dap?.request<T>(command, args).catch(() => null) ?? Promise.resolve(null);

/** The value of a word in the run now; null without a run, or if the text has changed. */
export async function valueAt(uri: string, expression: string, at: Position): Promise<string | null> {
  if (phase.peek() === "idle" || older.peek()) return null;
  const place = { source: { path: pathThere(uri) }, line: at.line + 1, column: at.character + 1 };
  const said = await ask<{ result: string }>("evaluate", { context: "hover", expression, ...place });
  return said?.result ?? null;
}

export const pause = (): unknown => order("pause");
export const next = (): unknown => step("next");
export const into = (): unknown => step("stepIn");
export const out = (): unknown => step("stepOut");
/** Steps back before the last transition. */
export const back = (): unknown => step("stepBack");

/** Runs or continues. */
export function goOn(): unknown {
  if (phase.value !== "held") return start();
  if (!robot.peek()) phase.value = "running";
  return order("continue");
}

/** A step takes no real time; afterwards the chosen speed counts again. */
const hurry = (factor: number | null): void => void (speed.peek() !== null && !log.peek() && !robot.peek() && order("afp/speed", factor === null ? {} : { factor }));

/** Makes one step; without a run, starts a stopped one. */
function step(command: string): unknown {
  if (!active.value) return start(true);
  if (robot.peek()) return order(command);
  if (phase.value === "held") phase.value = "running";
  hurry(null);
  return order(command);
}

/** Ends the run after the debugger has reported its end. */
export async function stop(): Promise<void> {
  const own = dap;
  if (own && active.value) {
    await order("terminate", {});
    // The robot reports its end when it has stopped.
    if (robot.peek()) return;
    const end = Date.now() + FAREWELL;
    while (active.peek() && Date.now() < end) await new Promise((done) => setTimeout(done, 20));
  }
  own?.close();
  if (dap === own) dap = null;
  if (phase.value !== "over") phase.value = "idle";
}

/** Restarts with the current text. */
export async function again(): Promise<void> {
  await stop();
  dismiss();
  await start();
}

/** Repeats a run of a sweep in the studio. */
export async function repeat(run: { seed: number; values: { readonly [input: string]: { text: string } } }, where: string | null): Promise<void> {
  dismiss();
  arranged.putBack();
  const values = Object.entries(run.values).map(([name, { text }]) => [name, text]);
  [seed.value, world.value, given.value] = [run.seed, where, Object.fromEntries(values)];
  await start();
}

/** Closes the end card. */
export function dismiss(): void {
  if (active.value) return;
  [phase.value, ended.value, state.value, log.value, sensed.value] = ["idle", null, null, "", null];
  [robot.value, roles.value, forked.value] = ["", null, null];
}

/** Moves to another moment and stops; a recorded run goes back. */
export function seek(at: number): unknown {
  if (phase.peek() === "idle" || phase.peek() === "starting" || !turns.peek()) return;
  return order("afp/seek", { at });
}

export function setSpeed(factor: number | null): void {
  speed.value = factor;
  if (active.value && !robot.value) void order("afp/speed", factor === null ? {} : { factor });
}

/** Shows the source line of a message. */
export function revealSaid({ path, line }: Said): void {
  const uri = current.value;
  const place = { line: line - 1, character: 0 };
  if (path && path === pathThere(uri)) void reveal(uri, { start: place, end: place }, "other");
}

/** Starts to send breakpoints, and closes a recorded run when another file is shown. */
export function begin(): () => void {
  effect(() => {
    const { uri } = toRun();
    if (uri && uri !== ran && !log.peek()) queueMicrotask(dismiss);
  });
  return effect(() => {
    void [breakpoints.value, filters.value];
    // Lines of a changed text do not match the running text.
    if (!older.value && dap && dap === ready && active.peek()) void send(dap).catch(report);
  });
}
