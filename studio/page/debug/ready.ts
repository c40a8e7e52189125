// Whether the displayed plan can run; otherwise the reason is shown.
import { effect } from "@preact/signals";
import { current } from "../documents/documents";
import { drawing, isEmpty, plan, trail, wanted, type Place } from "../drawing/model";
import type { Entry } from "../drawing/shapes";
import { trouble } from "../panes/files";
import { point } from "../plan/places";
import { problemsOf, severityOf } from "../plan/problems";
import { select } from "../plan/selection";
import { trusted } from "../jobs/trust";
import { words } from "../words";
import { isWritten } from "./written";

/**
 * The plan to run: the root of the path to the displayed plan. The last choice counts, even while
 * its drawing is loading.
 */
export const toRun = (): Place => trail.value[0] ?? { uri: current.value, plan: wanted.value ?? plan.value ?? "" };
export const planToRun = (): string => toRun().plan;

/** Inputs without a value in the plan or in `given`, as far as known. */
function inputsMissing(given: object): Entry[] {
  const drawn = drawing.value;
  if (drawn?.uri !== current.value || drawn.plan !== planToRun()) return [];
  return drawn.entries.filter(({ kind, name, value }) => kind === "in" && name !== null && !value && !(name in given));
}

/** Whether a run can start with the `given` inputs. */
export async function canRun(given: object): Promise<boolean> {
  const { uri } = toRun();
  const isHere = (): boolean => toRun().uri === uri;
  const errors = (): number => problemsOf(uri).filter((each) => severityOf(each) === "error").length;
  const count = errors();
  if (isEmpty.peek()) return refuse(words.notRunEmpty, () => isHere() && isEmpty.value);
  if (count) {
    refuse(words.notRun(count), () => isHere() && errors() === count);
    await point(uri, problemsOf(uri)[0]!.range);
    return false;
  }
  if (drawing.peek()?.plan === null) return refuse(words.notRunNoPlan, () => isHere() && drawing.value?.plan === null);
  const [missing] = inputsMissing(given);
  if (missing) {
    select([{ item: missing.item }], "other");
    return refuse(words.notRunNoValue(planToRun(), missing.name!, missing.type ?? ""), () => inputsMissing(given).some(({ item }) => item === missing.item));
  }
  if (!(await isWritten())) return refuse(words.notRunNotSaved, isHere);
  trouble.value = null;
  return trusted(uri);
}

/** Shows an obstacle until it is resolved. */
function refuse(why: string, isThere: () => boolean): false {
  trouble.value = why;
  const ends = effect(() => {
    if (trouble.value === why && isThere()) return;
    // After `effect` has returned its end function.
    queueMicrotask(() => ends());
    if (trouble.peek() === why) trouble.value = null;
  });
  return false;
}
