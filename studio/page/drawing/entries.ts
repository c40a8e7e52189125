// Adding an entry by a form: name, kind, type and value. `panes/newentry.tsx` shows it.
import { signal } from "@preact/signals";
import * as actions from "./actions";
import * as ask from "./ask";
import { refuse } from "./say";

/** The open form, with the types to choose from. */
export const adding = signal<{ plan: string; types: readonly string[] } | null>(null);

export interface Entry {
  name: string;
  kind: string;
  /** Empty for the type of the value. */
  type: string;
  /** Empty for none. */
  value: string;
}

/** Opens the form. */
export async function add(): Promise<void> {
  const at = actions.here();
  const found = at && (await ask.parts(at.plan).catch(refuse));
  if (at && found) adding.value = { plan: at.plan, types: found.types };
}

/** Adds an entry; returns whether it was accepted. */
export async function take({ name, kind, type, value }: Entry): Promise<boolean> {
  const plan = adding.peek()?.plan ?? "";
  const entry = `${plan}.${name}`;
  // A type or a value is enough; the engine reads each of them.
  const changes: ask.Change[] = [{ add: { plan, text: `${kind} ${name}: int` } }, { setEntryType: { entry, ty: type || null } }, { setEntryValue: { entry, value: value || null } }];
  const order = type ? changes : [changes[0]!, changes[2]!, changes[1]!];
  return (await ask.edit(order)) !== null;
}
