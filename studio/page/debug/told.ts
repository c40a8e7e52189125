// Messages of the debugger about a run.

export type Phase = "idle" | "starting" | "running" | "held" | "over";

export interface Forced {
  path: string;
  value?: string;
  /** Seconds of the run. */
  until: number;
}

/** A value as a number, in a unit that stays during the run. */
export interface Plotted {
  number: number;
  unit: string;
}

/** The state, sent about twenty times a second. */
export interface State {
  at: number;
  stack: string[];
  watching: string[];
  /** Times since when elements are suspended, by path. */
  suspended: Record<string, number>;
  entries: Record<string, string>;
  numbers: Record<string, Plotted>;
  held: boolean;
  /** Robot pose in metres and radians; null if unknown. */
  pose: readonly [number, number, number] | null;
  /** Forced values with their end; without a value, a forced state or event. */
  forced: readonly Forced[];
  /** Hashes of the running texts, by path. */
  sources: { readonly [path: string]: string };
  /** Outlines of moving objects, by id. */
  moving: readonly { id: string; outline: readonly (readonly [number, number])[] }[];
}

export interface Ended {
  ending: "ok" | "interrupted" | "error";
  /** The edge that ended the plan, as a path, or the client or time limit. */
  by: { edge?: string; client?: string; until?: number } | null;
  at: number;
  sentences: string[];
  /** Command line that repeats the run; null if there is none. */
  again: string | null;
}

/** A message, with its source line. */
export interface Said {
  text: string;
  kind: string;
  path: string | null;
  line: number;
}
