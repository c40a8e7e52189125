// The form for a new entry. Type and value are checked by the engine.
import { useEffect, useState } from "preact/hooks";
import { adding, refusal, take } from "../drawing/entries";
import { words } from "../drawing/words";
import { useModal } from "../screen/modal";
import { words as page } from "../words";

export function NewEntry() {
  const open = adding.value;
  return open ? <Form types={open.types} key={open.plan} /> : null;
}

function Form({ types }: { types: readonly string[] }) {
  const [name, setName] = useState("value");
  const [kind, setKind] = useState("var");
  const [type, setType] = useState(types.includes("length") ? "length" : "");
  const [value, setValue] = useState("");
  const close = (): void => void (adding.value = null);
  const dialog = useModal((open) => open.querySelector("input")?.select());
  const entry = { name: name.trim(), kind, type, value: value.trim() };
  const isEmpty = !type && !entry.value;
  const [refused, setRefused] = useState<string | null>(null);
  // The engine checks the name and the other fields while they change.
  useEffect(() => {
    let wanted = true;
    void refusal(entry).then((why) => wanted && setRefused(why));
    return () => void (wanted = false);
  }, [name, kind, type, value]);
  const wrong = isEmpty ? words.needsValue : refused;
  const submit = async (event: Event): Promise<void> => {
    event.preventDefault();
    if (!wrong && (await take(entry))) close();
  };
  return (
    <dialog class="entry-form" ref={dialog} aria-labelledby="entry-form" onCancel={close}>
      <form onSubmit={(event) => void submit(event)}>
        <h2 id="entry-form">{words.addEntry}</h2>
        <label class="line"><span>{words.name}</span><input type="text" value={name} aria-invalid={wrong !== null} spellcheck={false} autocomplete="off" onInput={(event) => setName(event.currentTarget.value)} /></label>
        <label class="line">
          <span>{words.kindOf}</span>
          <select value={kind} onChange={(event) => setKind(event.currentTarget.value)}>
            {Object.entries(words.entryKinds).map(([each, label]) => <option value={each} key={each}>{label}</option>)}
          </select>
        </label>
        <label class="line">
          <span>{words.typeOf}</span>
          <select value={type} onChange={(event) => setType(event.currentTarget.value)}>
            <option value="">{words.typeOfValue}</option>
            {types.map((each) => <option value={each} key={each}>{each}</option>)}
          </select>
        </label>
        <label class="line"><span>{words.valueTitle}</span><input type="text" value={value} placeholder={words.noValue} spellcheck={false} autocomplete="off" onInput={(event) => setValue(event.currentTarget.value)} /></label>
        <p class="wrong" role="status">{wrong}</p>
        <div class="choices">
          <button type="button" onClick={close}>{page.cancel}</button>
          <button type="submit" class="main" disabled={wrong !== null}>{words.addEntry}</button>
        </div>
      </form>
    </dialog>
  );
}
