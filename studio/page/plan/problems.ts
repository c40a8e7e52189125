// Diagnostics of each text, with their fixes.
import { computed, effect, signal } from "@preact/signals";
import { current } from "../documents/documents";
import { apply, type WorkspaceEdit } from "../documents/edits";
import type { Range } from "../documents/positions";
import { lsp } from "../server/session";

export type Severity = "error" | "warning" | "note";

export interface Diagnostic {
  range: Range;
  severity?: number;
  code?: string;
  message: string;
  relatedInformation?: { location: { uri: string; range: Range }; message: string }[];
}

export interface Action {
  title: string;
  kind?: string;
  isPreferred?: boolean;
  diagnostics?: Diagnostic[];
  edit: WorkspaceEdit;
}

export const diagnostics = signal<ReadonlyMap<string, { version: number | null; list: Diagnostic[] }>>(new Map());
/** Problems of the displayed file, errors first, then in source order. */
export const problems = computed(() => problemsOf(current.value));
export function problemsOf(uri: string): Diagnostic[] {
  const list = diagnostics.value.get(uri)?.list ?? [];
  const place = (each: Diagnostic) => each.range.start.line * 1e5 + each.range.start.character;
  return [...list].sort((a, b) => (a.severity ?? 1) - (b.severity ?? 1) || place(a) - place(b));
}
export const number = (severity: Severity): number => problems.value.filter((each) => severityOf(each) === severity).length;
export const severityOf = ({ severity }: Diagnostic): Severity => (severity === 2 ? "warning" : (severity ?? 1) > 2 ? "note" : "error");

/** Splits a message and its help. */
export function said({ message }: Diagnostic): { message: string; help: string | null } {
  const [first, ...rest] = message.split("\nhelp: ");
  return { message: first!, help: rest.length ? rest.join("\n") : null };
}

/** The code actions at a place. */
export const actionsAt = async (uri: string, range: Range, list: Diagnostic[], only?: string[]): Promise<Action[]> =>
  (await lsp().request<Action[] | null>("textDocument/codeAction", {
    textDocument: { uri },
    range,
    context: { diagnostics: list, ...(only ? { only } : {}) },
  })) ?? [];

export async function fixesOf(uri: string, problem: Diagnostic): Promise<Action[]> {
  const all = await actionsAt(uri, problem.range, [problem], ["quickfix"]);
  return all.filter((each) => each.diagnostics?.some((mended) => mended.code === problem.code && samePlace(mended.range, problem.range)));
}

const samePlace = (a: Range, b: Range): boolean => JSON.stringify(a) === JSON.stringify(b);

/** Applies a fix as one history entry. */
export const mend = (action: Action): Promise<void> => apply(action.edit, action.title);

/** Fixes of the displayed problems, requested while visible. */
export const fixes = signal<ReadonlyMap<Diagnostic, Action[]>>(new Map());
const wanted = signal(0);

/** Requests fixes until the returned function is called. */
export function askFixes(): () => void {
  wanted.value = wanted.peek() + 1;
  return () => {
    wanted.value = wanted.peek() - 1;
  };
}

export function begin(): void {
  lsp().on("textDocument/publishDiagnostics", ({ uri, version, diagnostics: list }) => {
    diagnostics.value = new Map(diagnostics.peek()).set(uri, { version: version ?? null, list });
  });
  let timer: ReturnType<typeof setTimeout>;
  effect(() => {
    const [list, uri] = [problems.value.slice(0, 40), current.value];
    clearTimeout(timer);
    if (!wanted.value || !list.length) return;
    timer = setTimeout(async () => {
      const all = await Promise.all(list.map((each) => fixesOf(uri, each).catch(() => [])));
      if (problems.peek()[0] === list[0]) fixes.value = new Map(list.map((each, at) => [each, all[at]!]));
    }, 200);
  });
}
