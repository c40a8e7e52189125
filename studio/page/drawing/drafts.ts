// Invalid text in a field: it stays, marked, until corrected or reverted with `Escape`.
const drafts = new Map<string, string>();

/** The text kept in a field; undefined without one. */
export const draft = (field: string): string | undefined => drafts.get(field);

/** Writes a text, and keeps it if rejected; returns whether it was written. */
export async function written(field: string, text: string, write: () => Promise<unknown>): Promise<boolean> {
  const done = Boolean(await write());
  if (done) drafts.delete(field);
  else drafts.set(field, text);
  return done;
}

export const putBack = (field: string): void => void drafts.delete(field);
