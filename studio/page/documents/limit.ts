// The longest text that the server writes and opens.
import { hello } from "../server/session";
import { words } from "../words";

/** A letter takes at most so many bytes in a file. */
const BYTES = 3;
const encoder = new TextEncoder();

/** Why a text of some length may not become another one; null where it may. One that is too long may still become shorter. */
export function tooLong(before: number, after: { readonly length: number; toString(): string }): string | null {
  const longest = hello.peek()?.longest ?? Infinity;
  if (after.length <= before || after.length * BYTES <= longest) return null;
  return encoder.encode(after.toString()).length > longest ? words.tooLong(longest) : null;
}
