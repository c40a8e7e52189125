// Markdown of the engine's help as nodes: paragraphs, lists, code blocks, and inline `code`,
// **strong**, *emphasis*. Everything is inserted as text, so third-party texts never become markup.
// Addresses are not links.

export type Inline = { kind: "text" | "code" | "strong" | "em"; text: string };
export type Block =
  | { kind: "paragraph"; inlines: Inline[] }
  | { kind: "heading"; inlines: Inline[] }
  | { kind: "list"; items: Inline[][] }
  | { kind: "code"; text: string };

const ITEM = /^\s*(?:[-*+]|\d+\.)\s+(.*)$/;

/** The blocks of a text. */
export function blocks(source: string): Block[] {
  const found: Block[] = [];
  const lines = source.replaceAll("\r\n", "\n").split("\n");
  for (let at = 0; at < lines.length; ) {
    const line = lines[at]!;
    if (line.trim() === "") at++;
    else if (line.startsWith("```")) {
      const end = lines.findIndex((each, other) => other > at && each.startsWith("```"));
      const last = end < 0 ? lines.length : end;
      found.push({ kind: "code", text: lines.slice(at + 1, last).join("\n") });
      at = last + 1;
    } else if (/^#{1,6} /.test(line)) {
      found.push({ kind: "heading", inlines: inlines(line.replace(/^#+ /, "")) });
      at++;
    } else {
      const list = ITEM.test(line);
      const start = at++;
      while (at < lines.length && lines[at]!.trim() !== "" && !lines[at]!.startsWith("```") && (list || !ITEM.test(lines[at]!))) at++;
      const own = lines.slice(start, at);
      found.push(list ? { kind: "list", items: items(own).map(inlines) } : { kind: "paragraph", inlines: inlines(own.join("\n")) });
    }
  }
  return found;
}

/** The items of a list; a line without a bullet continues the item. */
function items(lines: string[]): string[] {
  const found: string[] = [];
  for (const line of lines) {
    const begun = ITEM.exec(line);
    if (begun) found.push(begun[1]!);
    else found.push(`${found.pop() ?? ""} ${line.trim()}`);
  }
  return found;
}

const INLINE = /(`+)([\s\S]+?)\1(?!`)|\*\*([\s\S]+?)\*\*|\*([^\s*][^*]*)\*|\[([^\]]+)\]\([^)]*\)/g;

function inlines(source: string): Inline[] {
  const found: Inline[] = [];
  let last = 0;
  for (const match of source.matchAll(INLINE)) {
    if (match.index > last) found.push({ kind: "text", text: source.slice(last, match.index) });
    const [, , code, strong, em, link] = match;
    if (code !== undefined) found.push({ kind: "code", text: code });
    else if (strong !== undefined) found.push({ kind: "strong", text: strong });
    else if (em !== undefined) found.push({ kind: "em", text: em });
    else found.push({ kind: "text", text: link! });
    last = match.index + match[0].length;
  }
  if (last < source.length) found.push({ kind: "text", text: source.slice(last) });
  return found;
}

function element(name: string, children: (Node | string)[]): HTMLElement {
  const made = document.createElement(name);
  made.append(...children);
  return made;
}

const shown = (all: Inline[]): (Node | string)[] => all.map(({ kind, text }) => (kind === "text" ? text : element(kind, [text])));

/** The nodes of a text, for a tooltip or a pane. */
export function nodes(source: string): HTMLElement {
  const made = blocks(source).map((block) => {
    if (block.kind === "code") return element("pre", [element("code", [block.text])]);
    if (block.kind === "list") return element("ul", block.items.map((item) => element("li", shown(item))));
    return element(block.kind === "heading" ? "h3" : "p", shown(block.inlines));
  });
  const whole = element("div", made);
  whole.className = "markdown";
  return whole;
}
