// The plan as nested lists of buttons, for screen readers and for readers who prefer text.
import { drawing } from "../drawing/model";
import { spoken } from "../drawing/say";
import { keyOf, same, type Drawing } from "../drawing/shapes";
import { at } from "../debug/follow";
import { frames, state } from "../debug/run";
import { tree, type Twig } from "../plan/outline";
import { select, selected } from "../plan/selection";
import { words } from "../words";

export function Outline() {
  const drawn = drawing.value;
  if (!drawn || drawn.plan === null) return <p class="empty">{words.noOutline}</p>;
  const now = state.value;
  const running = now ? at(frames.value, drawn.plan, now.stack, now.watching) : { active: [], watching: [] };
  const active = new Set([...running.active.map(({ item }) => item), ...running.watching]);
  return <Twigs all={tree(drawn)} drawn={drawn} active={active} />;
}

interface Shown {
  drawn: Drawing;
  active: ReadonlySet<string>;
}

const Twigs = ({ all, ...shown }: Shown & { all: readonly Twig[] }) => (
  <ul class="outline">{all.map((twig) => <One twig={twig} {...shown} key={keyOf(twig.part)} />)}</ul>
);

function One({ twig: { part, inside }, drawn, active }: Shown & { twig: Twig }) {
  const lively = !part.part && active.has(part.item);
  const chosen = selected.value.some((each) => same(each, part));
  return (
    <li>
      <button class={lively ? "active" : ""} aria-pressed={chosen} onClick={() => select([part], "other")}>
        {spoken(drawn, part)}
        {lively && `, ${words.isActive}`}
      </button>
      {inside.length > 0 && <Twigs all={inside} drawn={drawn} active={active} />}
    </li>
  );
}
