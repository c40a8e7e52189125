// A client of the language server for tests without the editor: it starts the real server and talks
// with it.
import { spawn, type ChildProcess } from "node:child_process";
import { createMessageConnection, StreamMessageReader, StreamMessageWriter, type MessageConnection } from "vscode-jsonrpc/node";

export const State = { Stopped: 1, Running: 2, Starting: 3 };

export class LanguageClient {
  private child: ChildProcess | undefined;
  private connection: MessageConnection | undefined;
  private readonly waiting: [string, (params: any) => void][] = [];
  /** The server's answer to the first request. */
  static offered: { codeLensProvider?: object } | undefined;
  static current: LanguageClient | undefined;

  constructor(
    _id: string,
    _name: string,
    private readonly server: { command: string; args: string[] },
    private readonly options: { initializationOptions: object },
  ) {
    LanguageClient.current = this;
  }

  async start(): Promise<void> {
    this.child = spawn(this.server.command, this.server.args, { stdio: ["pipe", "pipe", "inherit"] });
    this.connection = createMessageConnection(new StreamMessageReader(this.child.stdout!), new StreamMessageWriter(this.child.stdin!));
    for (const [method, take] of this.waiting) this.connection.onNotification(method, take);
    this.connection.listen();
    const { initializationOptions } = this.options;
    const answer = await this.connection.sendRequest<{ capabilities: object }>("initialize", { processId: process.pid, rootUri: null, capabilities: {}, initializationOptions });
    LanguageClient.offered = answer.capabilities;
    await this.connection.sendNotification("initialized", {});
  }

  sendRequest<T>(method: string, params: object): Promise<T> {
    return this.connection!.sendRequest(method, params);
  }

  sendNotification(method: string, params: object): Promise<void> {
    return this.connection!.sendNotification(method, params);
  }

  onNotification(method: string, take: (params: any) => void): { dispose(): void } {
    this.waiting.push([method, take]);
    return { dispose() {} };
  }

  onDidChangeState(): { dispose(): void } {
    return { dispose() {} };
  }

  async stop(): Promise<void> {
    await this.connection!.sendRequest("shutdown");
    await this.connection!.sendNotification("exit");
    this.connection!.dispose();
    this.child!.kill();
  }
}
