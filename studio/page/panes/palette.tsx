// Templates for the plan: searched, grouped, added after the selection by a click or at a place by
// dragging.
import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { current } from "../documents/documents";
import { addAfter } from "../drawing/actions";
import * as ask from "../drawing/ask";
import { offers } from "../drawing/catalog";
import { Icon } from "../drawing/choices";
import { carried, grab } from "../drawing/bring";
import { choice } from "../drawing/offers";
import { words } from "../drawing/words";
import * as layout from "../screen/layout";
import { pen } from "../server/session";

const typed = signal("");
const GROUPS = ["actor", "supervise", "computation", "subplan"] as const;

export function Palette() {
  const [found, setFound] = useState<readonly ask.Offer[] | null>(null);
  const query = typed.value;
  const all = offers.value;
  useEffect(() => {
    if (!query.trim()) return setFound(null);
    let wanted = true;
    ask.palette(query).then((list) => wanted && setFound(list), () => {});
    return () => void (wanted = false);
  }, [query, current.value, all]);
  const list = found ?? all;
  return (
    <div class="palette-list">
      <input type="search" aria-label={words.paletteSearch} placeholder={words.paletteSearch} value={query} onInput={(event) => (typed.value = event.currentTarget.value)} spellcheck={false} />
      {list.length === 0 && query && <p class="empty">{words.paletteEmpty}</p>}
      {GROUPS.map((kind) => <Group key={kind} kind={kind} list={list.filter((offer) => offer.kind === kind)} />)}
      {carried.value && <Carried offer={carried.value.offer} />}
    </div>
  );
}

function Group({ kind, list }: { kind: string; list: readonly ask.Offer[] }) {
  if (list.length === 0) return null;
  return (
    <details open class={`palette-group ${kind}`}>
      <summary>
        <span>{words.groups[kind]}</span> <small>{words.groupHints[kind]}</small>
      </summary>
      <ul>{list.map((offer) => <Item key={choice(offer).id} offer={offer} />)}</ul>
    </details>
  );
}

function Item({ offer }: { offer: ask.Offer }) {
  const from = offer.missingUse ? `\n${words.fromToolbox(offer.missingUse)}` : "";
  return (
    <li>
      <button
        type="button" disabled={!pen.value} data-template={offer.template} aria-label={words.addTemplate(offer.template)} title={`${offer.help}${from}`}
        onPointerDown={(event) => grab(offer, event)} onClick={() => !carried.peek() && tapped(offer)}
      >
        <Icon svg={offer.icon} />
        <span>{offer.template}</span>
      </button>
    </li>
  );
}

/** Adds a template. On a narrow page, the drawing then takes the place of the palette. */
function tapped(offer: ask.Offer): void {
  layout.show("drawing");
  void addAfter(offer);
}

/** The template under the pointer during a drag. */
function Carried({ offer }: { offer: ask.Offer }) {
  const at = carried.value!.at;
  return (
    <div class={`carried ${offer.kind}`} ref={(node) => { node?.style.setProperty("transform", `translate(${at[0] + 8}px, ${at[1] + 8}px)`); }}>
      <Icon svg={offer.icon} />
      <span>{offer.template}</span>
    </div>
  );
}
