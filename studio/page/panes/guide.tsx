// The guide's card: the next step in one sentence, and the progress.
import { goOn, leave, progress, step } from "../plan/guide";
import { Tool } from "../screen/bar";
import { hello } from "../server/session";
import { makeExample } from "./files";
import { words } from "../words";

/** Number of examples on the last card. */
const EXAMPLES = 3;

export function Guide() {
  const now = step.value;
  if (!now) return null;
  const [done, all] = progress(now);
  const examples = hello.value?.examples.slice(0, EXAMPLES) ?? [];
  const open = (name: string): void => {
    leave();
    void makeExample(name);
  };
  const { title, body } = words.guideSteps[now];
  return (
    <section class="guide-card" aria-label={words.guide}>
      <header>
        <progress value={done} max={all} aria-label={words.guideProgress(done, all)} />
        <Tool icon="close" label={words.close(words.guide)} run={leave} />
      </header>
      <div role="status">
        <h2>{title}</h2>
        <p>{body}</p>
      </div>
      {now === "done" && <div class="choices"><button class="main" onClick={goOn}>{words.nextChapter}</button></div>}
      {now === "end" && <div class="choices">{examples.map(({ name, title }) => <button title={title} onClick={() => open(name)} key={name}>{words.exampleOf(name)}</button>)}</div>}
    </section>
  );
}
