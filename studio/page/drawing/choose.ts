// Lists of choices at a place of the drawing: templates, next elements, exits. `choices.tsx` shows
// them.
import { signal } from "@preact/signals";
import { matching } from "../screen/ranking";
import type { Point } from "./shapes";

export interface Choice {
  /** The id of the choice, unique in its list. */
  id: string;
  label: string;
  hint?: string;
  /** Why it cannot be chosen. */
  refused?: string | null;
  /** An icon of a toolbox. */
  icon?: string | null;
}

export interface Question {
  title: string;
  /** In pixels of the pane; null for its middle. */
  at: Point | null;
  /** All choices, or those for what was typed. */
  list: readonly Choice[] | ((typed: string) => Promise<Choice[]>);
  answer(chosen: Choice | null): void;
}

export const question = signal<Question | null>(null);

/** Asks; null where nothing was chosen. A question before it is answered with nothing. */
export function choose(title: string, list: Question["list"], at: Point | null = null): Promise<Choice | null> {
  question.peek()?.answer(null);
  return new Promise((resolve) => {
    const one: Question = {
      title,
      at,
      list,
      answer: (chosen) => {
        // First of all: a list that goes loses the focus, which answers with nothing.
        resolve(chosen);
        if (question.peek() === one) question.value = null;
      },
    };
    question.value = one;
  });
}

/** The choices that fit what was typed by their names and hints, refused ones last. */
export function filtered(choices: readonly Choice[], typed: string): Choice[] {
  return matching(typed, choices, { text: ({ label, hint = "" }) => `${label} ${hint}`, isLast: ({ refused }) => Boolean(refused) });
}
