// A robot that drives by itself: attached, held, stepped while a key or a button is pressed.
import { signal } from "@preact/signals";
import { refuse } from "../drawing/say";
import { command } from "../screen/commands";
import { askLine } from "../screen/dialogs";
import { words } from "../words";
import { robot } from "./attached";
import { shown } from "./logs";
import { attach, leave, next, order, phase } from "./run";

const KEY = "afp-studio-robot";

/** Whether a step lasts until its key or button is released. */
const steps = signal(false);

/** A host or a path; commands and options of ssh are not hosts. */
const wrong = (place: string): string | null => (/^(?!-|exec:)\S+$/.test(place.trim()) ? null : words.attachWrong);

/** Asks for a robot, and attaches to it. */
export async function askRobot(): Promise<void> {
  const place = await askLine(words.attach, words.attachHint, localStorage.getItem(KEY) ?? "", words.attachDone, wrong);
  if (!place) return;
  localStorage.setItem(KEY, place.trim());
  await attachTo(place.trim());
}

export async function attachTo(place: string): Promise<void> {
  await attach(place);
  if (robot.peek() && !(await shown())) refuse(words.attachedElsewhere);
}

/** Steps while a key or a button is pressed. */
export function step(): void {
  if (phase.peek() !== "held") return;
  steps.value = true;
  void next();
}

/** Holds the robot in a step. */
function release(): void {
  if (!steps.peek()) return;
  steps.value = false;
  void order("pause");
}

export function begin(page: Window): void {
  command({ id: "attach", label: words.attach, run: askRobot, enabled: () => !robot.value });
  command({ id: "detach", label: words.detach, run: leave, enabled: () => robot.value !== "" });
  for (const event of ["keyup", "pointerup", "pointercancel", "blur", "pagehide"]) page.addEventListener(event, release, true);
  page.document.addEventListener("visibilitychange", release);
  phase.subscribe((now) => {
    if (now === "over" || now === "idle") steps.value = false;
  });
}
