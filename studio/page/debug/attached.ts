// The robot that the page is attached to, its clients, and the names of its files in this folder.
import { computed, signal } from "@preact/signals";
import { pathOf, uriOf } from "../documents/addresses";
import { files } from "../server/session";

/** A host of ssh, or a socket; empty for a run of the studio. */
export const robot = signal("");

/** The clients of the run, and the client that operates it. */
export interface Roles {
  operator: number | null;
  you: number;
  clients: readonly { id: number; name: string }[];
}
export const roles = signal<Roles | null>(null);

/** The name of another client that operates the run, else empty. */
export const operator = computed(() => {
  const { operator, you, clients } = roles.value ?? { operator: null, you: 0, clients: [] };
  return operator === null || operator === you ? "" : (clients.find(({ id }) => id === operator)?.name ?? String(operator));
});

/** The addresses of the robot's files in this folder, by path. */
const known = new Map<string, string>();

/** The number of equal parts at the ends of two paths. */
const alike = (one: readonly string[], other: readonly string[]): number => {
  const differs = one.findIndex((part, at) => part !== other[at]);
  return differs < 0 ? one.length : differs;
};

/** The file whose path ends like another path; null if no file has its name. */
export function nearest(path: string, all: readonly string[]): string | null {
  const parts = (of: string): string[] => of.split("/").reverse();
  const [best] = all.map((each) => [alike(parts(path), parts(each)), each] as const).sort(([a], [b]) => b - a);
  return best && best[0] > 0 ? best[1] : null;
}

/** Finds the files of a run in this folder. */
export function find(paths: readonly string[]): void {
  known.clear();
  const here = files.peek().map(({ uri }) => pathOf(uri));
  for (const path of paths) {
    const file = nearest(path, here);
    if (file) known.set(path, uriOf(file));
  }
}

/** The address here of a path of the debugger. */
export const uriHere = (path: string): string => (robot.peek() && known.get(path)) || uriOf(path);

/** The debugger's path of a file here; null if a robot does not have it. */
export const pathThere = (uri: string): string | null => (robot.peek() ? ([...known].find(([, each]) => each === uri)?.[0] ?? null) : pathOf(uri));
