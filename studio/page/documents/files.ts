// File operations: rename, copy, remove, restore, download. Positions of a drawing follow their
// plan.
import { signal } from "@preact/signals";
import { isWritten } from "../debug/written";
import { Refused } from "../server/lsp";
import { lsp } from "../server/session";
import { words } from "../words";
import { uriOf } from "./addresses";
import { create, forget, nameOf, open, text } from "./documents";

interface Whole {
  name: string;
  text: string;
}

/** The last removed file, until it is restored or another file is removed. */
export const removed = signal<readonly Whole[] | null>(null);

/** A file, with the positions file of its drawing if there is one. */
async function withPlaces(uri: string): Promise<string[]> {
  const places = `${uri}.layout`;
  await Promise.all([open(uri), open(places)]);
  return text(places) ? [uri, places] : [uri];
}

async function written(): Promise<void> {
  if (!(await isWritten())) throw new Refused(0, words.notRunNotSaved);
}

/** Renames a file; returns its new address. */
export async function rename(uri: string, name: string): Promise<string> {
  await written();
  const to = uriOf(name);
  for (const each of await withPlaces(uri)) {
    await lsp().request("afp/rename", { uri: each, to: to + each.slice(uri.length) });
    forget(each);
  }
  await open(to);
  return to;
}

/** Copies a file; returns the new address. */
export async function duplicate(uri: string, name: string): Promise<string> {
  for (const each of await withPlaces(uri)) await create({ uri: uriOf(name) + each.slice(uri.length), text: text(each) });
  return uriOf(name);
}

/** Removes a file; it can be restored. */
export async function remove(uri: string): Promise<void> {
  await written();
  const gone: Whole[] = [];
  for (const each of await withPlaces(uri)) {
    const name = nameOf(each);
    const { text } = await lsp().request<{ text: string }>("afp/remove", { uri: each });
    gone.push({ name, text });
    forget(each);
  }
  removed.value = gone;
}

/** Restores the last removed file; returns its address. */
export async function putBack(): Promise<string | null> {
  const all = removed.peek() ?? [];
  removed.value = null;
  for (const { name, text } of all) await create({ uri: uriOf(name), text });
  return all[0] ? uriOf(all[0].name) : null;
}

export function download(uri: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text(uri)], { type: "text/plain" }));
  link.download = nameOf(uri).split("/").at(-1)!;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href));
}
