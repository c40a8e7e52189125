// Completes launch configurations and chooses their adapter. It does not depend on the editor, so
// it is tested without one.

/** A configuration of launch.json; F5 without a file gives an empty one. */
export interface Launch {
  type?: string;
  request?: string;
  name?: string;
  program?: string;
  log?: string;
  port?: number;
  token?: string;
  host?: string;
  socket?: string;
  speed?: number | null;
  [more: string]: unknown;
}

/** The file of an open editor. */
export interface Open {
  path: string;
  language: string;
}

/** The default speed: people watch the robot drive. */
const REAL_TIME = 1;

/** The complete configuration, or an error message. */
export function completed(config: Launch, open: Open | null): Launch | string {
  const plan = open?.language === "afp" && open.path.endsWith(".afp") ? open.path : null;
  const isEmpty = !config.type && !config.request && !config.name;
  if (config.request === "attach") return joining(config);
  if (isEmpty && !plan) return "Open a plan first.";
  const full: Launch = isEmpty ? { name: "Debug the plan", program: plan! } : { ...config };
  if (!full.program && !full.log) return "The configuration needs a 'program', the plan's file, or a 'log'.";
  if (full.program && full.log && full.at === undefined) return "The configuration must have a 'program' or a 'log', not both.";
  Object.assign(full, { type: "afp", request: "launch" });
  if (full.speed === undefined) full.speed = REAL_TIME;
  // Without a speed, the run is as fast as possible.
  if (full.speed === null) delete full.speed;
  return full;
}

/** Whether the configuration attaches to a robot, or to a run that drives on this machine. */
export const isElsewhere = (config: Launch): boolean => config.request === "attach" && Boolean(config.host || config.socket);

/** The configuration to join a run that drives or a run of 'afpc dap --port', or an error message. */
function joining(config: Launch): Launch | string {
  if (isElsewhere(config)) return { ...config, type: "afp" };
  const both = Number.isInteger(config.port) && config.token;
  return both ? { ...config, type: "afp" } : "To join a run, the configuration needs the 'port' and the 'token' that 'afpc dap --port' printed.";
}

/** The configuration of a lens above a plan, or of a file without one. */
export const launchOf = (path: string, plan: string | null): Launch => ({
  type: "afp",
  request: "launch",
  name: plan ?? "Debug the plan",
  program: plan ? `${path}:${plan}` : path,
  speed: REAL_TIME,
});

/** A program is a file, optionally followed by the name of one of its plans. */
export function programOf(program: string): { file: string; plan: string | null } {
  const found = /^(.*\.afp):([A-Za-z_]\w*)$/.exec(program);
  return found ? { file: found[1]!, plan: found[2]! } : { file: program, plan: null };
}

/**
 * The arguments of the adapter: with the plan, so that the build of its project begins before the
 * editor waits.
 */
export const adapterOf = (launch: Launch): string[] => (launch.program ? ["dap", launch.program] : ["dap"]);

/** The arguments of `afpc` to run a plan or test a file. */
export const argumentsOf = (verb: "run" | "test", path: string, plan: string | null): string[] => [verb, verb === "run" && plan ? `${path}:${plan}` : path];
