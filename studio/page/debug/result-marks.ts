// Results of scenarios in the drawing: failed and unused elements.
import { svg } from "../drawing/fragment";
import { rectOf, type Drawing } from "../drawing/shapes";

/** A red badge with a number for failures, a dotted border for unused elements. */
export function resultMarks(drawn: Drawing, { failed, unused }: { failed: ReadonlyMap<string, number>; unused: ReadonlySet<string> }): SVGElement[] {
  const signs = [...failed].flatMap(([item, number]) => {
    const rect = rectOf(drawn, { item });
    if (!rect) return [];
    const [x, y, width, height] = rect;
    const text = svg("text", { class: "failed-number", x: x + width, y: y + height + 4 });
    text.textContent = String(number);
    return [svg("rect", { class: "failed-frame", x: x - 2, y: y - 2, width: width + 4, height: height + 4, rx: 10 }), svg("circle", { class: "failed-sign", cx: x + width, cy: y + height, r: 9 }), text];
  });
  const never = [...unused].flatMap((item) => {
    const rect = rectOf(drawn, { item });
    return rect ? [svg("rect", { class: "unused-frame", x: rect[0] - 3, y: rect[1] - 3, width: rect[2] + 6, height: rect[3] + 6, rx: 11 })] : [];
  });
  return [...never, ...signs];
}
