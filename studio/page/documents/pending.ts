// What was made of a text here and may not have reached the room yet: what the room says meanwhile goes around it, so that
// neither takes anything from the other.
import { ChangeSet, Text } from "@codemirror/state";
import { difference, sequence } from "./changes";
import type { Change } from "./history";

/** A text as the room is known to have it, and what was told since. */
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

/** One more version was told. */
export const told = ({ base, made }: Pending, version: number, changes: ChangeSet): Pending => ({ base, made: [...made, { version, changes }] });

/** The room has a version, and with it all before. */
export function reached({ base, made }: Pending, version: number): Pending {
  const there = made.filter((each) => each.version <= version);
  if (there.length === 0) return { base, made };
  const text = there.reduce((text, { changes }) => changes.apply(text), doc(base));
  return { base: text.toString(), made: made.slice(there.length) };
}

/** The room has another text, made with a version in sight: what that changes in the text that is here. */
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

/** Whether the room may have a text: the one that it was known to have, or one that it was told since. */
export function mayBe({ base, made }: Pending, text: string): boolean {
  if (base === text) return true;
  let each = doc(base);
  return made.some(({ changes }) => {
    each = changes.apply(each);
    return each.length === text.length && each.toString() === text;
  });
}
