// Named commands for `Ctrl+K`, keys and bar.
import { signal } from "@preact/signals";

export interface Command {
  id: string;
  label: string;
  /**
   * Such as `Ctrl+Shift+Z`, `F2`, `A`; several for the variants of Macs and Chromebooks. `Ctrl` is
   * `Cmd` on a Mac.
   */
  key?: string | string[];
  run(): unknown;
  enabled?(): boolean;
  /** Letter keys work only with the focus in the drawing. */
  where?: "drawing";
}

export const commands = signal<readonly Command[]>([]);

/** Adds or replaces a command; returns a function that removes it. */
export function command(one: Command): () => void {
  commands.value = [...commands.peek().filter((each) => each.id !== one.id), one];
  return () => (commands.value = commands.peek().filter((each) => each !== one));
}

export const keysOf = ({ key }: Command): string[] => (key === undefined ? [] : Array.isArray(key) ? key : [key]);
export const isEnabled = (one: Command): boolean => one.enabled?.() ?? true;

interface Pressed {
  key: string;
  ctrlKey: boolean;
  metaKey: boolean;
  altKey: boolean;
  shiftKey: boolean;
}

/** The name of a pressed key. Characters that need `Shift` are written without it. */
export function keyName(event: Pressed, mac = false): string {
  const main = mac ? event.metaKey : event.ctrlKey;
  const key = event.key === " " ? "Space" : event.key.length === 1 ? event.key.toUpperCase() : event.key.replace(/^Arrow/, "");
  const letter = key.length > 1 || key.toLowerCase() !== key;
  return `${main ? "Ctrl+" : ""}${event.altKey ? "Alt+" : ""}${event.shiftKey && letter ? "Shift+" : ""}${key}`;
}

/** The command of a key, in the drawing or elsewhere. */
export function commandFor(key: string, inDrawing: boolean, all = commands.peek()): Command | undefined {
  const fits = (each: Command) => keysOf(each).includes(key) && (each.where === undefined || inDrawing);
  // The drawing's command has precedence.
  return all.find((each) => each.where === "drawing" && fits(each) && isEnabled(each)) ?? all.find((each) => fits(each) && isEnabled(each));
}

/** Whether a key belongs to a text field, such as letters and undo. */
export const isForField = (key: string): boolean => !/^(F\d+|Shift\+F\d+|Ctrl\+[KP.])$/.test(key);

/** Handles keys of the page; earlier handlers call `preventDefault`. */
export function listen(page: Window): void {
  const mac = /Mac|iPhone|iPad/.test(page.navigator.platform);
  page.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.isComposing || !(event.target instanceof Element)) return;
    const { target } = event;
    const key = keyName(event, mac);
    const field = target.matches("input, textarea, select");
    if ((field || target.closest("dialog")) && isForField(key)) return;
    const found = commandFor(key, target.closest("[data-pane=drawing]") !== null);
    // Letters belong to the text pane.
    if (!found || (key.length === 1 && target.closest("[contenteditable=true]"))) return;
    event.preventDefault();
    found.run();
  });
}
