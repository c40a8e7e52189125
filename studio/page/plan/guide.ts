// The guide to a first plan: the next step depends on the plan's content, so that any order works.
import { computed, effect, signal } from "@preact/signals";
import { current } from "../documents/documents";
import { drops, start } from "../debug/arranged";
import { ended, phase } from "../debug/run";
import { explain } from "../debug/why";
import { drawing } from "../drawing/model";
import type { Drawing } from "../drawing/shapes";
import * as layout from "../screen/layout";
import { freeStart } from "../world/free";
import { surroundings } from "../world/surroundings";
import * as chapter from "./chapter";
import { LATER, later, type Later } from "./chapter";
import { number } from "./problems";

export const STEPS = ["drive", "connect", "run", "crate", "notice", "react", "follow", "stop", "lead", "again"] as const;
export type Step = (typeof STEPS)[number];

export interface Facts {
  actors: number;
  errors: number;
  /** Number of supervisors, of elements and of the plan. */
  watched: number;
  stoppers: number;
  /** Number of things put into the world. */
  crates: number;
  /** Number of ended runs. */
  runs: number;
}

/** The next step; null at the end. */
export function next({ actors, errors, watched, stoppers, crates, runs }: Facts): Step | null {
  if (actors === 0) return "drive";
  if (watched === 0 && errors) return "connect";
  if (watched === 0) return runs === 0 ? "run" : crates === 0 ? "crate" : "notice";
  if (actors === 1 && errors) return "react";
  if (stoppers === 0) return errors ? "follow" : "stop";
  if (errors) return "lead";
  return runs < 2 ? "again" : null;
}

/** Derives the facts from a drawing. */
export function facts(drawn: Pick<Drawing, "plan" | "elements">, { errors, crates, runs }: Pick<Facts, "errors" | "crates" | "runs">): Facts {
  const elements = [...drawn.elements.values()];
  const exits = elements.flatMap(({ pieces }) => pieces).filter(({ part }) => part.kind === "exit");
  const names = (item: string): number => item.split(".").length;
  return {
    actors: elements.filter(({ kind }) => kind === "actor").length,
    errors,
    watched: exits.filter(({ item }) => names(item) === 3).length,
    stoppers: exits.filter(({ item }) => names(item) === 2 && !drawn.elements.has(item)).length,
    crates,
    runs,
  };
}

const KEY = "afp-studio-guide";
/** The guided plan; empty without one. */
const guided = signal("");
const runs = signal(0);

/** The displayed step; null without a guide for this plan. */
export const step = computed<Step | Later | "done" | "end" | null>(() => {
  if (later.value) return chapter.home.value === current.value ? later.value : null;
  if (!guided.value || guided.value !== current.value || !drawing.value) return null;
  return next(facts(drawing.value, { errors: number("error"), crates: drops.value.length, runs: runs.value })) ?? "done";
});

/** Completed steps of the chapter and their total. */
export function progress(now: Step | Later | "done" | "end"): [number, number] {
  const steps: readonly string[] = later.peek() ? LATER : STEPS;
  const at = steps.indexOf(now);
  return [at < 0 ? steps.length : at, steps.length];
}

/** Begins the second chapter with the guided plan. */
export const goOn = (): void => chapter.open(guided.peek());

export function guide(uri: string): void {
  [guided.value, runs.value] = [uri, 0];
  sessionStorage.setItem(KEY, uri);
}

export function leave(): void {
  chapter.close();
  guided.value = "";
  sessionStorage.removeItem(KEY);
}

/** Restores the guide after a reload, and counts runs. */
export function begin(): void {
  chapter.begin();
  guided.value = sessionStorage.getItem(KEY) ?? "";
  ended.subscribe((end) => {
    if (!end) return;
    // The first run explains itself, where there is room for it.
    const element = end.by?.edge?.split(".").slice(0, -1).join(".");
    if (step.peek() === "run" && matchMedia("(min-width: 901px)").matches) {
      layout.show("timeline");
      if (element) explain(element);
    }
    runs.value = runs.peek() + 1;
    chapter.ran();
  });
  // Before its first run, the robot of a first plan faces free floor.
  effect(() => {
    if (step.value === null || runs.value > 0 || phase.value !== "idle" || !surroundings.value || start.value) return;
    const free = freeStart(surroundings.value);
    if (free !== surroundings.value.start) start.value = free;
  });
}
