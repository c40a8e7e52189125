// The choice list, the field for a new name, and the tooltip.
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { filtered, question, type Choice, type Question } from "./choose";
import { icon } from "./fragment";
import { renaming } from "./rename";
import { size } from "./stage";
import { words } from "./words";
import type { Point } from "./shapes";

export function Icon({ svg }: { svg: string | null | undefined }) {
  const host = useRef<HTMLSpanElement>(null);
  useEffect(() => {
    const made = svg ? icon(svg) : null;
    host.current?.replaceChildren(...(made ? [made] : []));
  }, [svg]);
  return <span class="template-icon" ref={host} aria-hidden="true" />;
}

/** Moves a popup into view. */
export function useInSight(at: Point | null, host: { current: HTMLElement | null }, again: unknown): void {
  useLayoutEffect(() => {
    const popup = host.current;
    if (!popup) return;
    const { width, height } = size.peek();
    const [x, y] = at ?? [(width - popup.offsetWidth) / 2, height / 5];
    popup.style.left = `${Math.max(8, Math.min(x, width - popup.offsetWidth - 8))}px`;
    popup.style.top = `${Math.max(8, Math.min(y, height - popup.offsetHeight - 8))}px`;
  }, [at, again]);
}

export function Chooser() {
  const asked = question.value;
  return asked ? <List key={asked.title} asked={asked} /> : null;
}

/**
 * Matches for the typed text: immediate from a local list, otherwise the last answer, which may be
 * for an older text.
 */
function useFound({ list }: Question, typed: string): { found: readonly Choice[]; isLate: boolean } {
  const [answered, setAnswered] = useState<{ to: string | null; all: readonly Choice[] }>({ to: null, all: [] });
  useEffect(() => {
    if (typeof list !== "function") return;
    let wanted = true;
    void list(typed).then((all) => wanted && setAnswered({ to: typed, all }), () => {});
    return () => void (wanted = false);
  }, [list, typed]);
  const here = useMemo(() => (typeof list === "function" ? null : filtered(list, typed)), [list, typed]);
  return here ? { found: here, isLate: false } : { found: answered.all, isLate: answered.to !== typed };
}

function List({ asked }: { asked: Question }) {
  const [typed, setTyped] = useState("");
  const { found, isLate } = useFound(asked, typed);
  const [entered, setEntered] = useState(false);
  const [chosen, setAt] = useState<number | null>(null);
  const at = chosen ?? Math.max(0, found.findIndex((choice) => !choice.refused));
  const popup = useRef<HTMLDivElement>(null);
  const field = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => field.current?.focus(), [asked]);
  useLayoutEffect(() => setAt(null), [found]);
  useEffect(() => popup.current?.querySelector(`#choice-${at}`)?.scrollIntoView({ block: "nearest" }), [at]);
  useInSight(asked.at, popup, found.length);
  const take = (choice: Choice | undefined): void => {
    if (choice && !choice.refused) asked.answer(choice);
  };
  // `Enter` after fast typing means the typed text.
  useLayoutEffect(() => {
    if (!entered || isLate) return;
    setEntered(false);
    take(found[at]);
  }, [entered, isLate]);
  const key = (event: KeyboardEvent): void => {
    const by = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 }[event.key];
    if (by !== undefined) setAt(Math.max(0, Math.min(found.length - 1, at + by)));
    else if (event.key === "Enter") setEntered(true);
    else if (event.key === "Escape" || event.key === "Tab") asked.answer(null);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <div class="over chooser" ref={popup} role="dialog" aria-label={asked.title} onFocusOut={(event) => popup.current?.contains(event.relatedTarget as Node) || asked.answer(null)}>
      <div class="chooser-title">{asked.title}</div>
      <input
        ref={field} type="text" role="combobox" aria-expanded="true" aria-controls="choices" aria-label={asked.title} autocomplete="off" spellcheck={false}
        aria-activedescendant={found[at] ? `choice-${at}` : undefined} placeholder={words.find} value={typed} onInput={(event) => setTyped(event.currentTarget.value)} onKeyDown={key}
      />
      <ul id="choices" role="listbox" aria-label={asked.title} onPointerDown={(event) => event.preventDefault()}>
        {found.map((choice, nth) => (
          <li key={choice.id} id={`choice-${nth}`} role="option" aria-selected={nth === at} aria-disabled={!!choice.refused} onClick={() => take(choice)} onPointerMove={() => nth !== at && setAt(nth)}>
            {choice.icon !== undefined && <Icon svg={choice.icon} />}
            <span class="choice-label">{choice.label}</span>
            <span class="choice-hint">{choice.refused ?? choice.hint}</span>
          </li>
        ))}
      </ul>
      {found.length === 0 && <p class="chooser-none">{words.nothingFits}</p>}
    </div>
  );
}

export function Rename() {
  const asked = renaming.value;
  const field = useRef<HTMLInputElement>(null);
  const isAsking = useRef(false);
  useLayoutEffect(() => {
    const input = field.current;
    if (!input || !asked) return;
    const [x, y, width] = asked.rect;
    input.style.left = `${x}px`;
    input.style.top = `${y}px`;
    input.style.width = `${Math.max(width, 140)}px`;
    input.focus();
    input.select();
  }, [asked]);
  if (!asked) return null;
  const end = async (take: boolean): Promise<void> => {
    const name = field.current?.value.trim() ?? "";
    // Escape discards the name, even while the engine checks it.
    if (renaming.peek() !== asked || (take && isAsking.current)) return;
    isAsking.current = true;
    const isDone = await asked.done(take && name ? name : null);
    isAsking.current = false;
    // A rejected name can be corrected, even after leaving the field.
    if (!isDone && document.activeElement === field.current) field.current?.select();
  };
  const key = (event: KeyboardEvent): void => {
    if (event.key !== "Enter" && event.key !== "Escape") return;
    event.preventDefault();
    event.stopPropagation();
    void end(event.key === "Enter");
  };
  return <input class="over rename" ref={field} aria-label={words.renameLabel(asked.name)} title={words.nameHint} spellcheck={false} autocomplete="off" value={asked.name} onKeyDown={key} onBlur={() => void end(true)} />;
}
