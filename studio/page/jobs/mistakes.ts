// What is wrong, as the command line says it with `--json`: an object for each error, warning and note, whoever has found it: the
// compiler of plans, the reader of the project file, or the compiler of Rust, led back to the plan.

/** Where; line and column count from 1. */
export interface Place {
  /** As the command line names it. */
  file: string;
  line: number;
  column: number;
}

export interface Mistake {
  /** What the book has a page of; errors of Rust have none. */
  code: string | null;
  message: string;
  place: Place | null;
  /** What to do; empty for nothing. */
  help: string;
}

/** The errors among the objects of a job. */
export const mistakes = (objects: readonly any[]): Mistake[] => objects.filter(({ severity }) => severity === "error");
