// A stub of the part of Visual Studio Code's interface that the extension uses; it records calls.
import { fileURLToPath, pathToFileURL } from "node:url";

export class Uri {
  constructor(private readonly href: string) {}
  static parse = (href: string): Uri => new Uri(href);
  static file = (path: string): Uri => new Uri(pathToFileURL(path).href);
  static joinPath = (base: Uri, ...more: string[]): Uri => new Uri([base.href.replace(/\/$/, ""), ...more].join("/"));
  get scheme(): string {
    return new URL(this.href).protocol.slice(0, -1);
  }
  get path(): string {
    return decodeURIComponent(new URL(this.href).pathname);
  }
  get fsPath(): string {
    return fileURLToPath(this.href);
  }
  toString(): string {
    return this.href;
  }
}

export class Range {
  readonly start: { line: number; character: number };
  readonly end: { line: number; character: number };
  constructor(...[line, character, endLine, endCharacter]: [number, number, number, number]) {
    [this.start, this.end] = [{ line, character }, { line: endLine, character: endCharacter }];
  }
}

export class ProcessExecution {
  constructor(
    readonly process: string,
    readonly args: string[],
    readonly options: object,
  ) {}
}

export class Task {
  constructor(
    readonly definition: object,
    readonly scope: unknown,
    readonly name: string,
    readonly source: string,
    readonly execution: ProcessExecution,
  ) {}
}

export class DebugAdapterExecutable {
  constructor(
    readonly command: string,
    readonly args: string[],
    readonly options: object,
  ) {}
}

export class DebugAdapterServer {
  constructor(readonly port: number) {}
}

export const DiagnosticSeverity = { Error: 0, Warning: 1 };
export const ViewColumn = { Beside: -2, One: 1 };
export const TaskScope = { Workspace: 2 };

type Listener = (event: any) => unknown;

/** An event, and a function to fire it. */
function event(): { on: (take: Listener) => { dispose(): void }; fire: (event: unknown) => unknown[] } {
  const all: Listener[] = [];
  return { on: (take) => (all.push(take), { dispose: () => void all.splice(all.indexOf(take), 1) }), fire: (event) => all.map((take) => take(event)) };
}

/** A panel that the extension created. */
export interface Panel {
  title: string;
  options: { enableScripts: boolean; localResourceRoots: Uri[] };
  html: string;
  posted: { kind: string }[];
  receive: (message: unknown) => unknown[];
  close: () => void;
}

const events = { selection: event(), text: event(), started: event(), custom: event(), ended: event() };

/** Recorded events, and answers that a test sets. */
export const seen = {
  commands: new Map<string, (...args: any[]) => any>(),
  providers: new Map<string, any>(),
  factories: new Map<string, any>(),
  warnings: [] as string[],
  errors: [] as string[],
  tasks: [] as Task[],
  launched: [] as Record<string, unknown>[],
  shown: [] as { uri: Uri; options: { selection: Range; preserveFocus?: boolean } }[],
  panels: [] as Panel[],
  written: new Map<string, string>(),
  documents: [] as { uri: Uri; getText(): string }[],
  diagnostics: [] as { severity: number; message: string; range: Range }[],
  command: "afpc",
  trusted: true,
  pick: undefined as string | undefined,
  save: undefined as Uri | undefined,
  events,
};

export const window = {
  activeTextEditor: undefined as { document: { uri: Uri; languageId: string } } | undefined,
  visibleTextEditors: [] as never[],
  showWarningMessage: async (text: string) => void seen.warnings.push(text),
  showErrorMessage: async (text: string) => void seen.errors.push(text),
  showQuickPick: async () => seen.pick,
  showSaveDialog: async () => seen.save,
  showTextDocument: async (uri: Uri, options: { selection: Range }) => void seen.shown.push({ uri, options }),
  onDidChangeTextEditorSelection: events.selection.on,
  createWebviewPanel: (_: string, title: string, __: object, options: Panel["options"]) => {
    const [messages, disposed] = [event(), event()];
    const panel: Panel = { title, options, html: "", posted: [], receive: messages.fire, close: () => disposed.fire(null) };
    seen.panels.push(panel);
    return {
      reveal: () => {},
      dispose: panel.close,
      onDidDispose: disposed.on,
      webview: {
        cspSource: "https://webview.test",
        asWebviewUri: (uri: Uri) => new Uri(`https://webview.test${uri.path}`),
        postMessage: async (message: { kind: string }) => void panel.posted.push(message),
        onDidReceiveMessage: messages.on,
        set html(text: string) {
          panel.html = text;
        },
      },
    };
  },
};

export const commands = { registerCommand: (name: string, run: (...args: any[]) => any) => (seen.commands.set(name, run), { dispose() {} }) };

export const workspace = {
  get isTrusted(): boolean {
    return seen.trusted;
  },
  get textDocuments(): { uri: Uri; getText(): string }[] {
    return seen.documents;
  },
  onDidChangeTextDocument: events.text.on,
  getConfiguration: () => ({ get: () => seen.command }),
  getWorkspaceFolder: () => undefined,
  createFileSystemWatcher: () => ({}),
  fs: { writeFile: async (uri: Uri, bytes: Uint8Array) => void seen.written.set(uri.fsPath, new TextDecoder().decode(bytes)) },
};

export const tasks = { executeTask: async (task: Task) => void seen.tasks.push(task) };

export const languages = { getDiagnostics: () => seen.diagnostics };

export const debug = {
  registerDebugConfigurationProvider: (type: string, provider: unknown) => (seen.providers.set(type, provider), { dispose() {} }),
  registerDebugAdapterDescriptorFactory: (type: string, factory: unknown) => (seen.factories.set(type, factory), { dispose() {} }),
  startDebugging: async (_: unknown, config: Record<string, unknown>) => void seen.launched.push(config),
  onDidStartDebugSession: events.started.on,
  onDidReceiveDebugSessionCustomEvent: events.custom.on,
  onDidTerminateDebugSession: events.ended.on,
};
