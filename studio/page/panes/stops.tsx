// Breakpoints as a list: each with its line, condition or log message.
import { change, FILTERS, filters, stopsOf, toggle, type Stop } from "../debug/breakpoints";
import { current, text } from "../documents/documents";
import { reveal } from "../plan/places";
import { Tool } from "../screen/bar";
import { words } from "../words";

export function Stops() {
  const uri = current.value;
  const all = stopsOf(uri);
  const lines = text(uri).split("\n");
  const filter = (name: string, on: boolean): void => {
    filters.value = on ? [...filters.peek(), name] : filters.peek().filter((each) => each !== name);
  };
  return (
    <section class="stops" aria-label={words.stops}>
      <h3>{words.stops}</h3>
      <div class="scroll">
        {FILTERS.map((name) => (
          <label class="filter" key={name}>
            <input type="checkbox" checked={filters.value.includes(name)} onChange={(event) => filter(name, event.currentTarget.checked)} />
            {words.filters[name]}
          </label>
        ))}
        {all.length === 0 && <p class="none">{words.noStops}</p>}
        <ul>{all.map((stop) => <One stop={stop} uri={uri} code={(lines[stop.line] ?? "").trim()} key={stop.line} />)}</ul>
      </div>
    </section>
  );
}

function One({ stop: { line, off, condition, log }, uri, code }: { stop: Stop; uri: string; code: string }) {
  const place = { line, character: 0 };
  const take = (name: "condition" | "log") => (event: Event & { currentTarget: HTMLInputElement }) => change(uri, line, { [name]: event.currentTarget.value.trim() || undefined });
  return (
    <li>
      <div class="line">
        <input type="checkbox" checked={!off} aria-label={words.stopAt(line + 1)} onChange={(event) => change(uri, line, { off: event.currentTarget.checked ? undefined : true })} />
        <button onClick={() => void reveal(uri, { start: place, end: place }, "other")}>{`${line + 1}  ${code}`}</button>
        <Tool icon="close" label={words.stopNoMore(line + 1)} run={() => toggle(uri, line)} />
      </div>
      <input aria-label={words.stopWhile(line + 1)} placeholder={words.conditionHint} value={condition ?? ""} spellcheck={false} onChange={take("condition")} />
      <input aria-label={words.sayAt(line + 1)} placeholder={words.logHint} value={log ?? ""} spellcheck={false} onChange={take("log")} />
    </li>
  );
}
