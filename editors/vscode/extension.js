// Starts `afpc lsp` for plans, toolboxes and project files, and runs plans in a terminal.

const path = require("path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

// Lenses that the server shows, since there is a command for each.
const LENSES = ["afp.run", "afp.test"];

let client;

function command() {
  return vscode.workspace.getConfiguration("afp").get("command", "afpc");
}

function start() {
  const server = { command: command(), args: ["lsp"] };
  client = new LanguageClient("afp", "Action Flow Plans", server, {
    documentSelector: [{ language: "afp" }, { pattern: "**/afp.toml" }],
    synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher("**/{*.afp,*.afp.layout,afp.toml}") },
    initializationOptions: { commands: LENSES },
  });
  return client.start();
}

// Runs `afpc VERB FILE` where the user sees it. A lens names the file and the plan, the palette neither.
function inTerminal(verb, lens) {
  if (!vscode.workspace.isTrusted) {
    return vscode.window.showWarningMessage("This folder is not trusted, so nothing of it is run.");
  }
  const uri = lens ? vscode.Uri.parse(lens.uri) : vscode.window.activeTextEditor?.document.uri;
  if (!uri || uri.scheme !== "file") {
    return vscode.window.showWarningMessage("Open a plan first.");
  }
  const file = lens && verb === "run" ? `${uri.fsPath}:${lens.name}` : uri.fsPath;
  // Without a shell, so that no character of a name means anything.
  const task = new vscode.Task(
    { type: "afp", verb },
    vscode.TaskScope.Workspace,
    `${verb} ${path.basename(uri.fsPath)}`,
    "afp",
    new vscode.ProcessExecution(command(), [verb, file], { cwd: path.dirname(uri.fsPath) })
  );
  return vscode.tasks.executeTask(task);
}

async function activate(context) {
  context.subscriptions.push(
    vscode.commands.registerCommand("afp.run", (lens) => inTerminal("run", lens)),
    vscode.commands.registerCommand("afp.test", (lens) => inTerminal("test", lens)),
    vscode.commands.registerCommand("afp.restart", () => client.restart())
  );
  await start();
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
