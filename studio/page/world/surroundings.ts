// The world of a run, with the robot: loaded before any run, and again after each.
import { batch, effect, signal } from "@preact/signals";
import { connect } from "../server/dap";
import { putBack } from "../debug/arranged";
import { pathOf } from "../documents/addresses";
import { active, address, given, log, phase, seed, state, world } from "../debug/run";
import { current } from "../documents/documents";
import { trouble } from "../panes/files";
import { files, lsp } from "../server/session";
import { trusted } from "../jobs/trust";
import { words } from "../words";
import { extended, type Path, type Point, type World } from "./geometry";

export interface Surroundings extends World {
  /** The selectable worlds with their origin; the default is first. */
  worlds: readonly { name: string; from: string }[];
  /** Objects to drop, with outlines around their middle. */
  drops: readonly { shape: string; outline: readonly Point[] }[];
  /** Whether the robot has a camera. */
  camera: boolean;
  /** For a log: the seed of its run, and why it is incomplete. */
  seed: string | null;
  cutShort: string | null;
}

export interface Stimulus {
  words: string;
  help: string;
  /** Whether it stops the run. */
  stops: boolean;
}

export interface Fault {
  words: string;
  help: string;
  amount: { name: string; unit: string; range: [number, number]; default: number } | null;
}

export interface Device {
  name: string;
  help: string;
  stimuli: readonly Stimulus[];
  faults: readonly Fault[];
  /** The accessible description, and that of its parts. */
  signals: readonly { words: string; help: string }[];
}

/** The world; null if unknown. */
export const surroundings = signal<Surroundings | null>(null);
/** Why it is unknown, as a sentence; empty if it is known. */
export const missing = signal("");
/** The slow step in progress. */
export const awaited = signal("");
export const devices = signal<readonly Device[]>([]);
/** The robot's path in the displayed run. */
export const path = signal<Path>([]);

let asked = 0;

async function askWorld(uri: string, chosen: string | null, log = ""): Promise<void> {
  const own = ++asked;
  const dap = connect(address(), () => {});
  dap.on("output", ({ output }) => own === asked && batch(() => ([awaited.value, missing.value] = [String(output).trim(), ""])));
  try {
    const found = await dap.request<Surroundings>("afp/world", { ...(log ? { log } : {}), program: uri ? pathOf(uri) : "", ...(chosen === null ? {} : { world: chosen }) });
    if (own === asked) batch(() => ([surroundings.value, missing.value] = [found, ""]));
    if (own === asked && found.cutShort) trouble.value = words.logCut(log.split("/").at(-1)!, found.cutShort);
  } catch (why) {
    if (own === asked) refuse((why as Error).message, chosen);
  } finally {
    if (own === asked) awaited.value = "";
    dap.close();
  }
}

/** If a selected world cannot be loaded, the current one stays. */
function refuse(why: string, chosen: string | null): void {
  batch(() => {
    if (chosen === null) [surroundings.value, missing.value] = [null, why];
    else [world.value, trouble.value] = [null, why];
  });
}

/** Loads the selected world again. */
export const reload = (): Promise<void> => askWorld(current.peek(), world.peek());

/** Retries, and asks for trust if that was the reason. */
export const again = async (): Promise<void> => void ((await trusted(current.peek())) && (await askWorld(current.peek(), null)));

async function askRobot(uri: string): Promise<void> {
  const found = await lsp().request<{ devices: Device[] }>("afp/robot", { textDocument: { uri } }).catch(() => null);
  if (current.peek() === uri) devices.value = found?.devices ?? [];
}

export function begin(): () => void {
  let before: string | null = null;
  const asks = effect(() => {
    const [uri, connected, runs, chosen, shown] = [current.value, lsp().open.value, active.value, world.value, log.value];
    // New or removed files may be worlds.
    void files.value;
    if (connected && shown && !before?.startsWith("log")) void askWorld("", null, shown);
    if (shown) before = `log ${shown}`;
    // The run has a world now, because the folder was untrusted before.
    if (connected && phase.value === "running" && !shown && missing.peek()) void askWorld(uri, null);
    if (!connected || runs || shown) return;
    const other = before !== uri;
    before = uri;
    if (other) [world.value, given.value] = [null, {}];
    if (other) putBack();
    if (!other || chosen === null) void askWorld(uri, other ? null : chosen);
  });
  const robots = effect(() => {
    if (current.value && lsp().open.value) void askRobot(current.value);
  });
  const paths = state.subscribe((now) => {
    const before = path.peek();
    if (now?.pose) path.value = extended(before, now.pose, now.at);
    else if (!now && before.length) path.value = [];
  });
  return () => {
    asks();
    robots();
    paths();
  };
}

/** Selects the world of the next run; the first of the list is the default. */
export function choose(name: string): void {
  putBack();
  world.value = name === surroundings.peek()?.worlds[0]?.name ? null : name;
}

/** Sets the noise seed of the next run; returns whether the text is valid. */
export function sow(text: string): boolean {
  const fits = /^\d+$/.test(text.trim()) && Number.isSafeInteger(Number(text));
  if (fits) seed.value = Number(text);
  return fits;
}
