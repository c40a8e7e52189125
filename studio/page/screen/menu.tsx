// A button with a drop-down list: arrows move, `Escape` and an outside click close it.
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";

interface Given {
  label: string;
  class?: string;
  button: ComponentChildren;
  children: (done: () => void) => ComponentChildren;
}

export function Menu({ label, class: name = "", button, children }: Given) {
  const [open, setOpen] = useState(false);
  const whole = useRef<HTMLDivElement>(null);
  const items = (): HTMLElement[] => [...(whole.current?.querySelectorAll<HTMLElement>("[role^=menuitem]") ?? [])];
  const close = (): void => {
    setOpen(false);
    whole.current?.querySelector("button")?.focus();
  };
  useLayoutEffect(() => {
    if (!open) return;
    (items().find((each) => each.ariaChecked === "true") ?? items()[0])?.focus();
    const away = (event: Event): void => {
      if (event.target instanceof Node && !whole.current?.contains(event.target)) setOpen(false);
    };
    addEventListener("pointerdown", away);
    return () => removeEventListener("pointerdown", away);
  }, [open]);
  const key = (event: KeyboardEvent): void => {
    if (!open) return;
    const all = items();
    const at = all.findIndex((each) => each === document.activeElement);
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: all.length - 1 }[event.key];
    if (to !== undefined) all[(to + all.length) % all.length]?.focus();
    else if (event.key === "Escape") close();
    else if (event.key === "Tab") return setOpen(false);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <div class="dropdown" ref={whole} onKeyDown={key}>
      <button class={name} aria-haspopup="menu" aria-expanded={open} aria-label={label} title={label} onClick={() => setOpen(!open)}>
        {button}
      </button>
      {open && children(close)}
    </div>
  );
}
