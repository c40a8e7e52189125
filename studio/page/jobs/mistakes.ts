// Errors, warnings and notes from the command line's `--json`: from the plan compiler, the project
// file's reader, or the Rust compiler, mapped to the plan.

/** A source position; line and column count from 1. */
export interface Place {
  /** Path as in the command line's output. */
  file: string;
  line: number;
  column: number;
}

export interface Mistake {
  /** Code of a page in the book; Rust errors have none. */
  code: string | null;
  message: string;
  place: Place | null;
  /** A suggestion; empty for none. */
  help: string;
}

/** The errors among a job's objects. */
export const mistakes = (objects: readonly any[]): Mistake[] => objects.filter(({ severity }) => severity === "error");
