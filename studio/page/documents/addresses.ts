// Addresses of documents and paths of files. Their spelling must equal the server's.
import { hello } from "../server/session";

/** The path of a document, for the debugger. */
export const pathOf = (uri: string): string => decodeURIComponent(new URL(uri).pathname);

/** The address of a file, from a path that is absolute or relative to the folder. */
export function uriOf(path: string): string {
  const root = path.startsWith("/") ? "file://" : `${hello.peek()!.root.replace(/\/$/, "")}/`;
  return root + path.split("/").map(encoded).join("/");
}

/** Encodes a path part, including characters that browsers leave. */
const encoded = (part: string): string =>
  encodeURIComponent(part).replace(/[!'()*]/g, (sign) => `%${sign.charCodeAt(0).toString(16).toUpperCase()}`);
