// Maximum text length of the server.
import { hello } from "../server/session";
import { words } from "../words";

/** Maximum bytes per character. */
const BYTES = 3;
const encoder = new TextEncoder();

/** The reason why a text is too long; null if it fits. A text that is too long may still shrink. */
export function tooLong(before: number, after: { readonly length: number; toString(): string }): string | null {
  const longest = hello.peek()?.longest ?? Infinity;
  if (after.length <= before || after.length * BYTES <= longest) return null;
  return encoder.encode(after.toString()).length > longest ? words.tooLong(longest) : null;
}
