// This page's conversation with the server: greeting, content of the folder, editing client.
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

/** A job of this page that goes on. */
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
  /** Bytes that a text may have. */
  longest: number;
  examples: { name: string; title: string }[];
}

/** The server's greeting; null before it. */
export const hello = signal<Hello | null>(null);
/** The files of the folder that can be opened. */
export const files = signal<{ uri: string; name: string }[]>([]);
/** Whether there are more files than those: the folder is too large to be looked through. */
export const more = signal(false);
/** The jobs that go on, as the server greets with them. */
export const going = signal<readonly Going[]>([]);
/** Whether this page changes texts, or watches. */
export const pen = signal(true);
/** The names of kinds and modifiers in semantic tokens. */
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
 * Connects to a server and greets it on each connection. `again` runs on each but the first, before
 * other requests. `storage` outlives a reload of the page, so that it stays the same client.
 */
export function begin(url: string, again: (lsp: Lsp) => Promise<Finish>, make = connect, storage?: Storage): Lsp {
  let client = storage?.getItem(CLIENT) ?? null;
  const greet = async (first: Lsp): Promise<Finish> => {
    const said = await first.request<Hello>("afp/hello", client === null ? {} : { client: Number(client) });
    const begun = hello.value !== null;
    client = String(said.client);
    storage?.setItem(CLIENT, client);
    // At once: the server's next message is newer.
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
