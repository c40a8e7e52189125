// The drawing as the page keeps it.
import { computed, signal } from "@preact/signals";

export const drawing = signal<{ plan: string | null; plans: string[] } | null>(null);
export const wanted = signal<string | null>(null);
export const plan = computed(() => drawing.value?.plan ?? null);
export const trail = signal<string[]>([]);
export function enter(name: string): void {
  wanted.value = name;
}
export function leave(): boolean {
  return false;
}
export function follow(): () => void {
  return () => {};
}
