// Local changes that the room may not have: changes of the room are merged with them.
import { ChangeSet, Text } from "@codemirror/state";
import { difference, sequence } from "./changes";
import type { Change } from "./history";

/** A text known to the room, and the changes sent since then. */
export interface Pending {
  readonly base: string;
  /** In order, with their versions. */
  readonly made: readonly { version: number; changes: ChangeSet }[];
}

const doc = (text: string): Text => Text.of(text.split("\n"));

/** Combines sequential changes of a text of some length. */
export function together(changes: readonly Change[], length: number): ChangeSet {
  return changes.reduce((all, { from, to, insert }) => all.compose(ChangeSet.of({ from, to, insert }, all.newLength)), ChangeSet.empty(length));
}

/** A text that the room has. */
export const known = (base: string): Pending => ({ base, made: [] });

/** Adds a sent version. */
export const told = ({ base, made }: Pending, version: number, changes: ChangeSet): Pending => ({ base, made: [...made, { version, changes }] });

/** The room has this version and all earlier ones. */
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

/** Whether the room may have this text: the last known one, or one sent since then. */
export function mayBe({ base, made }: Pending, text: string): boolean {
  if (base === text) return true;
  let each = doc(base);
  return made.some(({ changes }) => {
    each = changes.apply(each);
    return each.length === text.length && each.toString() === text;
  });
}
