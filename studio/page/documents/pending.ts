// Local changes that may not have reached the room: the room's changes are merged with them, so
// that both are kept.
import { ChangeSet, Text } from "@codemirror/state";
import { difference, sequence } from "./changes";
import type { Change } from "./history";

/** A text known to the room, and the changes sent since then. */
export interface Pending {
  readonly base: string;
  /** One after the other, with the versions that they made. */
  readonly made: readonly { version: number; changes: ChangeSet }[];
}

const doc = (text: string): Text => Text.of(text.split("\n"));

/** Changes that are made one after the other of a text of some length, as one. */
export function together(changes: readonly Change[], length: number): ChangeSet {
  return changes.reduce((all, { from, to, insert }) => all.compose(ChangeSet.of({ from, to, insert }, all.newLength)), ChangeSet.empty(length));
}

/** A text that the room has. */
export const known = (base: string): Pending => ({ base, made: [] });

/** Counts a sent version. */
export const told = ({ base, made }: Pending, version: number, changes: ChangeSet): Pending => ({ base, made: [...made, { version, changes }] });

/** The room has a version, and with it all before. */
export function reached({ base, made }: Pending, version: number): Pending {
  const there = made.filter((each) => each.version <= version);
  if (there.length === 0) return { base, made };
  const text = there.reduce((text, { changes }) => changes.apply(text), doc(base));
  return { base: text.toString(), made: made.slice(there.length) };
}

/** Merges a text of the room, based on a known version, into the local text. */
export function arrived(uri: string, before: Pending, version: number, text: string): [Pending, Change[]] {
  const { base, made } = reached(before, version);
  let news = together(difference(uri, base, text), base.length);
  const moved = made.map(({ version, changes }) => {
    const after = changes.map(news);
    news = news.map(changes, true);
    return { version, changes: after };
  });
  return [{ base: text, made: moved }, sequence(uri, news)];
}

/** Whether the room may have a text: the last known one, or one sent since then. */
export function mayBe({ base, made }: Pending, text: string): boolean {
  if (base === text) return true;
  let each = doc(base);
  return made.some(({ changes }) => {
    each = changes.apply(each);
    return each.length === text.length && each.toString() === text;
  });
}
