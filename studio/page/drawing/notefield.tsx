// The note's field: leaving it writes, `Escape` reverts.
import { useLayoutEffect, useRef } from "preact/hooks";
import { useInSight } from "./choices";
import { noting, take } from "./note";
import { nameOf } from "./shapes";
import { words } from "./words";

export function NoteField() {
  const popup = useRef<HTMLDivElement>(null);
  const field = useRef<HTMLTextAreaElement>(null);
  const open = noting.value;
  useInSight(open?.at ?? null, popup, open);
  useLayoutEffect(() => field.current?.focus(), [open]);
  if (!open) return null;
  const end = (keep: boolean): void => {
    if (noting.peek() === open) void take(keep ? (field.current?.value ?? "") : open.text);
  };
  const key = (event: KeyboardEvent): void => {
    const done = event.key === "Enter" && (event.ctrlKey || event.metaKey);
    if (!done && event.key !== "Escape") return;
    event.preventDefault();
    event.stopPropagation();
    end(done);
  };
  return (
    <div class="over note-field" ref={popup}>
      <div class="chooser-title">{words.noteOf(nameOf(open.item))}</div>
      <textarea ref={field} rows={4} aria-label={words.noteOf(nameOf(open.item))} placeholder={words.noteHint} defaultValue={open.text} onKeyDown={key} onBlur={() => end(true)} />
    </div>
  );
}
