// The drawing follows a run into and out of sub-plans: at a stop at once, in a running plan after a
// while in the same plan.
import { effect, signal } from "@preact/signals";
import { drawing, isHeld, show } from "../drawing/model";
import { editing } from "../drawing/value";
import { command } from "../screen/commands";
import { say } from "../drawing/say";
import { words } from "../words";
import { opened } from "./live";
import type { Frame } from "./follow";
import { frames, log, phase } from "./run";

export const following = signal(true);

/** Milliseconds in a plan after which a running plan is followed there. */
const SETTLES = 300;

export function begin(): void {
  command({ id: "follow", label: words.follow, run: toggle });
  let last = "";
  let timer: ReturnType<typeof setTimeout> | undefined;
  effect(() => {
    const all = frames.value;
    const now = all.map(({ path, plan }) => `${path}:${plan}`).join();
    const isStopped = phase.value === "held";
    if (!["held", "running"].includes(phase.value) || log.value || !following.value || now === last) return;
    clearTimeout(timer);
    const go = (): void => {
      last = now;
      follow(all);
    };
    if (isStopped) return go();
    // The first plan of a run is the one that is shown.
    if (all.length === 1 && last === "") last = now;
    else timer = setTimeout(() => frames.peek() === all && phase.peek() === "running" && !isBusy() && go(), SETTLES);
  });
  effect(() => void (phase.value === "starting" && (last = "")));
}

function toggle(): void {
  following.value = !following.value;
  say(words.follows(following.value));
}

/** Whether the user edits something. */
const isBusy = (): boolean => isHeld() || editing.peek() !== null || opened.peek() !== null || document.activeElement?.closest("input, textarea, select, .cm-editor") != null;

function follow(all: readonly Frame[]): void {
  const places = all.map(({ uri, plan }) => ({ uri: uri ?? "", plan }));
  const inner = places.at(-1);
  const drawn = drawing.peek();
  if (!inner || places.some(({ uri, plan }) => !uri || !plan) || (drawn?.uri === inner.uri && drawn.plan === inner.plan)) return;
  void show(inner, places.slice(0, -1)).catch(console.error);
}
