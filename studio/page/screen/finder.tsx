// `Ctrl+K`: commands by name; `Ctrl+P`: plans, elements and entries; `?`: keys.
import { signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { commands, isEnabled, keysOf, type Command } from "./commands";
import { nameOf } from "../documents/documents";
import { useModal } from "./modal";
import { report } from "../panes/files";
import { reveal, symbols } from "../plan/places";
import { matching } from "./ranking";
import { words } from "../words";

/** The open list. */
export const finding = signal<"commands" | "things" | null>(null);
export const showingKeys = signal(false);

export function Finder() {
  return (
    <>
      {finding.value === "commands" && <Commands />}
      {finding.value === "things" && <Things />}
      {showingKeys.value && <Keys />}
    </>
  );
}

function useClosing(close: () => void, opened?: (dialog: HTMLDialogElement) => void) {
  const dialog = useModal(opened);
  // A click outside hits the dialog's backdrop.
  const click = (event: MouseEvent): void => {
    if (event.target === dialog.current) close();
  };
  return { ref: dialog, onCancel: close, onClick: click };
}

interface Found {
  id: string;
  label: string;
  hint?: ComponentChildren;
  run(): unknown;
}

interface Given {
  label: string;
  hint: string;
  nothing: string;
  /** Matches of the typed words, best first. */
  find(typed: string): readonly Found[];
}

/** A field with results below; `Enter` or a click selects one. */
function Picker({ label, hint, nothing, find }: Given) {
  const [typed, setTyped] = useState("");
  const [chosen, setChosen] = useState(0);
  const list = useRef<HTMLUListElement>(null);
  const close = (): void => void (finding.value = null);
  const given = useClosing(close);
  const found = find(typed);
  const at = Math.min(chosen, found.length - 1);
  useEffect(() => list.current?.querySelector("[aria-selected=true]")?.scrollIntoView({ block: "nearest" }), [at]);
  const run = (one: Found | undefined): void => {
    if (!one) return;
    close();
    // After the focus has returned.
    setTimeout(() => one.run());
  };
  const key = (event: KeyboardEvent): void => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) setChosen((at + step + found.length) % Math.max(1, found.length));
    else if (event.key === "Enter") run(found[at]);
    else return;
    event.preventDefault();
  };
  return (
    <dialog class="finder" aria-label={label} {...given}>
      <input
        role="combobox" aria-expanded="true" aria-controls="found" aria-activedescendant={found[at] ? `found-${at}` : undefined}
        aria-label={hint} placeholder={hint} spellcheck={false} value={typed} onKeyDown={key}
        onInput={(event) => { setTyped(event.currentTarget.value); setChosen(0); }}
      />
      <ul id="found" role="listbox" aria-label={label} ref={list}>
        {found.map((each, place) => (
          <li id={`found-${place}`} role="option" aria-selected={place === at} onClick={() => run(each)} key={each.id}>
            <span>{each.label}</span>
            {each.hint}
          </li>
        ))}
      </ul>
      {found.length === 0 && <p class="empty">{nothing}</p>}
    </dialog>
  );
}

function Commands() {
  const found = (one: Command): Found => ({ ...one, hint: keysOf(one).slice(0, 1).map((key) => <kbd key={key}>{key}</kbd>) });
  const find = (typed: string): Found[] => matching(typed, commands.value.filter(isEnabled)).map(found);
  return <Picker label={words.commands} hint={words.findCommand} nothing={words.noCommand} find={find} />;
}

function Things() {
  const [all, setAll] = useState<readonly Found[]>([]);
  useEffect(() => void things().then(setAll, report), []);
  return <Picker label={words.goto} hint={words.gotoHint} nothing={words.noThing} find={(typed) => matching(typed, all).slice(0, MOST)} />;
}

/** Maximum number of results; more typing narrows them. */
const MOST = 60;

async function things(): Promise<Found[]> {
  const all = await symbols();
  return all.map(({ name, container, uri, range }, nth) => ({
    id: String(nth),
    label: name,
    hint: <small>{[container, nameOf(uri)].filter(Boolean).join(" · ")}</small>,
    run: () => reveal(uri, range, "other"),
  }));
}

function Keys() {
  const close = (): void => {
    showingKeys.value = false;
  };
  // The only button is at the end.
  const given = useClosing(close, (dialog) => dialog.querySelector("h2")?.focus());
  const all = commands.value.filter((each) => keysOf(each).length > 0);
  return (
    <dialog class="keys" aria-labelledby="keys" {...given}>
      <h2 id="keys" tabIndex={-1}>{words.keys}</h2>
      <p>{words.keysHint}</p>
      <dl>
        {all.map((each) => (
          <div key={each.id}>
            <dt>{keysOf(each).map((key) => <kbd key={key}>{key}</kbd>)}</dt>
            <dd>{each.label}</dd>
          </div>
        ))}
      </dl>
      <div class="choices"><button class="main" onClick={close}>{words.ok}</button></div>
    </dialog>
  );
}
