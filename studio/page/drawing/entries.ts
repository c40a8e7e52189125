// Adding an entry by a form: name, kind, type and value. `panes/newentry.tsx` shows it.
import { signal } from "@preact/signals";
import * as actions from "./actions";
import * as ask from "./ask";
import { refuse } from "./say";
import { planOf, type Part } from "./shapes";

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

/** Moves the value of an input to a new variable of the same name, and selects the variable. */
export const moved = ({ item, part }: Part, text: string): Promise<string[] | null> => {
  const name = part?.name ?? "";
  const addEntry = { plan: planOf(item), keyword: "var", name, value: text };
  return ask.edit([{ addEntry }, { bind: { component: item, port: name, to: { in: name } } }]);
};

const added = ({ name, kind, type, value }: Entry): ask.Change => ({
  addEntry: { plan: adding.peek()?.plan ?? "", keyword: kind, name, ty: type || null, value: value || null },
});

/** The reason why an entry would be rejected; null if it is accepted. */
export const refusal = (entry: Entry): Promise<string | null> => ask.refused([added(entry)]);

/** Adds an entry; returns whether it was accepted. */
export const take = async (entry: Entry): Promise<boolean> => (await ask.edit([added(entry)])) !== null;
