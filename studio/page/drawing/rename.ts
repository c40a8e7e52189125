// Editing a name in place; `choices.tsx` shows the field.
import { signal } from "@preact/signals";
import type { Rect } from "./shapes";

export interface Renaming {
  name: string;
  /** In pixels of the pane. */
  rect: Rect;
  /** Takes the name, or null to cancel; false if the engine rejects it. */
  done(name: string | null): Promise<boolean>;
}

export const renaming = signal<Renaming | null>(null);
