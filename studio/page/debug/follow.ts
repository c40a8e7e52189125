// Maps the paths of a run to items of the displayed plan.

/** An active plan: its path in the run (empty for the outermost), and its name. */
export interface Frame {
  path: string;
  plan: string;
  /** Address of its file, if known. */
  uri?: string;
}

export interface At {
  /** The innermost active elements of the displayed plan, and elements with an active sub-plan. */
  active: { item: string; inside: boolean }[];
  watching: string[];
}

/** The frame of the displayed plan; the innermost if it is active several times. */
export const frameOf = (frames: readonly Frame[], plan: string | null): Frame | undefined => [...frames].reverse().find((frame) => frame.plan === plan);

/** The active items of the displayed plan. */
export function at(frames: readonly Frame[], plan: string | null, stack: readonly string[], watching: readonly string[]): At {
  const frame = frameOf(frames, plan);
  if (!frame) return { active: [], watching: [] };
  const begin = frame.path ? `${frame.path}.` : "";
  const own = (path: string): string[] => (path.startsWith(begin) && path !== frame.path ? path.slice(begin.length).split(".") : []);
  const deepest = Math.max(0, ...stack.map((path) => path.split(".").length));
  const active = stack.flatMap((path) => {
    const names = own(path);
    return names.length === 1 ? [{ item: `${plan}.${names[0]}`, inside: path.split(".").length < deepest }] : [];
  });
  // A global supervisor's path has one name, a local supervisor's two; longer paths belong to
  // sub-plans.
  const nested = new Set(frames.map((each) => each.path));
  const watches = watching.filter((path) => {
    const names = own(path);
    const owner = names.length === 2 ? `${begin}${names[0]}` : "";
    return names.length === 1 || (names.length === 2 && !nested.has(owner));
  });
  return { active, watching: watches.map((path) => `${plan}.${own(path).join(".")}`) };
}

/** The suspended items of the displayed plan, each with the time since when. */
export function suspendedIn(frames: readonly Frame[], plan: string | null, suspended: Readonly<Record<string, number>>): [item: string, since: number][] {
  const frame = frameOf(frames, plan);
  if (!frame) return [];
  const begin = frame.path ? `${frame.path}.` : "";
  return Object.entries(suspended).flatMap(([path, since]) => {
    const name = path.startsWith(begin) ? path.slice(begin.length) : "";
    return name && !name.includes(".") ? [[`${plan}.${name}`, since] as [string, number]] : [];
  });
}

/** The active element inside an active sub-plan, by its names from there; empty without one. */
export function within(frames: readonly Frame[], plan: string | null, stack: readonly string[], item: string): string {
  const frame = frameOf(frames, plan);
  const name = item.slice(item.lastIndexOf(".") + 1);
  const begin = `${frame?.path ? `${frame.path}.` : ""}${name}.`;
  const [deepest = ""] = stack.filter((path) => path.startsWith(begin)).sort((a, b) => b.length - a.length);
  return deepest.slice(begin.length).split(".").join(" › ");
}

interface Way {
  id: string;
  from: string;
  to: string;
}

/** Maximum number of elements on one path of computations. */
const THROUGH = 8;

/**
 * The edges from one active element to the next through computations, if the path is unambiguous.
 */
export function taken(edges: Iterable<Way>, before: string | null, after: string | null, isPassed: (item: string) => boolean = () => false): string[] {
  if (!after || before === null || before === after) return [];
  const all = [...edges];
  const ways = (from: (edge: Way) => boolean, left: number): string[][] =>
    all.filter(from).flatMap(({ id, to }) => {
      if (to === after) return [[id]];
      const on = left > 0 && isPassed(to) ? ways((edge) => edge.from === to, left - 1) : [];
      return on.map((rest) => [id, ...rest]);
    });
  const found = ways(({ from }) => from === before || from.startsWith(`${before}.`), THROUGH);
  return found.length === 1 ? found[0]! : [];
}
