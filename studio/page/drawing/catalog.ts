// The engine's palette, cached for the displayed document.
import { effect, signal } from "@preact/signals";
import { current, onText } from "../documents/documents";
import { lsp } from "../server/session";
import * as ask from "./ask";

export const offers = signal<readonly ask.Offer[]>([]);

/** Pause in typing before a reload, milliseconds: a text may import another toolbox. */
const QUIET = 400;

export function begin(): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const load = async (): Promise<void> => {
    const uri = current.peek();
    if (!uri || !lsp().open.peek()) return;
    const found = await ask.palette("").catch(() => null);
    if (found && current.peek() === uri) offers.value = found;
  };
  const later = (): void => {
    clearTimeout(timer);
    timer = setTimeout(load, QUIET);
  };
  const texts = onText(later);
  const documents = effect(() => {
    if (current.value && lsp().open.value) void load();
  });
  return () => {
    texts();
    documents();
    clearTimeout(timer);
  };
}

/** The offer of a template, with or without the alias of its toolbox. */
export const offerOf = (template: string | null): ask.Offer | null => offers.value.find((offer) => offer.template === template || offer.template === template?.split(".").at(-1)) ?? null;
