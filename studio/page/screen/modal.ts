// A dialog over everything: it has the keyboard from the frame on in which it appears, and gives the focus back.
import { useLayoutEffect, useRef } from "preact/hooks";

/** The `ref` of a `<dialog>`; `opened` is called after it opens. */
export function useModal(opened: (dialog: HTMLDialogElement) => void = () => {}) {
  const dialog = useRef<HTMLDialogElement>(null);
  // Not after the paint, so that immediate typing reaches the dialog.
  useLayoutEffect(() => {
    const shown = dialog.current!;
    shown.showModal();
    opened(shown);
    // Which gives the focus back; nothing behind a dialog could take it while it is open.
    return () => shown.close();
  }, []);
  return dialog;
}
