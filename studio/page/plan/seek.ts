// The search in drawing and text: `null` without one. `drawing/seeking.ts` searches the drawing,
// `text/seek.ts` the text.
import { signal } from "@preact/signals";

export const sought = signal<string | null>(null);
