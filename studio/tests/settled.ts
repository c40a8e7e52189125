// Waits for values of programs that run next to a test.

/** Longest wait, milliseconds. */
export const PATIENCE = 10_000;

/** Reads until the value is as wanted, or the wait is over. */
export async function settled(read: () => Promise<string>, isWanted: (now: string) => boolean): Promise<string> {
  const end = Date.now() + PATIENCE;
  for (;;) {
    const now = await read();
    if (isWanted(now) || Date.now() > end) return now;
    await new Promise((done) => setTimeout(done, 30));
  }
}
