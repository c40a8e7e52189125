// Creating the first plan of a file.
import { current, nameOf } from "../documents/documents";
import * as ask from "./ask";
import { drawing } from "./model";
import * as offers from "./offers";
import { refuse } from "./say";
import { words } from "./words";

/** The usual plan name for a file: `WallFollowing` for `wall_following.afp`. */
export function nameFor(file: string): string {
  const parts = file.split("/").at(-1)!.replace(/\.afp$/, "").split(/[-_. ]+/);
  return parts.map((part) => part.charAt(0).toUpperCase() + part.slice(1)).join("");
}

const planOf = (name: string): ask.Change => ({ addPlan: { text: `plan ${name} {\n}\n` } });

/** Creates a plan, with an optional element of a template. */
export async function beginPlan(offer?: ask.Offer): Promise<void> {
  if (drawing.peek()?.plan !== null) return refuse(words.comes);
  const wished = nameFor(nameOf(current.peek()));
  const name = (await ask.refused([planOf(wished)])) === null ? wished : "Plan";
  await ask.edit([planOf(name), ...(offer ? offers.added(name, null, offer, null) : [])]);
}
