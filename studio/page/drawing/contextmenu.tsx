// The context menu: arrows move, letters jump, `Escape` and an outside press close it.
import { useLayoutEffect, useRef } from "preact/hooks";
import { keysOf, type Command } from "../screen/commands";
import { useInSight } from "./choices";
import { menu } from "./context";
import { words } from "./words";

export function ContextMenu() {
  const popup = useRef<HTMLDivElement>(null);
  const open = menu.value;
  useInSight(open?.at ?? null, popup, open);
  useLayoutEffect(() => popup.current?.querySelector("button")?.focus(), [open]);
  if (!open) return null;
  const close = (): void => void (menu.value = null);
  const run = (one: Command): void => {
    close();
    // After the focus has returned to the drawing.
    setTimeout(() => one.run());
  };
  const key = (event: KeyboardEvent): void => {
    const all = [...popup.current!.querySelectorAll("button")];
    const at = all.findIndex((each) => each === document.activeElement);
    const letter = (each: HTMLElement): boolean => event.key.length === 1 && each.textContent!.toLowerCase().startsWith(event.key.toLowerCase());
    const to = { ArrowDown: at + 1, ArrowUp: at - 1 + all.length, Home: 0, End: all.length - 1 }[event.key];
    if (to !== undefined) all[to % all.length]?.focus();
    else if (event.key === "Escape" || event.key === "Tab") close();
    else if (event.key.length === 1 && event.key !== " ") [...all.slice(at + 1), ...all].find(letter)?.focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const away = (event: FocusEvent): void => {
    if (!popup.current?.contains(event.relatedTarget as Node | null)) close();
  };
  return (
    <div class="over menu context-menu" ref={popup} role="menu" aria-label={words.menu} onKeyDown={key} onFocusOut={away} onContextMenu={(event) => event.preventDefault()}>
      {open.groups.map((group, nth) => (
        <div role="group" key={nth}>
          {group.map((one) => (
            <button type="button" role="menuitem" tabIndex={-1} onClick={() => run(one)} key={one.id}>
              <span>{one.label}</span>
              {keysOf(one).slice(0, 1).map((key) => <kbd key={key}>{key}</kbd>)}
            </button>
          ))}
        </div>
      ))}
    </div>
  );
}
