// Modal dialogs: choices, and one line of input.
import { signal } from "@preact/signals";
import { useModal } from "./modal";
import { words } from "../words";

interface Question {
  title: string;
  body: string;
  choices: string[];
  /** A line of input: its initial value, and its check. */
  line?: { value: string; wrong(value: string): string | null };
  answer(chosen: string | null): void;
}

const asked = signal<readonly Question[]>([]);
const value = signal("");

const put = (question: Omit<Question, "answer">): Promise<string | null> =>
  new Promise((resolve) => {
    const one: Question = {
      ...question,
      answer: (chosen) => {
        asked.value = asked.value.filter((each) => each !== one);
        resolve(chosen);
      },
    };
    value.value = question.line?.value ?? "";
    asked.value = [...asked.value, one];
  });

/** Asks for a choice; null if cancelled. */
export const ask = (title: string, body: string, choices: string[]): Promise<string | null> => put({ title, body, choices });

/** Asks for a line; null if cancelled. */
export const askLine = (title: string, body: string, first: string, done: string, wrong: (value: string) => string | null = () => null) =>
  put({ title, body, choices: [done], line: { value: first, wrong } });

export function Dialogs() {
  const question = asked.value[0];
  return question ? <Shown question={question} key={question.title} /> : null;
}

function Shown({ question }: { question: Question }) {
  const dialog = useModal((open) => open.querySelector("input")?.select());
  const { line } = question;
  const wrong = line?.wrong(value.value) ?? null;
  const answer = (choice: string): void => {
    if (!wrong) question.answer(line ? value.value : choice);
  };
  const submit = (event: Event): void => {
    event.preventDefault();
    answer(question.choices[0]!);
  };
  return (
    <dialog ref={dialog} aria-labelledby="question" onCancel={() => question.answer(null)}>
      <form onSubmit={submit}>
        <h2 id="question">{question.title}</h2>
        <p>{question.body}</p>
        {line && (
          <p>
            <input aria-labelledby="question" aria-invalid={wrong !== null} aria-describedby="wrong" value={value.value} onInput={(event) => (value.value = event.currentTarget.value)} spellcheck={false} />
            <span id="wrong" class="wrong" role="status">{wrong}</span>
          </p>
        )}
        <div class="choices">
          <button type="button" onClick={() => question.answer(null)}>{words.cancel}</button>
          {question.choices.map((choice, at) => (
            <button type="button" class={at === question.choices.length - 1 ? "main" : ""} disabled={wrong !== null} onClick={() => answer(choice)} key={choice}>{choice}</button>
          ))}
        </div>
      </form>
    </dialog>
  );
}
