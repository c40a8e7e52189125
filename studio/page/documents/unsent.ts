// Keeps unsent texts beyond the page: they are stored in the browser and offered when their file is
// opened again. Each page has its own key, since several may show one file.
import { effect } from "@preact/signals";
import { offer, opened, saved, text, unsent } from "./documents";
import { lsp } from "../server/session";

const PREFIX = "afp-studio-unsent-";
/** Time before an unsent text is stored, milliseconds. */
const PAUSE = 300;

export interface Kept {
  /** Time in milliseconds. */
  at: number;
  texts: readonly { uri: string; text: string }[];
}

type Pages = Pick<Storage, "getItem" | "setItem" | "removeItem" | "key" | "length">;

/** The stored texts by key, newest first. */
export function kept(storage: Pages): [string, Kept][] {
  const keys = Array.from({ length: storage.length }, (_, at) => storage.key(at)!).filter((key) => key.startsWith(PREFIX));
  return keys.flatMap((key) => read(storage, key)).sort(([, a], [, b]) => b.at - a.at);
}

function read(storage: Pages, key: string): [string, Kept][] {
  try {
    const found = JSON.parse(storage.getItem(key) ?? "null");
    return Array.isArray(found?.texts) ? [[key, found]] : [];
  } catch {
    return [];
  }
}

/** Stores texts under a key; without texts, removes the key. */
export function keep(storage: Pages, key: string, { at, texts }: Kept): void {
  try {
    if (texts.length > 0) storage.setItem(key, JSON.stringify({ at, texts }));
    else storage.removeItem(key);
  } catch {
    // The storage is full: the page still has the texts, and warns when it is closed.
  }
}

/** Takes the newest stored text of a file, unless it equals the file. */
export function claim(storage: Pages, uri: string, now: string): string | null {
  for (const [key, { at, texts }] of kept(storage)) {
    const found = texts.findLast((one) => one.uri === uri);
    if (!found) continue;
    keep(storage, key, { at, texts: texts.filter((one) => one !== found) });
    if (found.text !== now) return found.text;
  }
  return null;
}

export function begin(storage: Storage): void {
  const key = `${PREFIX}${Date.now().toString(36)}${Math.random().toString(36).slice(2)}`;
  const write = (): void => keep(storage, key, { at: Date.now(), texts: unsent.peek() });
  let timer: ReturnType<typeof setTimeout>;
  effect(() => {
    void unsent.value;
    clearTimeout(timer);
    timer = setTimeout(write, PAUSE);
  });
  const seen = new Set<string>();
  effect(() => {
    for (const uri of opened.value) {
      if (seen.has(uri)) continue;
      seen.add(uri);
      const mine = claim(storage, uri, text(uri));
      // After all listeners know the open text.
      if (mine !== null) queueMicrotask(() => offer(uri, mine));
    }
  });
  addEventListener("pagehide", write);
  addEventListener("beforeunload", (event) => {
    const lost = saved.peek() !== "saved" && (saved.peek() !== "saving" || !lsp().open.peek());
    if (lost) event.preventDefault();
  });
}
