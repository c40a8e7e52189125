// The guide's card: the next step in one sentence, and the progress.
import { leave, progress, step } from "../plan/guide";
import { Tool } from "../screen/bar";
import { words } from "../words";

export function Guide() {
  const now = step.value;
  if (!now) return null;
  const [done, all] = progress(now);
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
    </section>
  );
}
