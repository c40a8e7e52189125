// The search field: `Enter` goes to the next match, `Shift+Enter` to the previous one, `Escape`
// closes it.
import { useLayoutEffect, useRef } from "preact/hooks";
import { Tool } from "../screen/bar";
import { sought } from "../plan/seek";
import { hits, next, nth } from "./seeking";
import { words } from "./words";

export function SeekBar() {
  return sought.value === null ? null : <Field />;
}

function Field() {
  const field = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => {
    // The text editor's own search may have opened this one.
    if (document.activeElement?.closest(".cm-editor")) return;
    field.current?.focus();
    field.current?.select();
  }, []);
  const close = (): void => {
    sought.value = null;
    document.querySelector<HTMLElement>(".board")?.focus();
  };
  const key = (event: KeyboardEvent): void => {
    if (event.key === "Enter") next(event.shiftKey ? -1 : 1);
    else if (event.key === "Escape") close();
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const count = hits.value.length;
  return (
    <div class="over seek-bar" role="search">
      <input type="text" ref={field} aria-label={words.seek} placeholder={words.seek} value={sought.value ?? ""} spellcheck={false} autocomplete="off" onInput={(event) => (sought.value = event.currentTarget.value)} onKeyDown={key} />
      <span class="seek-count" role="status">{sought.value && words.seekCount(nth.value + 1, count)}</span>
      <Tool icon="up" label={words.seekBefore} disabled={count === 0} run={() => next(-1)} />
      <Tool icon="down" label={words.seekNext} disabled={count === 0} run={() => next(1)} />
      <Tool icon="close" label={words.seekEnd} run={close} />
    </div>
  );
}
