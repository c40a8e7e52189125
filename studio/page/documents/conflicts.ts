// Conflicting texts of a document: the user has to choose.
import { signal } from "@preact/signals";

export type Keep = "mine" | "theirs" | "both";

export interface Conflict {
  uri: string;
  choices: Keep[];
  /** Text that exists only in the page; null if the room has it. */
  mine: string | null;
  choose(keep: Keep): Promise<void>;
}

export const conflicts = signal<readonly Conflict[]>([]);

/** Asks for a choice, instead of an older question about the same text. */
export function dispute(one: Conflict): void {
  const choose = async (keep: Keep): Promise<void> => {
    await one.choose(keep);
    conflicts.value = conflicts.value.filter((each) => each !== asked);
  };
  const asked = { ...one, choose };
  conflicts.value = [...conflicts.value.filter(({ uri }) => uri !== one.uri), asked];
}

/** Withdraws a question: the room has one text again. */
export function settle(uri: string): void {
  conflicts.value = conflicts.value.filter((one) => one.uri !== uri || one.mine !== null);
}
