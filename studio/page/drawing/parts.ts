// The parts of an item, as the engine reads them: ports with bindings, exits with targets, times,
// help, the declaration of a computation.
import * as ask from "./ask";
import { offerOf } from "./catalog";
import type { Choice } from "./choose";
import type { Part } from "./shapes";
import { words } from "./words";

export interface Port {
  part: Part;
  name: string;
  out: boolean;
  answer: ask.PortAnswer | null;
}

export interface Exit {
  part: Part;
  name: string;
  /** Target as written; empty for none. */
  to: string;
}

export interface Component extends Omit<ask.Parts, "ports" | "exits"> {
  item: string;
  offer: ask.Offer | null;
  ports: Port[];
  exits: Exit[];
}

/** The parts of an element or supervisor; null for another item. */
export async function component(item: string): Promise<Component | null> {
  const found = await ask.parts(item);
  if (!found?.kind || !found.template) return null;
  const part = (kind: string, name: string): Part => ({ item, part: { kind, name, nth: 1 } });
  const ports = found.ports.map((port) => ({ ...port, part: part(port.out ? "output" : "input", port.name) }));
  const exits = found.exits.map((exit) => ({ ...exit, part: part("exit", exit.name) }));
  return { ...found, item, offer: offerOf(found.template), ports, exits };
}

/** The state of a port's value: bound, default, or required. */
export function worth({ answer, out }: Port): string {
  if (answer?.value) return answer.value;
  if (out) return "";
  return answer?.default ? words.isDefault(answer.default) : words.needsValue;
}

export function choices(found: Component): { choice: Choice; part: Part }[] {
  const ports = found.ports.map((port) => ({ choice: { id: `port ${port.name}`, label: port.name, hint: worth(port) }, part: port.part }));
  const exits = found.exits.map((exit) => ({ choice: { id: `exit ${exit.name}`, label: exit.name, hint: exit.to ? `→ ${exit.to}` : words.open }, part: exit.part }));
  return [...ports, ...exits];
}
