// The debugger's text hash: 64-bit FNV-1a, in two halves.

/** The hash of a text, independent of its line ends. */
export function hash(text: string): string {
  let [high, low] = [0xcbf29ce4, 0x84222325];
  for (const byte of new TextEncoder().encode(text.replace(/^\uFEFF/, "").replaceAll("\r\n", "\n"))) {
    low = (low ^ byte) >>> 0;
    // Times 2^40 + 0x1b3.
    const product = low * 0x1b3;
    high = (Math.imul(high, 0x1b3) + Math.floor(product / 2 ** 32) + (low << 8)) >>> 0;
    low = product >>> 0;
  }
  return [high, low].map((half) => half.toString(16).padStart(8, "0")).join("");
}

/**
 * Whether a text differs from the running version of its file; false for files that are not
 * running.
 */
export const differs = (sources: { readonly [path: string]: string }, path: string, text: string): boolean =>
  sources[path] !== undefined && sources[path] !== hash(text);
