// Lists to choose from, at a place of the drawing: what to add, what then, which exit. `choices.tsx` shows them.
import { signal } from "@preact/signals";
import type { Point } from "./shapes";

export interface Choice {
  /** What the choice stands for; unique in its list. */
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

/** The choices that hold all words typed, those that begin with them first, refused ones last. */
export function filtered(choices: readonly Choice[], typed: string): Choice[] {
  const wanted = typed.toLowerCase().split(/\s+/).filter(Boolean);
  const text = ({ label, hint = "" }: Choice): string => `${label} ${hint}`.toLowerCase();
  const rank = (choice: Choice): number => (choice.refused ? 2 : 0) + (choice.label.toLowerCase().startsWith(wanted[0] ?? "") ? 0 : 1);
  const fitting = choices.filter((choice) => wanted.every((word) => text(choice).includes(word)));
  return fitting.map((choice, at) => ({ choice, at })).sort((one, two) => rank(one.choice) - rank(two.choice) || one.at - two.at).map(({ choice }) => choice);
}
