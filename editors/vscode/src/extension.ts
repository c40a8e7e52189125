// The thin layer between Visual Studio Code and the rest: only code that needs the editor.
import * as path from "node:path";
import * as vscode from "vscode";
import { LanguageClient, State } from "vscode-languageclient/node";
import type { Changed } from "../../../studio/page/drawing/shapes";
import { isElsewhere, adapterOf, argumentsOf, completed, launchOf, programOf, type Launch } from "./launch";
import { Panels } from "./panels";

/**
 * The arguments of a lens: the file, and the name of a plan or scenario. The palette gives none.
 */
interface Lens {
  uri: string;
  name: string;
}

/** Lenses that the server shows, because the editor has their commands. */
const LENSES = ["afp.run", "afp.debug", "afp.drawing", "afp.test"];

/** The formats of a saved drawing. */
const FORMATS = { SVG: "svg", PNG: "png", GraphViz: "dot", JSON: "json", SCXML: "scxml" };

let client: LanguageClient | undefined;
let panels: Panels;

const command = (): string => vscode.workspace.getConfiguration("afp").get("command", "afpc");

function made(): LanguageClient {
  const server = { command: command(), args: ["lsp"] };
  return new LanguageClient("afp", "Action Flow Plans", server, {
    documentSelector: [{ language: "afp" }, { pattern: "**/afp.toml" }],
    synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher("**/{*.afp,*.afp.layout,afp.toml}") },
    initializationOptions: { commands: LENSES },
  });
}

/** The file of a command, on disk; without one, shows an error and returns undefined. */
function fileFor(lens: Lens | undefined): vscode.Uri | undefined {
  const uri = lens ? vscode.Uri.parse(lens.uri) : vscode.window.activeTextEditor?.document.uri;
  if (uri?.scheme === "file" && uri.path.endsWith(".afp")) return uri;
  void vscode.window.showWarningMessage("Open a plan first.");
  return undefined;
}

/** As `fileFor`, for commands that run code of the folder. */
function runnable(lens: Lens | undefined): vscode.Uri | undefined {
  if (vscode.workspace.isTrusted) return fileFor(lens);
  void vscode.window.showWarningMessage("This folder is not trusted, so its plans do not run.");
  return undefined;
}

/** Runs `afpc VERB FILE` in a visible terminal. */
function inTerminal(verb: "run" | "test", lens?: Lens): Thenable<unknown> | undefined {
  const uri = runnable(lens);
  if (!uri) return undefined;
  // Without a shell, so that no character of a name is special.
  const execution = new vscode.ProcessExecution(command(), argumentsOf(verb, uri.fsPath, lens?.name ?? null), { cwd: path.dirname(uri.fsPath) });
  const task = new vscode.Task({ type: "afp", verb }, vscode.TaskScope.Workspace, `${verb} ${path.basename(uri.fsPath)}`, "afp", execution);
  return vscode.tasks.executeTask(task);
}

function debug(lens?: Lens): Thenable<unknown> | undefined {
  const uri = runnable(lens);
  if (!uri) return undefined;
  const launch = launchOf(uri.fsPath, lens?.name ?? null);
  return vscode.debug.startDebugging(vscode.workspace.getWorkspaceFolder(uri), launch as vscode.DebugConfiguration);
}

/** Saves the drawing of a file as a picture or for another program. */
async function graph(): Promise<void> {
  const uri = fileFor(undefined);
  const format = uri && (await vscode.window.showQuickPick(Object.keys(FORMATS), { placeHolder: "Save the drawing as" }));
  if (!uri || !format) return;
  const ending = FORMATS[format as keyof typeof FORMATS];
  const { text, base64 } = await client!.sendRequest<{ text?: string; base64?: string }>("afp/export", { textDocument: { uri: uri.toString() }, format: ending });
  const target = await vscode.window.showSaveDialog({ defaultUri: vscode.Uri.file(uri.fsPath.replace(/\.afp$/, `.${ending}`)) });
  if (target) await vscode.workspace.fs.writeFile(target, base64 === undefined ? new TextEncoder().encode(text) : Buffer.from(base64, "base64"));
}

