// Editing a name in place; `choices.tsx` shows the field.
import { signal } from "@preact/signals";
import type { Rect } from "./shapes";

export interface Renaming {
  name: string;
  /** In pixels of the pane. */
  rect: Rect;
  done(name: string | null): void;
}

export const renaming = signal<Renaming | null>(null);

/** Whether it is an identifier. */
export const isName = (name: string): boolean => /^[A-Za-z_]\w*$/.test(name);
