// The drawing of the plan.
import { words } from "../words";

export function mountCanvas(host: HTMLElement): void {
  host.textContent = words.comingDrawing;
}