/** Launch configurations for F5, lenses and launch.json. */
const configurations: vscode.DebugConfigurationProvider = {
  resolveDebugConfiguration(_folder, config) {
    const open = vscode.window.activeTextEditor?.document;
    const full = completed(config as Launch, open ? { path: open.uri.fsPath, language: open.languageId } : null);
    if (typeof full !== "string") return full as vscode.DebugConfiguration;
    void vscode.window.showErrorMessage(full);
    return undefined;
  },
  // Paths are resolved now. A plan with errors does not run; its first error is shown.
  async resolveDebugConfigurationWithSubstitutedVariables(_folder, config) {
    if (!config.program) return config;
    const uri = vscode.Uri.file(programOf(config.program as string).file);
    const errors = vscode.languages.getDiagnostics(uri).filter(({ severity }) => severity === vscode.DiagnosticSeverity.Error);
    if (errors.length === 0) return config;
    await vscode.window.showTextDocument(uri, { selection: errors[0]!.range });
    void vscode.window.showErrorMessage(`The plan has ${errors.length === 1 ? "an error" : `${errors.length} errors`}, so nothing runs: ${errors[0]!.message}`);
    return undefined;
  },
};

const adapters: vscode.DebugAdapterDescriptorFactory = {
  createDebugAdapterDescriptor({ configuration }) {
    // A robot is reached through an adapter on this machine.
    if (isElsewhere(configuration as Launch)) return new vscode.DebugAdapterExecutable(command(), ["dap"]);
    // Another run has its adapter already.
    if (configuration.request === "attach") return new vscode.DebugAdapterServer(configuration.port as number);
    if (!vscode.workspace.isTrusted) throw new Error("This folder is not trusted, so its plans do not run.");
    const file = configuration.program ? programOf(configuration.program as string).file : (configuration.log as string);
    return new vscode.DebugAdapterExecutable(command(), adapterOf(configuration as Launch), { cwd: path.dirname(file) });
  },
};

/** Shows the state of runs in the drawings. */
function runs(): vscode.Disposable[] {
  return [
    vscode.debug.onDidStartDebugSession((session) => session.type === "afp" && void Promise.resolve(session.customRequest("afp/subscribe", { state: true })).catch(() => {})),
    vscode.debug.onDidReceiveDebugSessionCustomEvent(({ session, event, body }) => {
      if (session.type === "afp" && event === "afp/state") panels.run(session.configuration.program as string | undefined, body);
    }),
    vscode.debug.onDidTerminateDebugSession((session) => session.type === "afp" && panels.run(session.configuration.program as string | undefined, null)),
  ];
}

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  client = made();
  panels = new Panels(context.extensionUri, client);
  const { registerCommand } = vscode.commands;
  context.subscriptions.push(
    registerCommand("afp.run", (lens?: Lens) => inTerminal("run", lens)),
    registerCommand("afp.test", (lens?: Lens) => inTerminal("test", lens)),
    registerCommand("afp.debug", (lens?: Lens) => debug(lens)),
    registerCommand("afp.drawing", (lens?: Lens) => {
      const uri = fileFor(lens);
      return uri && panels.open(uri, lens?.name ?? null);
    }),
    registerCommand("afp.graph", graph),
    registerCommand("afp.restart", () => client?.restart()),
    vscode.debug.registerDebugConfigurationProvider("afp", configurations),
    vscode.debug.registerDebugAdapterDescriptorFactory("afp", adapters),
    client.onNotification("afp/drawingChanged", (change: Changed) => panels.changed(change)),
    client.onDidChangeState(({ newState }) => newState === State.Running && panels.again()),
    panels,
    ...runs(),
  );
  await client.start();
}

export const deactivate = (): Thenable<void> | undefined => client?.stop();
