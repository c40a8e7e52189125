// Addresses of documents and paths of files. The server knows a document by its one address: it is written here as there.
import { hello } from "../server/session";

/** The path of a document, as the debugger says it. */
export const pathOf = (uri: string): string => decodeURIComponent(new URL(uri).pathname);

/** The address of a file: its path from the root of the folder, or a whole one. */
export function uriOf(path: string): string {
  const root = path.startsWith("/") ? "file://" : `${hello.peek()!.root.replace(/\/$/, "")}/`;
  return root + path.split("/").map(encoded).join("/");
}

/** Part of a path in an address: signs that browsers let stand are written out, too. */
const encoded = (part: string): string =>
  encodeURIComponent(part).replace(/[!'()*]/g, (sign) => `%${sign.charCodeAt(0).toString(16).toUpperCase()}`);
