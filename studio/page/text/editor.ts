// The editor of one text: CodeMirror without its own history, synchronised with `documents.ts`.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, indentWithTab } from "@codemirror/commands";
import { bracketMatching, indentOnInput, indentService, indentUnit } from "@codemirror/language";
import { setDiagnostics, type Diagnostic as Shown } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { Annotation, Compartment, EditorSelection, EditorState, StateEffect, StateField, Text, type Extension } from "@codemirror/state";
import { Decoration, EditorView, drawSelection, highlightActiveLine, highlightSpecialChars, hoverTooltip, keymap, lineNumbers, type DecorationSet } from "@codemirror/view";
import { effect, untracked } from "@preact/signals";
import { sequence } from "../documents/changes";
import { onText, text, typed, version } from "../documents/documents";
import type { Change } from "../documents/history";
import { tooLong } from "../documents/limit";
import { trouble } from "../panes/files";
import { cursorAt, shown } from "../plan/places";
import { offset, position } from "../documents/positions";
import { diagnostics, fixes, mend, said, severityOf, type Diagnostic } from "../plan/problems";
import { pen } from "../server/session";
import { words } from "../words";
import { Late, type Then } from "./late";
import { marks } from "./marks";
import * as seek from "./seek";
import { completion, hover } from "./sources";
import { follow, stops } from "./stops";
import { theme } from "./theme";

/** Marks changes from `documents.ts`, which does not receive them again. */
const fromPage = Annotation.define<boolean>();
const highlight = StateEffect.define<{ from: number; to: number } | null>();

/** Rejects user input that would make the text too long, with a message. */
const short = EditorState.transactionFilter.of((each) => {
  const why = each.docChanged && !each.annotation(fromPage) ? tooLong(each.startState.doc.length, each.newDoc) : null;
  if (why === null) return each;
  trouble.value = why;
  return [];
});

/** The place of the drawing's selection. */
const highlighted = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update: (before, transaction) => {
    const set = transaction.effects.find((each) => each.is(highlight));
    if (!set) return before.map(transaction.changes);
    const place = set.value as { from: number; to: number } | null;
    return place && place.to > place.from ? Decoration.set([Decoration.mark({ class: "cm-shown" }).range(place.from, place.to)]) : Decoration.none;
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** Indents lines inside braces by four columns. */
const indentation = indentService.of((context, at) => {
  const line = context.state.doc.lineAt(at);
  let [number, before] = [line.number - 1, ""];
  while (number > 0 && before.trim() === "") before = context.state.doc.line(number--).text;
  const own = /^\s*/.exec(before)![0].length + (/[{(]\s*$/.test(before) ? 4 : 0);
  return /^\s*[})]/.test(line.text.slice(at - line.from)) || /^\s*[})]/.test(line.text) ? Math.max(0, own - 4) : own;
});

const language = EditorState.languageData.of(() => [
  { commentTokens: { line: "//" }, closeBrackets: { brackets: ["(", "{"] }, indentOnInput: /^\s*[})]$/ },
]);

const behaviour: Extension = [
  EditorState.tabSize.of(4),
  indentUnit.of("    "),
  indentation,
  language,
  lineNumbers(),
  highlightSpecialChars(),
  highlightActiveLine(),
  highlightSelectionMatches(),
  drawSelection(),
  EditorView.lineWrapping,
  bracketMatching(),
  closeBrackets(),
  indentOnInput(),
  short,
  search({ top: true }),
  highlighted,
  seek.seeking,
  theme,
  keymap.of([...closeBracketsKeymap, ...completionKeymap, ...searchKeymap, ...defaultKeymap, indentWithTab]),
  EditorView.contentAttributes.of({ "aria-label": words.text, tabindex: "0", spellcheck: "false" }),
];

