// Extracting elements into a plan, and inlining a sub-plan.
import { askLine } from "../screen/dialogs";
import { select, selected } from "../plan/selection";
import * as actions from "./actions";
import * as ask from "./ask";
import { taken } from "./offers";
import { refuse } from "./say";
import { holderOf, nameOf } from "./shapes";
import { words } from "./words";

/** The selected elements; for a supervisor, its owner. */
export function chosen(): string[] {
  const at = actions.here();
  const found = at ? selected.peek().map((part) => holderOf(at.drawn, part.item)) : [];
  return [...new Set(found.flatMap((element) => (element && element.kind !== null ? [element.item] : [])))];
}

/** A free name: the preferred one, possibly with the least free number. */
function free(wished: string, names: ReadonlySet<string>): string {
  for (let nth = 1; ; nth++) {
    const name = nth === 1 ? wished : `${wished}${nth}`;
    if (!names.has(name)) return name;
  }
}

/** Extracts the selected elements into a plan and replaces them by a sub-plan. */
export async function extract(): Promise<void> {
  const at = actions.here();
  const elements = chosen();
  if (!at || elements.length === 0) return refuse(words.selectFirst);
  const plans = new Set(at.drawn.plans);
  const change = (newPlan: string): ask.Change => {
    const element = free(newPlan.charAt(0).toLowerCase() + newPlan.slice(1), taken(at.drawn));
    return { extract: { plan: at.plan, elements: elements.map(nameOf), newPlan, element } };
  };
  const why = await ask.refused([change(free("Part", plans))]);
  if (why !== null) return refuse(new Error(why));
  const wrong = (name: string): string | null => (plans.has(name) ? words.planTaken(name) : null);
  const newPlan = await askLine(words.extract, words.extractHint(elements.length), free("Part", plans), words.extractDone, wrong);
  if (newPlan === null) return;
  const extracted = change(newPlan);
  await ask.edit([extracted], {}, [{ item: `${at.plan}.${extracted.extract!.element}` }]);
}

export function isSubPlan(): boolean {
  const [item, more] = chosen();
  return item !== undefined && more === undefined && actions.here()?.drawn.elements.get(item)?.plan != null;
}

/** Replaces the selected sub-plan by its elements. */
export async function inline(): Promise<void> {
  const at = actions.here();
  const [item] = chosen();
  if (!at || !item || !isSubPlan()) return refuse(words.noSubPlan);
  const before = new Set(at.drawn.elements.keys());
  if (!(await ask.edit([{ inline: { plan: at.plan, element: nameOf(item) } }], {}, []))) return;
  select([...(actions.here()?.drawn.elements.keys() ?? [])].filter((known) => !before.has(known)).map((item) => ({ item })), "drawing");
}
