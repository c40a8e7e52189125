// Whether what lies in the folder may be built and run: asked once, where there is something.
import { ask } from "../screen/dialogs";
import { lsp } from "../server/session";
import { words } from "../words";

/** Asks, where it has to be asked, whether what lies in the folder, or is needed for a file of it, may run; remembers the answer. */
export async function trusted(file?: unknown, always = false): Promise<boolean> {
  const known = await lsp().request<{ trusted: boolean; folder: string; code: string[] }>("afp/trust", file ? { file } : {});
  if (known.trusted || (!always && !known.code.length)) return true;
  const yes = (await ask(words.trust(known.folder), words.trustBody(known.code), [words.trustIt])) !== null;
  if (yes) await lsp().request("afp/trust", { give: true });
  return yes;
}
