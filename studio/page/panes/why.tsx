// The card that explains why an element runs or not, and can inject an outcome.
import { Tool } from "../screen/bar";
import { changes, order } from "../debug/run";
import { close, why, type Edge } from "../debug/why";
import { words } from "../words";

export function WhyCard() {
  const found = why.value;
  if (!found) return null;
  return (
    <section class="why-card" aria-label={words.whyOf(found.path)}>
      <header>
        <h2>{words.whyOf(found.path)}</h2>
        <Tool icon="close" label={words.close(words.why)} run={close} />
      </header>
      <p>{found.since === undefined ? words.neverActive : words.activeSince(found.active, found.since)}</p>
      {found.because && <p class="because">{found.because}</p>}
      <Values of={found.values} />
      {found.edges.length > 0 && <h3>{words.leadTo}</h3>}
      <ul>{found.edges.map((edge) => <Way edge={edge} key={`${edge.from}.${edge.outcome}`} />)}</ul>
    </section>
  );
}

function Way({ edge: { from, outcome, last, looks, values } }: { edge: Edge }) {
  const path = `${from}.${outcome}`;
  return (
    <li class={looks ? "looks" : ""}>
      <strong>{path}</strong>
      <span>{[looks ? words.looksNow : words.looksNot, last === null ? words.neverTaken : words.takenAt(last)].join(", ")}</span>
      <Values of={values} />
      {changes.value && <button onClick={() => void order("afp/force", { path })}>{words.letHappen}</button>}
    </li>
  );
}

const Values = ({ of }: { of: Record<string, string> }) => {
  const all = Object.entries(of);
  return all.length ? <dl>{all.map(([name, value]) => <div key={name}><dt>{name}</dt><dd>{value}</dd></div>)}</dl> : null;
};
