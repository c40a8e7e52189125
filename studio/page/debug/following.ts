// The drawing follows a stopped run into and out of sub-plans.
import { effect, signal } from "@preact/signals";
import { drawing, show } from "../drawing/model";
import { command } from "../screen/commands";
import { words } from "../words";
import { frames, log, phase } from "./run";

export const following = signal(true);

export function begin(): void {
  command({ id: "follow", label: words.follow, run: () => void (following.value = !following.value) });
  let last = "";
  effect(() => {
    const all = frames.value;
    const now = all.map(({ path, plan }) => `${path}:${plan}`).join();
    if (phase.value !== "held" || log.value || !following.value || now === last) return;
    last = now;
    const places = all.map(({ uri, plan }) => ({ uri: uri ?? "", plan }));
    const inner = places.at(-1);
    const drawn = drawing.peek();
    if (!inner || places.some(({ uri, plan }) => !uri || !plan) || (drawn?.uri === inner.uri && drawn.plan === inner.plan)) return;
    void show(inner, places.slice(0, -1)).catch(console.error);
  });
}
