// `Ctrl+K`: every command by its name; `?`: every key.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { commands, isEnabled, keysOf, matching, type Command } from "./commands";
import { words } from "./words";

export const finding = signal(false);
export const showingKeys = signal(false);
const typed = signal("");
const chosen = signal(0);

export function Finder() {
  return (
    <>
      {finding.value && <Find />}
      {showingKeys.value && <Keys />}
    </>
  );
}

function modal(close: () => void) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const before = document.activeElement;
    dialog.current?.showModal();
    return () => before instanceof HTMLElement && before.focus();
  }, []);
  // A click beside the dialog is one on its ground.
  const click = (event: MouseEvent): void => {
    if (event.target === dialog.current) close();
  };
  return { ref: dialog, onCancel: close, onClick: click };
}

function Find() {
  const close = (): void => {
    [finding.value, typed.value, chosen.value] = [false, "", 0];
  };
  const given = modal(close);
  const found = matching(typed.value, commands.value.filter(isEnabled));
  const at = Math.min(chosen.value, found.length - 1);
  const run = (one: Command | undefined): void => {
    if (!one) return;
    close();
    // Once the focus is back where it was.
    setTimeout(() => one.run());
  };
  const key = (event: KeyboardEvent): void => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) chosen.value = (at + step + found.length) % Math.max(1, found.length);
    else if (event.key === "Enter") run(found[at]);
    else return;
    event.preventDefault();
  };
  return (
    <dialog class="finder" aria-label={words.commands} {...given}>
      <input
        role="combobox" aria-expanded="true" aria-controls="found" aria-activedescendant={found[at] ? `found-${at}` : undefined}
        aria-label={words.findCommand} placeholder={words.findCommand} spellcheck={false} value={typed.value} onKeyDown={key}
        onInput={(event) => { typed.value = event.currentTarget.value; chosen.value = 0; }}
      />
      <ul id="found" role="listbox" aria-label={words.commands}>
        {found.map((each, place) => (
          <li id={`found-${place}`} role="option" aria-selected={place === at} onClick={() => run(each)} key={each.id}>
            <span>{each.label}</span>
            {keysOf(each).slice(0, 1).map((key) => <kbd key={key}>{key}</kbd>)}
          </li>
        ))}
      </ul>
      {found.length === 0 && <p class="empty">{words.noCommand}</p>}
    </dialog>
  );
}

function Keys() {
  const close = (): void => {
    showingKeys.value = false;
  };
  const given = modal(close);
  const all = commands.value.filter((each) => keysOf(each).length > 0);
  return (
    <dialog class="keys" aria-labelledby="keys" {...given}>
      <h2 id="keys">{words.keys}</h2>
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
