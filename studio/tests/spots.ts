// Screen positions of the drawing's items, for tests that press on them.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";

export type Spot = [x: number, y: number];

/** The middle of an item. */
export async function middle(page: Page, selector: string): Promise<Spot> {
  const box = await page.locator(selector).first().boundingBox();
  assert.ok(box, selector);
  return [box.x + box.width / 2, box.y + box.height / 2];
}

/** The name of an item. */
export const name = (item: string): string => `.node [data-item="${item}"] text.name`;
/** An exit of an item. */
export const exit = (item: string, label: string): string => `.node [data-item="${item}"] text:text-is("${label}")`;

/** Fills the form of a new entry from a line of the text: `in walldist: length = 30 cm`. */
export async function fillEntry(page: Page, line: string): Promise<void> {
  const [, kind, called, type, value] = /^(\w+) (\w+): (\w+)(?: = (.*))?$/.exec(line) ?? [];
  const form = page.getByRole("dialog");
  await form.getByLabel("Name").fill(called!);
  await form.getByLabel("Kind").selectOption(kind!);
  await form.getByLabel("Type").selectOption(type!);
  await form.getByRole("textbox", { name: "Value" }).fill(value ?? "");
}
