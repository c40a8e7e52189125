// The page's drawing: requested once, then updated by differences, frozen during a drag.
import { batch, computed, effect, signal } from "@preact/signals";
import { current, open } from "../documents/documents";
import { LOST, Refused } from "../server/lsp";
import { lsp } from "../server/session";
import { calledNow, changed, itemsNow, whole } from "./differences";
import type { Answer, Changed, Drawing } from "./shapes";
import { folded } from "./folded";

/** The drawing; null before the first answer. */
export const drawing = signal<Drawing | null>(null);
/** The displayed plan; null for the first one of the file. */
export const wanted = signal<string | null>(null);
/** Name of the displayed plan. */
export const plan = computed(() => drawing.value?.plan ?? null);
/** Whether the displayed plan has nothing but its start. */
export const isEmpty = computed(() => plan.value !== null && drawing.value!.elements.size <= 1 && drawing.value!.entries.length === 0);
export interface Place {
  uri: string;
  plan: string;
}

/** Earlier plans, for going back. */
export const trail = signal<readonly Place[]>([]);
/** View for the next file. */
let next: { plan: string | null; trail: readonly Place[] } | null = null;

let held = 0;
let kept: Changed[] = [];

/** Delays updates until `release`: the drawing stays during a drag. */
export function hold(): void {
  held += 1;
}

/** Whether a drag holds the drawing. */
export const isHeld = (): boolean => held > 0;

export function release(): void {
  held -= 1;
  const waiting = held === 0 ? kept.splice(0) : [];
  batch(() => waiting.forEach(take));
}

function take(change: Changed): void {
  const before = drawing.peek();
  if (!before || change.textDocument.uri !== before.uri) return;
  if (held > 0) return void kept.push(change);
  batch(() => {
    // The displayed plan was renamed or removed, and the server reports the first plan.
    if (wanted.peek() === before.plan && change.plan !== before.plan) wanted.value = wanted.peek() && change.plan;
    trail.value = trail.peek().flatMap((place) => {
      const plan = place.uri === before.uri ? calledNow(place.plan, before.plans, change.plans) : place.plan;
      return plan === null ? [] : [{ ...place, plan }];
    });
    drawing.value = changed(before, change);
    const shut = folded.peek()[before.uri];
    const now = shut && itemsNow(shut, before.plans, change.plans);
    if (now && now.join() !== shut.join()) folded.value = { ...folded.peek(), [before.uri]: now };
  });
}

async function ask(uri: string, plan: string | null, folded: readonly string[]): Promise<void> {
  const textDocument = { uri };
  const answer = await lsp()
    .request<Answer>("afp/drawing", { textDocument, ...(plan ? { plan } : {}), folded, subscribe: true })
    .catch((why: Error) => {
      console.error(why);
      // Without such a plan, the first one is shown. For a subscribed file the server decides,
      // since the plan may return.
      const gone = drawing.peek()?.uri !== uri && why instanceof Refused && why.code !== LOST && plan !== null && plan === wanted.peek();
      if (gone && current.peek() === uri) batch(() => ([wanted.value, trail.value] = [null, []]));
      return null;
    });
  if (!answer || current.peek() !== uri || wanted.peek() !== plan) return;
  kept = [];
  drawing.value = whole(uri, answer);
}

export function follow(): () => void {
  const changes = lsp().on("afp/drawingChanged", take);
  let before = "";
  const asks = effect(() => {
    const uri = current.value;
    const connected = lsp().open.value;
    if (uri !== before) {
      batch(() => {
        [wanted.value, trail.value, drawing.value] = [next?.plan ?? null, next?.trail ?? [], null];
        next = null;
      });
    }
    before = uri;
    const plan = wanted.value;
    const shut = folded.value[uri] ?? [];
    if (uri && connected) void ask(uri, plan, shut);
  });
  return () => {
    changes();
    asks();
  };
}

/** Shows a plan, possibly of another file. */
export async function show({ uri, plan }: { uri: string; plan: string | null }, before: readonly Place[]): Promise<void> {
  if (uri === current.peek()) return batch(() => void ([wanted.value, trail.value] = [plan, before]));
  await open(uri);
  next = { plan, trail: before };
  current.value = uri;
}

/** Opens another plan of the file, or of a used file, and stores the way back. */
export async function enter(name: string, file: string | null = null): Promise<void> {
  const drawn = drawing.peek();
  const here = plan.peek();
  if (!drawn || !here || (file === null && (here === name || !drawn.plans.includes(name)))) return;
  await show({ uri: file ?? drawn.uri, plan: name }, [...trail.peek(), { uri: drawn.uri, plan: here }]);
}

/** Returns to an earlier plan; false if there is none. */
export function leave(to = trail.peek().length - 1): boolean {
  const back = trail.peek()[to];
  if (back !== undefined) void show(back, trail.peek().slice(0, to));
  return back !== undefined;
}
