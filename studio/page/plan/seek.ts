// What is looked for, in drawing and text at once: `null` while nothing is. `drawing/seeking.ts` finds it in the drawing,
// `text/seek.ts` in the text.
import { signal } from "@preact/signals";

export const sought = signal<string | null>(null);
