// Trust in the folder: asked once, if there is code to build and run.
import { ask } from "../screen/dialogs";
import { lsp } from "../server/session";
import { words } from "../words";

/**
 * Asks, if needed, whether code of the folder, or of a file's project, may run; remembers the
 * answer.
 */
export async function trusted(file?: unknown, always = false): Promise<boolean> {
  const known = await lsp().request<{ trusted: boolean; folder: string; code: string[] }>("afp/trust", file ? { file } : {});
  if (known.trusted || (!always && !known.code.length)) return true;
  const yes = (await ask(words.trust(known.folder), words.trustBody(known.code), [words.trustIt])) !== null;
  if (yes) await lsp().request("afp/trust", { give: true });
  return yes;
}
