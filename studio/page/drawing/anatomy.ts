// The parts of an element or supervisor: ports with bindings, exits with targets, timing.
import * as ask from "./ask";
import { offerOf } from "./catalog";
import type { Choice } from "./choose";
import { holderOf, type Drawing, type Part } from "./shapes";
import { words } from "./words";

export interface Port {
  part: Part;
  name: string;
  out: boolean;
  answer: ask.PortAnswer | null;
}

export interface Exit {
  part: Part;
  name: string;
  /** Target as written; empty for none. */
  to: string;
}

export interface Anatomy {
  item: string;
  kind: string;
  template: string;
  offer: ask.Offer | null;
  ports: Port[];
  exits: Exit[];
  /** `every` and `deadline` of a supervisor, as written. */
  timing: { every: string; deadline: string } | null;
}

/** Parses a port of a template: `in live distance: length = 30 cm from 0 cm to 400 cm`. */
export function declared(port: string): { name: string; out: boolean } | null {
  const found = /^(in|out)\s+(?:live\s+)?(\w+)\s*:/.exec(port);
  return found ? { name: found[2]!, out: found[1] === "out" } : null;
}

const HEAD = /^\s*(?:\/\/\/?.*\n\s*)*(actor|computation|subplan|supervise)\s+\w+\s*:\s*([\w.]+)([^{]*)/d;

/** Parses the first line of an element or supervisor: kind, template and timing. */
export function headed(text: string): { kind: string; template: string; every: string; deadline: string } {
  const [, kind = "", template = "", rest = ""] = HEAD.exec(text) ?? [];
  const after = (keyword: string): string => new RegExp(`\\b${keyword}\\s+(\\S+(?:\\s+(?!every\\b|deadline\\b)[A-Za-z]+\\b)?)`).exec(rest)?.[1] ?? "";
  return { kind, template, every: after("every"), deadline: after("deadline") };
}

/** The end of the template's name in that line; null without one. */
export function templateAt(text: string): number | null {
  const end = HEAD.exec(text)?.indices?.[2]?.[1];
  return end === undefined ? null : end - 1;
}

/** Requests the parts of an item; null if it is not an element or supervisor. */
export async function anatomy(drawing: Drawing, item: string): Promise<Anatomy | null> {
  const text = await ask.written(item);
  const { kind, template, every, deadline } = headed(text);
  if (!kind || !template) return null;
  const offer = offerOf(template);
  const drawn = holderOf(drawing, item)?.pieces.filter((piece) => piece.item === item) ?? [];
  const bound = drawn.filter(({ part }) => part.kind === "input" || part.kind === "output");
  const known = (offer?.ports ?? []).map(declared).filter((port) => port !== null);
  // Also shows bindings unknown to the template.
  const more = bound.filter(({ part }) => !known.some((port) => port.name === part.name)).map(({ part }) => ({ name: part.name ?? "", out: part.kind === "output" }));
  const ports = await Promise.all([...known, ...more].map((port) => asked(item, port)));
  const outcomes = [...new Set([...(offer?.exits ?? []), ...drawn.filter(({ part }) => part.kind === "exit").map(({ part }) => part.name ?? "")])];
  const exits = await Promise.all(outcomes.map((name) => led(item, name)));
  return { item, kind, template, offer, ports, exits, timing: kind === "supervise" ? { every, deadline } : null };
}

async function asked(item: string, { name, out }: { name: string; out: boolean }): Promise<Port> {
  const part: Part = { item, part: { kind: out ? "output" : "input", name, nth: 1 } };
  return { part, name, out, answer: await ask.port(item, name).catch(() => null) };
}

async function led(item: string, name: string): Promise<Exit> {
  const part: Part = { item, part: { kind: "exit", name, nth: 1 } };
  const text = await ask.written(item, part.part).catch(() => "");
  return { part, name, to: text.split("->")[1]?.trim() ?? "" };
}

/** The state of a port's value: bound, default, or required. */
export function worth({ answer, out }: Port): string {
  if (answer?.value) return answer.value;
  if (out) return "";
  return answer?.default ? words.isDefault(answer.default) : words.needsValue;
}

export function choices(found: Anatomy): { choice: Choice; part: Part }[] {
  const ports = found.ports.map((port) => ({ choice: { id: `port ${port.name}`, label: port.name, hint: worth(port) }, part: port.part }));
  const exits = found.exits.map((exit) => ({ choice: { id: `exit ${exit.name}`, label: exit.name, hint: exit.to ? `→ ${exit.to}` : words.open }, part: exit.part }));
  return [...ports, ...exits];
}
