// Open panes and their widths; stored by the browser.
import { effect, signal } from "@preact/signals";

export type Right = "inspector" | "text" | "outline";
export type Bottom = "problems" | "run" | "timeline" | "scenarios" | "jobs";
export const BOTTOMS: readonly Bottom[] = ["problems", "run", "timeline", "scenarios", "jobs"];
export type Narrow = "palette" | "drawing" | "world" | Right | Bottom;

export const palette = signal(true);
/** Above the open right pane. */
export const world = signal(true);
export const right = signal<Right | null>("inspector");
export const bottom = signal<Bottom | null>(null);
/** Widths in pixels. */
export const widths = signal({ world: 340, inspector: 340, text: 460, outline: 340 });
/** The only visible pane on a narrow page. */
export const narrow = signal<Narrow>("drawing");

const KEY = "afp-studio-layout";

/** Restores the layout and starts to store it. */
export function begin(storage: Storage): void {
  try {
    const kept = JSON.parse(storage.getItem(KEY) ?? "{}");
    if (typeof kept.palette === "boolean") palette.value = kept.palette;
    if (typeof kept.world === "boolean") world.value = kept.world;
    if (["inspector", "text", "outline", null].includes(kept.right)) right.value = kept.right;
    if ([...BOTTOMS, null].includes(kept.bottom)) bottom.value = kept.bottom;
    for (const name of ["world", "inspector", "text", "outline"] as const) {
      const width = kept.widths?.[name];
      if (Number.isFinite(width)) widths.value = { ...widths.value, [name]: clamp(width) };
    }
  } catch {
    // An unreadable value is ignored.
  }
  effect(() => {
    const kept = { palette: palette.value, world: world.value, right: right.value, bottom: bottom.value, widths: widths.value };
    storage.setItem(KEY, JSON.stringify(kept));
  });
}

export const clamp = (width: number): number => Math.round(Math.min(900, Math.max(220, width)));

export const isBottom = (pane: string): pane is Bottom => BOTTOMS.some((each) => each === pane);

export function show(pane: Narrow): void {
  narrow.value = pane;
  if (pane === "palette") palette.value = true;
  else if (pane === "world") world.value = true;
  else if (isBottom(pane)) bottom.value = pane;
  else if (pane !== "drawing") right.value = pane;
}
