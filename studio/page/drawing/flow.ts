// Data flow: arrows from an entry to its readers and from its writers, for the hovered entry, the
// selection, or all.
import { computed, effect, signal } from "@preact/signals";
import { lsp } from "../server/session";
import { selected } from "../plan/selection";
import { svg } from "./fragment";
import { drawing } from "./model";
import { hovered } from "./pointer";
import { say } from "./say";
import { rectOf, type Drawing, type Part, type Point, type Rect } from "./shapes";
import { words } from "./words";

export type Mode = "none" | "selection" | "all";
const MODES: readonly Mode[] = ["none", "selection", "all"];

export const mode = signal<Mode>("none");

export function cycle(): void {
  mode.value = MODES[(MODES.indexOf(mode.peek()) + 1) % MODES.length]!;
  say(words.flowMode[mode.value]);
}

/** Readers and writers of each entry, as far as requested. */
const known = signal<{ of: Drawing | null; uses: ReadonlyMap<string, readonly Part[]> }>({ of: null, uses: new Map() });

/** Entries with visible arrows. */
const shown = computed((): readonly string[] => {
  const drawn = drawing.value;
  if (!drawn) return [];
  const over = hovered.value?.hit;
  if (over?.on === "entry") return [over.part.item];
  if (mode.value === "all") return drawn.entries.map((entry) => entry.item);
  return mode.value === "selection" ? drawn.entries.map((entry) => entry.item).filter(concerned) : [];
});

/** Whether an entry or a user of it is selected. */
function concerned(entry: string): boolean {
  const uses = known.value.uses.get(entry);
  const own = (part: Part): boolean => part.item === entry || (uses ?? []).some((use) => use.item === part.item || use.item.startsWith(`${part.item}.`));
  return uses === undefined || selected.value.some(own);
}

async function ask(drawn: Drawing, entries: readonly string[]): Promise<void> {
  const textDocument = { uri: drawn.uri };
  const asked = entries.map(async (item) => [item, await lsp().request<Part[]>("afp/uses", { textDocument, item })] as const);
  const found = await Promise.all(asked).catch(() => []);
  if (drawing.peek() !== drawn) return;
  const before = known.peek().of === drawn ? known.peek().uses : new Map();
  known.value = { of: drawn, uses: new Map([...before, ...found]) };
}

/** An arrow between rectangles, at their nearest sides. */
export function arrow(from: Rect, to: Rect): string {
  const right = from[0] + from[2] / 2 <= to[0] + to[2] / 2;
  const start: Point = [right ? from[0] + from[2] : from[0], from[1] + from[3] / 2];
  const end: Point = [right ? to[0] : to[0] + to[2], to[1] + to[3] / 2];
  const bow = Math.max(24, Math.abs(end[0] - start[0]) / 3) * (right ? 1 : -1);
  const head = right ? -1 : 1;
  return `M${start.join(" ")}C${start[0] + bow} ${start[1]} ${end[0] - bow} ${end[1]} ${end.join(" ")}m${7 * head} -4l${-7 * head} 4l${7 * head} 4`;
}

function arrows(drawn: Drawing, entry: string, uses: readonly Part[]): SVGElement[] {
  const home = rectOf(drawn, { item: entry });
  if (!home) return [];
  return uses.flatMap((use) => {
    const rect = rectOf(drawn, use);
    if (!rect || use.item === entry) return [];
    const writes = use.part?.kind === "output";
    return [svg("path", { class: `data-flow ${writes ? "writes" : "reads"}`, d: writes ? arrow(rect, home) : arrow(home, rect) })];
  });
}

/** Draws the arrows into a layer; returns a function that ends it. */
export function flows(layer: SVGGElement): () => void {
  const asks = effect(() => {
    const drawn = drawing.value;
    const wanted = shown.value;
    const uses = known.value.of === drawn ? known.value.uses : new Map();
    const missing = wanted.filter((entry) => !uses.has(entry));
    if (drawn && missing.length) void ask(drawn, missing);
  });
  const draws = effect(() => {
    const { of, uses } = known.value;
    const drawn = drawing.value;
    const entries = drawn && of === drawn ? shown.value : [];
    layer.replaceChildren(...entries.flatMap((entry) => arrows(drawn!, entry, uses.get(entry) ?? [])));
  });
  return () => {
    asks();
    draws();
  };
}
