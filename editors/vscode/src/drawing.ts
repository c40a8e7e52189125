// The drawing of a document: requests it from the language server, passes on changes, and
// synchronizes selection and cursor. It depends on neither the editor nor the page, so its tests need only the real server.
import type { Answer, Changed, Part } from "../../../studio/page/drawing/shapes";
import type { Position, Range } from "../../../studio/page/documents/positions";

export interface Server {
  request<T>(method: string, params: object): Promise<T>;
}

/**
 * The state of a run: paths of active components, in the plan of that name or else in the first one
 * of the file.
 */
export interface Run {
  plan: string | null;
  stack: readonly string[];
  held: boolean;
  /** Whether its text differs from the drawn one. */
  older: boolean;
}

/** To the page. */
export type ToPage =
  | { kind: "drawing"; uri: string; answer: Answer }
  | { kind: "changed"; change: Changed }
  | { kind: "select"; part: Part | null }
  | ({ kind: "run" } & Run)
  | { kind: "nothing"; why: string };

/** From the page. */
export type FromPage = { kind: "ready" } | { kind: "select"; part: Part } | { kind: "open"; part: Part } | { kind: "plan"; name: string };

export interface Around {
  server: Server;
  post(message: ToPage): void;
  /** Shows a place of the text; with `focus`, the text gets the keyboard focus. */
  reveal(range: Range, focus: boolean): void;
}

export class Drawing {
  private plan: string | null;
  /** The plan that the page shows. */
  private told: string | null = null;
  private ready = false;
  /** The last part selected here; the cursor's move to it is ignored. */
  private own: string | null = null;

  constructor(
    readonly uri: string,
    plan: string | null,
    private readonly around: Around,
  ) {
    this.plan = plan;
  }

  /** Shows another plan of the document. */
  async show(plan: string): Promise<void> {
    this.plan = plan;
    await this.ask();
  }

  /** Requests the whole drawing: at first, and after a restart of the server. */
  async ask(): Promise<void> {
    if (!this.ready) return;
    const { server, post } = this.around;
    const wanted = this.plan;
    const params = { textDocument: { uri: this.uri }, ...(wanted ? { plan: wanted } : {}), subscribe: true };
    const message = await server.request<Answer>("afp/drawing", params).then(
      (answer): ToPage => ({ kind: "drawing", uri: this.uri, answer }),
      (why: Error): ToPage => ({ kind: "nothing", why: why.message }),
    );
    if (this.plan !== wanted) return;
    if (message.kind === "drawing") this.told = message.answer.plan;
    post(message);
  }

  /** Handles `afp/drawingChanged` of any document. */
  changed(change: Changed): void {
    if (change.textDocument.uri !== this.uri || !this.ready) return;
    // The plan was renamed or removed, and the first one is drawn.
    if (this.plan !== null && this.plan === this.told) this.plan = change.plan;
    this.told = change.plan;
    this.around.post({ kind: "changed", change });
  }

  /** Shows the state of a run of this document. */
  run(run: Run): void {
    this.around.post({ kind: "run", ...run });
  }

  /** Handles a move of the text cursor. */
  async cursor(position: Position): Promise<void> {
    const part = await this.around.server.request<Part | null>("afp/itemAt", { textDocument: { uri: this.uri }, position }).catch(() => null);
    const [key, before] = [JSON.stringify(part), this.own];
    this.own = null;
    if (key !== before) this.around.post({ kind: "select", part });
  }

  async receive(message: FromPage): Promise<void> {
    if (message.kind === "ready") {
      this.ready = true;
      return this.ask();
    }
    if (message.kind === "plan") return this.show(message.name);
    const { item, part } = message.part;
    const range = await this.around.server.request<Range | null>("afp/spanOf", { textDocument: { uri: this.uri }, item, ...(part ? { part } : {}) });
    if (!range) return;
    this.own = JSON.stringify(await this.around.server.request("afp/itemAt", { textDocument: { uri: this.uri }, position: range.start }));
    this.around.reveal(range, message.kind === "open");
  }

  /** Ends the notifications of the server. */
  async end(): Promise<void> {
    await this.around.server.request("afp/drawing", { textDocument: { uri: this.uri }, subscribe: false }).catch(() => null);
  }
}
