// Files of the folder: open, create, copy examples; and the welcome page of a folder without plans.
import { effect, signal } from "@preact/signals";
import { uriOf } from "../documents/addresses";
import { create, current, isOpen, nameOf, open } from "../documents/documents";
import { download, duplicate, putBack, remove, rename } from "../documents/files";
import { askLine } from "../screen/dialogs";
import { showLog } from "../debug/logs";
import { askRobot } from "../debug/robot";
import { guide } from "../plan/guide";
import { Sign } from "../screen/icons";
import { run } from "../jobs/jobs";
import { files, hello, more, pen } from "../server/session";
import { planText, words } from "../words";

/** The last error message, shown until closed. */
export const trouble = signal<string | null>(null);
export const report = (why: unknown): void => {
  console.error(why);
  trouble.value = why instanceof Error ? why.message : String(why);
};

const plans = () => files.value.filter(({ name }) => name.endsWith(".afp"));
const logs = () => files.value.filter(({ name }) => name.endsWith(".mcap"));
const KEY = "afp-studio-open";

export async function show(uri: string): Promise<void> {
  try {
    if (!isOpen(uri)) await open(uri);
    current.value = uri;
    sessionStorage.setItem(KEY, uri);
  } catch (why) {
    report(why);
  }
}

/**
 * Opens the file of the address, else the last open file, else the server's, else the first plan.
 */
export async function showFirst(): Promise<void> {
  const known = (uri: string | null): string | null => plans().find((file) => file.uri === uri)?.uri ?? null;
  const first = known(location.hash.slice(1)) ?? known(sessionStorage.getItem(KEY)) ?? hello.value?.open ?? plans()[0]?.uri;
  // The address counts once: a reload shows the open file.
  if (location.hash) history.replaceState(null, "", location.pathname);
  if (first) await show(first);
}

const isTaken = (name: string): boolean => files.value.some((file) => file.name === name);
const free = (name: string, ending: string): string => {
  let [own, number] = [name + ending, 1];
  while (isTaken(own)) own = `${name}_${++number}${ending}`;
  return own;
};
const planName = (name: string): string => name.replace(/(^|_)([a-z0-9])/g, (_, __, letter: string) => letter.toUpperCase());

async function make(name: string, what: { text: string } | { example: string }, made: (uri: string) => void = () => {}): Promise<void> {
  try {
    const uri = uriOf(name);
    await create({ uri, ...what });
    made(uri);
    await show(uri);
  } catch (why) {
    report(why);
  }
}

export const makeFirst = (): Promise<void> => make(free("plan", ".afp"), { text: planText("Plan") }, guide);
/** In a folder of plans, because a plan's world is in a folder next to it. */
export const makeExample = (name: string): Promise<void> => make(free(`plans/${name.replace(/\.afp$/, "")}`, ".afp"), { example: name });

export async function makeNew(): Promise<void> {
  const wrong = (name: string) =>
    !/^[A-Za-z][A-Za-z0-9_]*$/.test(name) ? words.nameWrong : isTaken(`${name}.afp`) ? words.nameTaken(`${name}.afp`) : null;
  const name = await askLine(words.newPlanName, words.newPlanHint, free("plan", ".afp").replace(/\.afp$/, ""), words.create, wrong);
  if (name) await make(`${name}.afp`, { text: planText(planName(name)) });
}

