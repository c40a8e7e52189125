// The book in the page: the explanation of a problem's code, with a wrong and a right example, and
// template references.
import { signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { current } from "../documents/documents";
import * as ask from "../drawing/ask";
import { nodes } from "./markdown";
import { useModal } from "./modal";
import { report } from "../panes/files";
import { lsp } from "../server/session";
import { words } from "../words";

/** The open page. */
const page = signal<{ title: string; text: string } | null>(null);

/** Opens the page of a code. */
async function explain(code: string): Promise<void> {
  try {
    const { text } = await lsp().request<{ text: string }>("afp/explain", { code });
    page.value = { title: words.meaning(code), text };
  } catch (why) {
    report(why);
  }
}

/** Opens the reference of an element's or supervisor's template: ports, states and bounds. */
async function explainTemplate(item: string, template: string): Promise<void> {
  const uri = current.peek();
  try {
    const position = (await ask.parts(item))?.templateAt;
    if (!position) return;
    type Answer = { contents: { value: string } };
    const found = await lsp().request<Answer | null>("textDocument/hover", { textDocument: { uri }, position });
    if (found) page.value = { title: words.about(template), text: found.contents.value };
  } catch (why) {
    report(why);
  }
}

/** The code of a problem, as a link to its page. */
export const Code = ({ of: code }: { of: string }) => (
  <button type="button" class="code" aria-label={words.meaning(code)} title={words.meaning(code)} onClick={() => void explain(code)}>{code}</button>
);

/** A link to the page of an item's template. */
export const AllAbout = ({ item, template }: { item: string; template: string }) => (
  <button type="button" class="quiet" onClick={() => void explainTemplate(item, template)}>{words.about(template)}</button>
);

export function Book() {
  return page.value && <Page of={page.value} key={page.value.title} />;
}

function Page({ of: { title, text } }: { of: { title: string; text: string } }) {
  const body = useRef<HTMLDivElement>(null);
  const close = (): void => void (page.value = null);
  const dialog = useModal(() => body.current!.replaceChildren(nodes(text)));
  return (
    <dialog class="book" ref={dialog} aria-label={title} onCancel={close}>
      <div class="book-page" ref={body} tabIndex={0} />
      <div class="choices">
        <button class="main" onClick={close}>{words.closePage}</button>
      </div>
    </dialog>
  );
}
