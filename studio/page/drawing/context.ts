// Commands of the context menu for a pressed item. `context.tsx` shows them.
import { signal } from "@preact/signals";
import { commands, isEnabled, type Command } from "../screen/commands";
import type { Hit } from "./hit";
import type { Point } from "./shapes";

/** Command ids in groups; disabled ones are omitted. */
const MENUS: Record<"ground" | Hit["on"], readonly (readonly string[])[]> = {
  element: [
    ["drawing.connect", "drawing.parts", "drawing.rename-item", "drawing.template", "drawing.start", "drawing.note", "drawing.inspect"],
    ["drawing.into", "drawing.fold", "drawing.extract", "drawing.inline", "breakpoint"],
    ["drawing.copy", "drawing.cut", "drawing.duplicate", "drawing.move", "drawing.automatic", "drawing.remove"],
  ],
  start: [["drawing.connect", "drawing.entry", "drawing.rename-item", "drawing.inspect", "drawing.fold", "drawing.automatic"]],
  exit: [["drawing.connect", "drawing.remove"]],
  edge: [["drawing.connect", "drawing.remove"]],
  head: [["drawing.connect", "drawing.remove"]],
  port: [["drawing.parts", "drawing.remove"]],
  entry: [["drawing.rename-item", "drawing.inspect", "drawing.flow", "drawing.remove"]],
  ground: [
    ["drawing.add", "drawing.entry", "drawing.paste"],
    ["drawing.all", "drawing.several", "drawing.flow", "drawing.automatic"],
    ["seek", "drawing.fit", "drawing.one", "drawing.out"],
  ],
};

/** The open menu, in pixels of the pane. */
export const menu = signal<{ at: Point; groups: Command[][] } | null>(null);

/** Opens the menu of a pressed item; null for the ground. */
export function openMenu(on: Hit["on"] | null, at: Point): void {
  const byId = new Map(commands.peek().map((one) => [one.id, one]));
  const known = (id: string): Command[] => {
    const one = byId.get(id);
    return one && isEnabled(one) ? [one] : [];
  };
  const groups = MENUS[on ?? "ground"].map((ids) => ids.flatMap(known)).filter((group) => group.length > 0);
  menu.value = groups.length ? { at, groups } : null;
}
