// Lists of choices at a place of the drawing: templates, next elements, exits. `choices.tsx` shows
// them.
import { signal } from "@preact/signals";
import { matching } from "../screen/ranking";
import type { Point } from "./shapes";

export interface Choice {
  /** Unique in its list. */
  id: string;
  label: string;
  hint?: string;
  /** The reason why it cannot be chosen. */
  refused?: string | null;
  icon?: string | null;
}

export interface Question {
  title: string;
  /** In pixels of the pane; null for its middle. */
  at: Point | null;
  /** All choices, or a function of the typed text. */
  list: readonly Choice[] | ((typed: string) => Promise<Choice[]>);
  answer(chosen: Choice | null): void;
}

export const question = signal<Question | null>(null);

/** Shows a list; null if nothing was chosen. An earlier question is cancelled. */
export function choose(title: string, list: Question["list"], at: Point | null = null): Promise<Choice | null> {
  question.peek()?.answer(null);
  return new Promise((resolve) => {
    const one: Question = {
      title,
      at,
      list,
      answer: (chosen) => {
        // First: a list that closes loses the focus, which cancels it.
        resolve(chosen);
        if (question.peek() === one) question.value = null;
      },
    };
    question.value = one;
  });
}

/** The choices that match the typed text by name or hint, rejected ones last. */
export function filtered(choices: readonly Choice[], typed: string): Choice[] {
  return matching(typed, choices, { text: ({ label, hint = "" }) => `${label} ${hint}`, isLast: ({ refused }) => Boolean(refused) });
}
