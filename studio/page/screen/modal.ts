// A modal dialog: it has the keyboard from its first frame, and returns the focus.
import { useLayoutEffect, useRef } from "preact/hooks";

/** The `ref` of a `<dialog>`; `opened` is called after it opens. */
export function useModal(opened: (dialog: HTMLDialogElement) => void = () => {}) {
  const dialog = useRef<HTMLDialogElement>(null);
  // Before the paint, so that immediate typing reaches the dialog.
  useLayoutEffect(() => {
    const shown = dialog.current!;
    shown.showModal();
    opened(shown);
    // Closing returns the focus.
    return () => shown.close();
  }, []);
  return dialog;
}
