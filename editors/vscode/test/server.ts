// The real language server over standard input and output, as for the editor's client.
import { spawn } from "node:child_process";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { createMessageConnection, StreamMessageReader, StreamMessageWriter } from "vscode-jsonrpc/node";
import type { Changed } from "../../../studio/page/drawing/shapes";
import type { Server } from "../src/drawing";

export const AFPC = process.env.AFPC ?? "";

export const PLAN = `use carbot

plan Patrol {
    start go
    actor go: Forward {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> back }
        ForwardSuccessful -> go
    }
    actor back: Forward(distance = -30 cm) { ForwardSuccessful -> terminate }
}
`;

export interface Talk extends Server {
  uri: string;
  file: string;
  /** Replaces the whole text. */
  type(text: string): Promise<void>;
  onChange(take: (change: Changed) => void): void;
}

/** A server with one document in a separate folder. */
export async function serving(run: (talk: Talk) => Promise<void>, text = PLAN): Promise<void> {
  if (!AFPC) throw new Error("AFPC does not say where afpc is");
  const folder = await mkdtemp(join(tmpdir(), "afp-vscode-"));
  const file = join(folder, "plan.afp");
  await writeFile(file, text);
  const child = spawn(AFPC, ["lsp"], { stdio: ["pipe", "pipe", "inherit"], cwd: folder });
  const connection = createMessageConnection(new StreamMessageReader(child.stdout), new StreamMessageWriter(child.stdin));
  connection.listen();
  const uri = pathToFileURL(file).href;
  let version = 1;
  try {
    await connection.sendRequest("initialize", { processId: process.pid, rootUri: pathToFileURL(folder).href, capabilities: {} });
    await connection.sendNotification("initialized", {});
    await connection.sendNotification("textDocument/didOpen", { textDocument: { uri, languageId: "afp", version, text } });
    await run({
      uri,
      file,
      request: (method, params) => connection.sendRequest(method, params),
      type: (text) => connection.sendNotification("textDocument/didChange", { textDocument: { uri, version: ++version }, contentChanges: [{ text }] }),
      onChange: (take) => void connection.onNotification("afp/drawingChanged", take),
    });
    await connection.sendRequest("shutdown");
    await connection.sendNotification("exit");
  } finally {
    connection.dispose();
    child.kill();
    await rm(folder, { recursive: true, force: true });
  }
}

/** Waits until `find` returns a result. */
export async function there<T>(find: () => T | undefined | false | null, what: string): Promise<T> {
  const end = Date.now() + 10_000;
  for (;;) {
    const found = find();
    if (found) return found;
    if (Date.now() > end) throw new Error(`no ${what} within 10 s`);
    await new Promise((done) => setTimeout(done, 20));
  }
}
