// Jobs that the server does for the page: what goes on, what it has said, what it came to.
import { signal } from "@preact/signals";
import { lsp } from "./session";
import { trusted } from "./trust";
import { words } from "./words";

export interface Done {
  id: number;
  ok: boolean;
  /** The exit code; null where it was ended. */
  code: number | null;
  results: readonly any[];
  said: string;
}

export interface Job {
  id: number;
  title: string;
  /** The last thing that it has said. */
  last: string;
}

/** What goes on. */
export const running = signal<readonly Job[]>([]);
/** Everything that jobs have said, a line each. */
export const said = signal<readonly string[]>([]);
/** Lines that are kept. */
const MOST = 2000;

const waiting = new Map<number, (done: Done) => void>();
const early = new Map<number, Done>();

/** Does a job and waits for its end; null where the folder is not trusted. */
export async function run(title: string, order: { kind: string; [more: string]: unknown }): Promise<Done | null> {
  if (order.kind !== "new" && !(await trusted(order.file, order.kind === "build"))) return null;
  const { id } = await lsp().request<{ id: number }>("afp/job", order);
  running.value = [...running.peek(), { id, title, last: "" }];
  say([`> ${title}`]);
  const done = early.get(id) ?? (await new Promise<Done>((done) => waiting.set(id, done)));
  early.delete(id);
  running.value = running.peek().filter((job) => job.id !== id);
  return done;
}

export const end = (id: number): Promise<unknown> => lsp().request("afp/endJob", { id });

function say(lines: readonly string[]): void {
  said.value = [...said.peek(), ...lines].slice(-MOST);
}

/** Begins to hear of them. */
export function begin(): void {
  lsp().on("afp/jobSaid", ({ id, text }: { id: number; text: string }) => {
    const lines = text.split("\n");
    running.value = running.peek().map((job) => (job.id === id ? { ...job, last: lines.at(-1)! } : job));
    say(lines);
  });
  lsp().on("afp/jobDone", (done: Done) => {
    const wait = waiting.get(done.id);
    waiting.delete(done.id);
    if (wait) wait(done);
    else early.set(done.id, done);
  });
  // Another server knows nothing of them.
  lsp().open.subscribe((open) => {
    if (open) return;
    for (const [id, wait] of waiting) wait({ id, ok: false, code: null, results: [], said: words.connectionLost });
    waiting.clear();
  });
}
