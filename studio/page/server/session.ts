// The session with the server: greeting, content of the folder, editing client.
import { signal } from "@preact/signals";
import { connect, type Finish, type Lsp } from "./lsp";

export interface Kept {
  uri: string;
  text: string;
  version: number;
  etag: string | null;
}

/** The request of a job. */
export interface Order {
  kind: string;
  [more: string]: unknown;
}

/** A running job of this page. */
export interface Going {
  id: number;
  order: Order;
  /** The lines received by the page. */
  said: string;
}

export interface Hello {
  client: number;
  root: string;
  open: string | null;
  pen: boolean;
  files: { uri: string; name: string }[];
  more?: boolean;
  jobs: Going[];
  /** Maximum size of a text, bytes. */
  longest: number;
  examples: { name: string; title: string }[];
}

/** The server's greeting; null before it. */
export const hello = signal<Hello | null>(null);
/** Files of the folder that can be opened. */
export const files = signal<{ uri: string; name: string }[]>([]);
/** Whether the list is incomplete, because the folder is too large. */
export const more = signal(false);
/** Running jobs from the greeting. */
export const going = signal<readonly Going[]>([]);
/** Whether this page holds the edit lock. */
export const pen = signal(true);
/** Names of semantic token types and modifiers. */
export const legend = signal<{ tokenTypes: string[]; tokenModifiers: string[] }>({ tokenTypes: [], tokenModifiers: [] });

let connection: Lsp | null = null;

/** The connection. Using it before `begin` is an error. */
export function lsp(): Lsp {
  if (!connection) throw new Error("the session has not begun");
  return connection;
}

const CAPABILITIES = {
  general: { positionEncodings: ["utf-16"] },
  textDocument: { completion: { completionItem: { snippetSupport: true } }, documentSymbol: { hierarchicalDocumentSymbolSupport: true } },
  workspace: {
    workspaceEdit: { documentChanges: true, resourceOperations: ["create"] },
    semanticTokens: { refreshSupport: true },
    inlayHint: { refreshSupport: true },
  },
};

const CLIENT = "afp-studio-client";

/**
 * Connects to a server and greets it on each connection. `again` runs on reconnections, before
 * other requests. `storage` outlives a reload, so that the client stays the same.
 */
export function begin(url: string, again: (lsp: Lsp) => Promise<Finish>, make = connect, storage?: Storage): Lsp {
  let client = storage?.getItem(CLIENT) ?? null;
  const greet = async (first: Lsp): Promise<Finish> => {
    const said = await first.request<Hello>("afp/hello", client === null ? {} : { client: Number(client) });
    const begun = hello.value !== null;
    client = String(said.client);
    storage?.setItem(CLIENT, client);
    // Immediately: the server's next message is newer.
    [files.value, more.value] = [said.files, said.more ?? false];
    pen.value = said.pen;
    const params = { processId: null, rootUri: said.root, workspaceFolders: [{ uri: said.root, name: "root" }], capabilities: CAPABILITIES };
    const { capabilities } = await first.request<any>("initialize", params);
    first.notify("initialized", {});
    legend.value = capabilities.semanticTokensProvider?.legend ?? legend.value;
    [hello.value, going.value] = [said, said.jobs];
    if (begun) return again(first);
  };
  connection = make(url, greet);
  connection.on("afp/files", (params) => ([files.value, more.value] = [params.files, params.more]));
  return connection;
}
