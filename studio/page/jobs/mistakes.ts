// An error, warning or note from the command line's `--json`: from the compiler of plans, the
// reader of the project file, or the Rust compiler, mapped to the plan.

/** Where; line and column count from 1. */
export interface Place {
  /** As the command line names it. */
  file: string;
  line: number;
  column: number;
}

export interface Mistake {
  /** The code of a page in the book; Rust errors have none. */
  code: string | null;
  message: string;
  place: Place | null;
  /** A suggestion; empty for none. */
  help: string;
}

/** The errors among the objects of a job. */
export const mistakes = (objects: readonly any[]): Mistake[] => objects.filter(({ severity }) => severity === "error");
