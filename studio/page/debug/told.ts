// The messages of a debugger about a run.

export type Phase = "idle" | "starting" | "running" | "held" | "over";

export interface Forced {
  path: string;
  value?: string;
  /** Seconds of the run. */
  until: number;
}

/** The state, sent by the debugger some twenty times a second. */
export interface State {
  at: number;
  stack: string[];
  watching: string[];
  entries: Record<string, string>;
  held: boolean;
  /** Where the robot is, metres and radians; null for one that does not say so. */
  pose: readonly [number, number, number] | null;
  /** A force, with its end; without a value it is a state or event. */
  forced: readonly Forced[];
  /** The hashes of the texts that run, by their paths. */
  sources: { readonly [path: string]: string };
  /** Where things are that move, by their ids. */
  moving: readonly { id: string; outline: readonly (readonly [number, number])[] }[];
}

export interface Ended {
  ending: "ok" | "interrupted" | "error";
  /** The edge by which the plan ended, as a path; or who or what made it end. */
  by: { edge?: string; client?: string; until?: number } | null;
  at: number;
  sentences: string[];
  /** The command line that repeats the run; null where there is none. */
  again: string | null;
}

/** A line of what happened, and where the text says so. */
export interface Said {
  text: string;
  kind: string;
  path: string | null;
  line: number;
}
