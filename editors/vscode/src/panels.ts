// The open drawings, each in a panel beside its text.
import * as vscode from "vscode";
import { randomBytes } from "node:crypto";
import type { Changed } from "../../../studio/page/drawing/shapes";
import { differs } from "../../../studio/page/documents/hash";
import type { Range } from "../../../studio/page/documents/positions";
import { Drawing, type Server } from "./drawing";
import { programOf } from "./launch";
import { page } from "./page";

interface Client {
  sendRequest<T>(method: string, params: object): Promise<T>;
}

interface Open {
  panel: vscode.WebviewPanel;
  drawing: Drawing;
  uri: vscode.Uri;
}

/** The used part of `afp/state`. */
interface Running {
  stack: string[];
  held: boolean;
  /** The hashes of the running texts, by path. */
  sources: Record<string, string>;
}

/** The delay between a move of the cursor and of the drawing, in milliseconds. */
const RESTS = 80;

export class Panels implements vscode.Disposable {
  private readonly open_ = new Map<string, Open>();
  private readonly server: Server;
  private readonly ends: vscode.Disposable[];
  private resting: ReturnType<typeof setTimeout> | undefined;
  /** The last state of each run, by program. */
  private readonly running = new Map<string, Running>();

  constructor(
    private readonly home: vscode.Uri,
    client: Client,
  ) {
    this.server = { request: (method, params) => client.sendRequest(method, params) };
    this.ends = [
      vscode.window.onDidChangeTextEditorSelection((event) => this.moved(event)),
      vscode.workspace.onDidChangeTextDocument(() => this.running.forEach((state, program) => this.show(program, state))),
    ];
  }

  /** Shows the drawing of a plan beside its text. */
  async open(uri: vscode.Uri, plan: string | null): Promise<void> {
    const key = uri.toString();
    const known = this.open_.get(key);
    if (known) {
      known.panel.reveal(undefined, true);
      if (plan) await known.drawing.show(plan);
      return;
    }
    const colours = await this.colours(key);
    const media = vscode.Uri.joinPath(this.home, "dist");
    const where = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
    const panel = vscode.window.createWebviewPanel("afp.drawing", `Drawing of ${uri.path.split("/").pop()}`, where, {
      enableScripts: true,
      retainContextWhenHidden: true,
      localResourceRoots: [media],
    });
    const { webview } = panel;
    const reveal = (range: Range, focus: boolean): void => void this.reveal(uri, range, focus);
    const drawing = new Drawing(key, plan, { server: this.server, post: (message) => void webview.postMessage(message), reveal });
    this.open_.set(key, { panel, drawing, uri });
    webview.onDidReceiveMessage((message) => drawing.receive(message));
    panel.onDidDispose(() => {
      this.open_.delete(key);
      void drawing.end();
    });
    const script = webview.asWebviewUri(vscode.Uri.joinPath(media, "drawing.js")).toString();
    webview.html = page({ script, origin: webview.cspSource, colours, nonce: randomBytes(16).toString("hex") });
  }

  /** The engine's colours, for light and dark themes. */
  private async colours(uri: string): Promise<{ light: string; dark: string }> {
    const sheet = async (theme: string): Promise<string> =>
      (await this.server.request<{ text: string }>("afp/export", { textDocument: { uri }, format: "css", theme })).text;
    const [light, dark] = await Promise.all([sheet("light"), sheet("dark")]);
    return { light, dark };
  }

  private async reveal(uri: vscode.Uri, { start, end }: Range, focus: boolean): Promise<void> {
    const shown = vscode.window.visibleTextEditors.find(({ document }) => document.uri.toString() === uri.toString());
    const selection = new vscode.Range(start.line, start.character, end.line, end.character);
    const viewColumn = shown?.viewColumn ?? vscode.ViewColumn.One;
    await vscode.window.showTextDocument(uri, { selection, viewColumn, preserveFocus: !focus });
  }

  private moved({ textEditor, selections }: vscode.TextEditorSelectionChangeEvent): void {
    const known = this.open_.get(textEditor.document.uri.toString());
    const at = selections[0]?.active;
    if (!known || !at) return;
    clearTimeout(this.resting);
    this.resting = setTimeout(() => void known.drawing.cursor({ line: at.line, character: at.character }), RESTS);
  }

  changed(change: Changed): void {
    for (const { drawing } of this.open_.values()) drawing.changed(change);
  }

  /** Requests everything again, after a change of the server. */
  again(): void {
    for (const { drawing } of this.open_.values()) void drawing.ask();
  }

  /** Shows the state of a program's run; `null` at its end. */
  run(program: string | undefined, state: Running | null): void {
    if (!program) return;
    if (state) this.running.set(program, state);
    else this.running.delete(program);
    this.show(program, state);
  }

  private show(program: string, state: Running | null): void {
    const { file, plan } = programOf(program);
    const sources = state?.sources ?? {};
    const older = vscode.workspace.textDocuments.some((each) => differs(sources, each.uri.fsPath, each.getText()));
    for (const { drawing, uri } of this.open_.values()) {
      if (uri.fsPath === file) drawing.run({ plan, stack: state?.stack ?? [], held: state?.held ?? false, older });
    }
  }

  dispose(): void {
    clearTimeout(this.resting);
    for (const { panel } of this.open_.values()) panel.dispose();
    this.ends.forEach((end) => end.dispose());
  }
}
