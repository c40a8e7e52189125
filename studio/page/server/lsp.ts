// The socket to the language server and the room: JSON-RPC 2.0, a message per text frame, with
// reconnection.
import { signal, type Signal } from "@preact/signals";
import { words } from "../words";

export interface Lsp {
  /** Sends a request, after a reconnection if necessary. */
  request<T>(method: string, params: unknown): Promise<T>;
  /** Sends a notification; without a connection it is dropped. */
  notify(method: string, params: unknown): void;
  /** Subscribes to a server notification; returns a function that ends it. */
  on(method: string, take: (params: any) => void): () => void;
  /** Whether the handshake is complete. */
  readonly open: Signal<boolean>;
}

/** An error response: a sentence for users, and its code in the protocol. */
export class Refused extends Error {
  constructor(readonly code: number, message: string) {
    super(message);
  }
}

/** Code of a response lost with the connection. */
export const LOST = 0;

/** The used part of WebSocket, so that tests can replace it. */
export interface Socket {
  send(text: string): void;
  close(): void;
  onopen: ((event: any) => void) | null;
  onclose: ((event: any) => void) | null;
  onmessage: ((event: any) => void) | null;
}

/** The end of a greeting. */
export type Finish = (() => void) | void;

interface Asked {
  text: string;
  sent: boolean;
  resolve(value: any): void;
  reject(why: Error): void;
}

/** Delays before reconnection attempts, milliseconds. */
const WAITS = [200, 500, 1000, 2000, 5000];

/**
 * Connects, and reconnects when the connection is lost. `greet` runs first on every connection,
 * with a separate `Lsp`; other requests wait for its end. Its result runs right before they
 * continue.
 */
export function connect(
  url: string,
  greet: (first: Lsp) => Promise<Finish> = async () => {},
  make: (url: string) => Socket = (at) => new WebSocket(at) as Socket,
): Lsp {
  const open = signal(false);
  const asked = new Map<number, Asked>();
  const takers = new Map<string, Set<(params: any) => void>>();
  let socket: Socket | null = null;
  let number = 0;
  let attempts = 0;

  const ask = <T>(method: string, params: unknown, now: boolean): Promise<T> =>
    new Promise<T>((resolve, reject) => {
      const id = ++number;
      const text = JSON.stringify({ jsonrpc: "2.0", id, method, params });
      asked.set(id, { text, sent: now, resolve, reject });
      if (now) socket?.send(text);
    });
  const tell = (method: string, params: unknown): void => socket?.send(JSON.stringify({ jsonrpc: "2.0", method, params }));
  const on = (method: string, take: (params: any) => void): (() => void) => {
    const all = takers.get(method) ?? new Set();
    takers.set(method, all.add(take));
    return () => all.delete(take);
  };
  const first: Lsp = { request: (method, params) => ask(method, params, true), notify: tell, on, open };

  const take = (text: string): void => {
    const message = JSON.parse(text);
    if (message.method !== undefined) {
      for (const each of [...(takers.get(message.method) ?? [])]) each(message.params);
      // The server's requests only need an acknowledgement.
      if (message.id !== undefined) socket?.send(JSON.stringify({ jsonrpc: "2.0", id: message.id, result: null }));
      return;
    }
    const waiting = asked.get(message.id);
    asked.delete(message.id);
    if (message.error) waiting?.reject(new Refused(message.error.code, message.error.message));
    else waiting?.resolve(message.result);
  };

  const begin = (): void => {
    const own = make(url);
    socket = own;
    own.onmessage = (event) => take(event.data);
    own.onopen = () => {
      const ready = (finish: Finish): void => {
        if (socket !== own) return;
        finish?.();
        attempts = 0;
        open.value = true;
        for (const each of asked.values()) {
          if (!each.sent) own.send(each.text);
          each.sent = true;
        }
      };
      greet(first).then(ready, (why) => {
        console.error(why);
        own.close();
      });
    };
    own.onclose = () => {
      if (socket !== own) return;
      socket = null;
      open.value = false;
      for (const [id, each] of asked) {
        if (each.sent) each.reject(new Refused(LOST, words.connectionLost));
        if (each.sent) asked.delete(id);
      }
      setTimeout(begin, WAITS[Math.min(attempts++, WAITS.length - 1)]);
    };
  };
  begin();
  return {
    request: (method, params) => ask(method, params, open.value),
    notify: (method, params) => {
      if (open.value) tell(method, params);
    },
    on,
    open,
  };
}
