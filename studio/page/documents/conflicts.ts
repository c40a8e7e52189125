// Two texts of one document that do not go together: somebody has to choose.
import { signal } from "@preact/signals";

export type Keep = "mine" | "theirs" | "both";

export interface Conflict {
  uri: string;
  choices: Keep[];
  /** A text that exists only here; null if the room has it. */
  mine: string | null;
  choose(keep: Keep): Promise<void>;
}

export const conflicts = signal<readonly Conflict[]>([]);

/** Asks for a choice, in place of an older one of that text; it is settled once it was made. */
export function dispute(one: Conflict): void {
  const choose = async (keep: Keep): Promise<void> => {
    await one.choose(keep);
    conflicts.value = conflicts.value.filter((each) => each !== asked);
  };
  const asked = { ...one, choose };
  conflicts.value = [...conflicts.value.filter(({ uri }) => uri !== one.uri), asked];
}

/** The room holds one text again. */
export function settle(uri: string): void {
  conflicts.value = conflicts.value.filter((one) => one.uri !== uri || one.mine !== null);
}