/** Creates a project in its own folder, like `afpc new`, and shows its plan. */
export async function makeProject(): Promise<void> {
  const wrong = (name: string) => (!/^[a-z][a-z0-9_]*$/.test(name) ? words.projectWrong : files.value.some((file) => file.name.startsWith(`${name}/`)) ? words.nameTaken(name) : null);
  const name = await askLine(words.newProjectName, words.newProjectHint, "patrol", words.create, wrong);
  if (!name) return;
  try {
    const done = await run(words.newProject, { kind: "new", name });
    if (!done?.ok) throw new Error(done?.said || words.jobFailed);
    const made = await appears((file) => file.name.startsWith(`${name}/`) && file.name.endsWith(".afp") && !/\/(tests|scenarios)\//.test(file.name));
    await show(made);
  } catch (why) {
    report(why);
  }
}

/** The file's name without extension, as the default answer. */
const shown = (): string => nameOf(current.peek()).replace(/\.afp$/, "");
const wrongFile = (name: string): string | null =>
  !/^([\w-]+\/)*[A-Za-z][\w-]*$/.test(name) ? words.nameWrong : isTaken(`${name}.afp`) ? words.nameTaken(`${name}.afp`) : null;

async function renameFile(): Promise<void> {
  const name = await askLine(words.renameFile, words.renameFileHint, shown(), words.renameFileDone, (name) => (name === shown() ? words.nameSame : wrongFile(name)));
  if (name) await rename(current.peek(), `${name}.afp`).then(show, report);
}

const duplicateFile = (): Promise<void> => duplicate(current.peek(), free(shown(), ".afp")).then(show, report);

async function removeFile(): Promise<void> {
  const uri = current.peek();
  try {
    await remove(uri);
    const next = plans().find((file) => file.uri !== uri)?.uri;
    if (next) await show(next);
    else current.value = "";
  } catch (why) {
    report(why);
  }
}

/** Restores the last removed file and shows it. */
export const putFileBack = (): Promise<void> => putBack().then((uri) => (uri ? show(uri) : undefined), report);

/** Waits until the folder has a file; returns its address. */
const appears = (wanted: (file: { uri: string; name: string }) => boolean): Promise<string> =>
  new Promise((done) => {
    const ends = effect(() => {
      const found = files.value.find(wanted);
      if (!found) return;
      queueMicrotask(() => ends());
      done(found.uri);
    });
  });

/** The file menu. */
export function Files({ done }: { done: () => void }) {
  const pick = (run: () => unknown) => () => {
    done();
    run();
  };
  return (
    <div class="menu" role="menu" aria-label={words.menu}>
      {plans().length > 0 && <p class="group" role="presentation">{words.files}</p>}
      {plans().map(({ uri, name }) => (
        <button role="menuitemradio" aria-checked={uri === current.value} onClick={pick(() => show(uri))} key={uri}>
          <Sign name={uri === current.value ? "check" : "file"} />
          {name}
        </button>
      ))}
      {more.value && <p class="group" role="presentation">{words.moreFiles}</p>}
      <hr role="presentation" />
      {current.value && pen.value && (
        <>
          <button role="menuitem" onClick={pick(renameFile)}>{words.renameFile}</button>
          <button role="menuitem" onClick={pick(duplicateFile)}>{words.duplicateFile}</button>
          <button role="menuitem" onClick={pick(removeFile)}>{words.removeFile}</button>
        </>
      )}
      {current.value && <button role="menuitem" onClick={pick(() => download(current.peek()))}>{words.downloadFile}</button>}
      {current.value && <hr role="presentation" />}
      <button role="menuitem" onClick={pick(makeNew)}>
        <Sign name="plus" />
        {words.newPlan}
      </button>
      <button role="menuitem" onClick={pick(makeProject)}>
        <Sign name="plus" />
        {words.newProject}
      </button>
      <button role="menuitem" onClick={pick(askRobot)}>
        <Sign name="run" />
        {words.attach}
      </button>
      {logs().length > 0 && <p class="group" role="presentation">{words.logs}</p>}
      {logs().map(({ uri, name }) => (
        <button role="menuitem" onClick={pick(() => showLog(uri))} key={uri}>
          <Sign name="timeline" />
          {name}
        </button>
      ))}
      <p class="group" role="presentation">{words.examples}</p>
      {hello.value?.examples.map(({ name, title }) => (
        <button role="menuitem" title={title} onClick={pick(() => makeExample(name))} key={name}>
          <Sign name="drawing" />
          {words.exampleOf(name)}
        </button>
      ))}
    </div>
  );
}

/** Shown instead of the drawing if the folder has no plan. */
export function Welcome() {
  const folder = decodeURIComponent(hello.value?.root.replace(/\/$/, "").split("/").at(-1) ?? "");
  const examples = hello.value?.examples ?? [];
  return (
    <div class="welcome">
      <h1>{words.welcome(folder)}</h1>
      <p>{words.welcomeBody}</p>
      <div class="cards">
        <button class="card main" onClick={makeFirst}>
          <strong>{words.firstPlan}</strong>
          <span>{words.firstPlanBody}</span>
        </button>
        <button class="card" onClick={makeNew}>
          <strong>{words.emptyPlan}</strong>
          <span>{words.emptyPlanBody}</span>
        </button>
      </div>
      {examples.length > 0 && <h2>{words.examples}</h2>}
      {examples.length > 0 && <p>{words.examplesBody}</p>}
      <div class="cards">
        {examples.map(({ name, title }) => (
          <button class="card" onClick={() => makeExample(name)} key={name}>
            <strong>{words.exampleOf(name)}</strong>
            <span>{title}</span>
          </button>
        ))}
      </div>
    </div>
  );
}
