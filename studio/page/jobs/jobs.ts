// Jobs of the server: running ones, output, results.
import { signal } from "@preact/signals";
import { going, lsp, type Going, type Order } from "../server/session";
import { trusted } from "./trust";
import { words } from "../words";

export interface Done {
  id: number;
  ok: boolean;
  /** Exit code; null if it was killed. */
  code: number | null;
  results: readonly any[];
  said: string;
}

export interface Job {
  id: number;
  title: string;
  /** Its last line. */
  last: string;
}

export const running = signal<readonly Job[]>([]);
/** Output of all jobs, by line. */
export const said = signal<readonly string[]>([]);
/** Maximum number of lines. */
const MOST = 2000;

const waiting = new Map<number, (done: Done) => void>();
const early = new Map<number, Done>();

/** Runs a job and waits for its end; null if the folder is not trusted. */
export async function run(title: string, order: Order): Promise<Done | null> {
  if (order.kind !== "new" && !(await trusted(order.file, order.kind === "build"))) return null;
  const { id } = await lsp().request<{ id: number }>("afp/job", order);
  return endOf(id, title, []);
}

/** Resumes a job from before a reload, and waits for its end. */
export const takeUp = ({ id, said }: Going, title: string): Promise<Done> => endOf(id, title, said ? said.split("\n") : []);

async function endOf(id: number, title: string, lines: readonly string[]): Promise<Done> {
  running.value = [...running.peek(), { id, title, last: lines.at(-1) ?? "" }];
  say([`> ${title}`, ...lines]);
  const done = early.get(id) ?? (await new Promise<Done>((done) => waiting.set(id, done)));
  early.delete(id);
  running.value = running.peek().filter((job) => job.id !== id);
  return done;
}

export const end = (id: number): Promise<unknown> => lsp().request("afp/endJob", { id });

function say(lines: readonly string[]): void {
  said.value = [...said.peek(), ...lines].slice(-MOST);
}

/** Subscribes to jobs; `resume` gets running jobs unknown to the page. */
export function begin(resume: (job: Going) => void): void {
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
  // On each connection: a new server does not know old jobs, and an idle server has ended them.
  going.subscribe((jobs) => {
    for (const [id, wait] of waiting) {
      if (jobs.some((job) => job.id === id)) continue;
      waiting.delete(id);
      wait({ id, ok: false, code: null, results: [], said: words.connectionLost });
    }
    jobs.filter(({ id }) => !waiting.has(id)).forEach(resume);
  });
}
