// The displayed plan's text.
import { useEffect, useRef } from "preact/hooks";
import { command } from "../screen/commands";
import { current, isOpen } from "../documents/documents";
import { askFixes } from "../plan/problems";
import { edit } from "../text/editor";
import { definition, format, mendHere, ordered, rename } from "../text/orders";
import { words } from "../words";

const nonce = (): string => document.querySelector<HTMLMetaElement>("meta[name=nonce]")?.content ?? "";

export function TextPane() {
  const host = useRef<HTMLDivElement>(null);
  const uri = current.value;
  useEffect(askFixes, []);
  useEffect(() => {
    if (!uri || !isOpen(uri)) return;
    const { view, end } = edit(host.current!, uri, nonce());
    const ends = [
      command({ id: "text-definition", label: words.definition, key: "F12", run: ordered(() => definition(view, uri)) }),
      command({ id: "text-rename", label: words.renameInText, key: "F2", run: ordered(() => rename(view, uri)) }),
      command({ id: "text-fix", label: words.fixes, key: "Ctrl+.", run: ordered(() => mendHere(view, uri)) }),
      command({ id: "text-format", label: words.format, key: "Alt+Shift+F", run: ordered(() => format(uri)) }),
      end,
    ];
    return () => ends.forEach((each) => each());
  }, [uri]);
  return <div class="text" ref={host} />;
}
