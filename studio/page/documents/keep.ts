// Keeps the history across reloads, in the tab's storage, if the texts are unchanged.
import { effect } from "@preact/signals";
import { open, text } from "./documents";
import { hash } from "./hash";
import { log, type Entry, type Log } from "./history";

const KEY = "afp-studio-history";
/** Maximum number of stored characters; older entries are dropped. */
const MOST = 500_000;
/** Delay before a change is stored, milliseconds. */
const PAUSE = 300;

interface Kept extends Log {
  texts: Record<string, string>;
}

const urisOf = ({ past, future }: Log): string[] => [...new Set([...past, ...future].flatMap((entry) => entry.steps.map((step) => step.uri)))];

/** The newest entries within a size limit. */
export function newest(entries: readonly Entry[], room: number): Entry[] {
  const found: Entry[] = [];
  for (const entry of [...entries].reverse()) {
    room -= JSON.stringify(entry).length;
    if (room < 0) break;
    found.unshift(entry);
  }
  return found;
}

/** Restores the history and starts to store it. */
export async function begin(storage: Storage): Promise<void> {
  const kept = read(storage);
  if (kept && log.peek().past.length === 0) {
    const uris = urisOf(kept);
    await Promise.all(uris.map(open)).catch(() => {});
    const same = uris.every((uri) => hash(text(uri)) === kept.texts[uri]);
    if (same && log.peek().past.length === 0) log.value = { past: kept.past, future: kept.future };
  }
  let timer: ReturnType<typeof setTimeout>;
  const write = (): void => {
    const past = newest(log.peek().past, MOST);
    const all: Log = { past, future: newest(log.peek().future, MOST) };
    const texts = Object.fromEntries(urisOf(all).map((uri) => [uri, hash(text(uri))]));
    try {
      storage.setItem(KEY, JSON.stringify({ ...all, texts }));
    } catch {
      storage.removeItem(KEY);
    }
  };
  effect(() => {
    void log.value;
    clearTimeout(timer);
    timer = setTimeout(write, PAUSE);
  });
  addEventListener("pagehide", write);
}

function read(storage: Storage): Kept | null {
  try {
    const kept = JSON.parse(storage.getItem(KEY) ?? "null");
    return kept && Array.isArray(kept.past) && Array.isArray(kept.future) ? kept : null;
  } catch {
    return null;
  }
}