function problem(then: Then, one: Diagnostic): Shown {
  const { message, help } = said(one);
  const renderMessage = (): HTMLElement => {
    const made = document.createElement("span");
    const code = document.createElement("code");
    code.textContent = one.code ?? "";
    made.append(message, " ", code);
    if (help) made.append(document.createElement("br"), help);
    return made;
  };
  const actions = (fixes.value.get(one) ?? []).map((fix) => ({ name: fix.title, apply: () => void mend(fix) }));
  const severity = { error: "error", warning: "warning", note: "info" } as const;
  const [from, to] = [one.range.start, one.range.end].map((place) => then.now(offset(then.text, place)));
  return { from: from!, to: Math.max(from!, to!), severity: severity[severityOf(one)], message, renderMessage, actions };
}

/** Creates an editor inside `host`; returns its view and a function that ends it. */
export function edit(host: HTMLElement, uri: string, nonce: string): { view: EditorView; end: () => void } {
  const writable = new Compartment();
  const ability = () => [EditorState.readOnly.of(!pen.value)];
  let collected: Change[] | null = null;
  const take = (changes: Change[]): void => (collected ? void collected.push(...changes) : typed(changes));
  const together = (run: () => void): void => {
    collected = [];
    run();
    const all = collected;
    collected = null;
    typed(all);
  };
  const heard = EditorView.updateListener.of((update) => {
    for (const each of update.transactions) if (each.docChanged && !each.annotation(fromPage)) take(sequence(uri, each.changes));
    if (update.docChanged) late.note(version(uri), update.state.doc, update.changes);
    const moved = update.transactions.some((each) => each.isUserEvent("select") || each.isUserEvent("input") || each.isUserEvent("delete"));
    if (moved) cursorAt(uri, position(update.state.doc.toString(), update.state.selection.main.head));
  });
  const extensions = [
    EditorView.cspNonce.of(nonce),
    writable.of(ability()),
    stops(uri),
    behaviour,
    autocompletion({ override: [completion(uri, together)], icons: false }),
    hoverTooltip(hover(uri), { hoverTime: 350 }),
    marks(uri),
    heard,
  ];
  const late = new Late(version(uri), Text.of(text(uri).split("\n")));
  const view = new EditorView({ parent: host, state: EditorState.create({ doc: text(uri), extensions }) });
  const ends = [
    follow(view, uri),
    seek.follow(view),
    onText((changed, changes, maker) => {
      if (changed !== uri || maker === "text") return;
      view.dispatch(...changes.map(({ from, to, insert }) => ({ changes: { from, to, insert }, sequential: true, annotations: fromPage.of(true) })));
    }),
    effect(() => view.dispatch({ effects: writable.reconfigure(ability()) })),
    effect(() => {
      const said = diagnostics.value.get(uri);
      const then = said && late.at(said.version);
      if (then) view.dispatch(setDiagnostics(view.state, said.list.map((each) => problem(then, each))));
    }),
    effect(() => {
      const place = shown.value;
      if (place?.uri !== uri) return;
      // Once per place: later typing keeps the cursor.
      const now = untracked(() => text(uri));
      show(view, offset(now, place.range.start), offset(now, place.range.end), place.stays);
      if (place.focus) view.focus();
    }),
  ];
  const end = (): void => {
    ends.forEach((each) => each());
    view.destroy();
  };
  return { view, end };
}

/** Moves the cursor to a place, unless `stays`, and marks it; scrolls only if it is out of view. */
function show(view: EditorView, from: number, to: number, stays = false): void {
  const length = view.state.doc.length;
  const place = { from: Math.min(from, length), to: Math.min(to, length) };
  const { viewport } = view;
  const scroll = place.from < viewport.from || place.from > viewport.to || !isSeen(view, place.from);
  const effects = [highlight.of(place), ...(scroll ? [EditorView.scrollIntoView(place.from, { y: "center" })] : [])];
  view.dispatch({ ...(stays ? {} : { selection: EditorSelection.cursor(place.from) }), effects });
}

function isSeen(view: EditorView, at: number): boolean {
  const [place, pane] = [view.coordsAtPos(at), view.scrollDOM.getBoundingClientRect()];
  return place !== null && place.top >= pane.top && place.bottom <= pane.bottom;
}
