// The minimap: the whole drawing with a frame around the visible part. A press or drag moves the
// view.
import { computed } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { selected } from "../plan/selection";
import * as actions from "./actions";
import { colours } from "./far";
import { drawing } from "./model";
import { paint } from "./paint";
import { size, view } from "./stage";
import { centred, fitted, sight, toPane, toPlan } from "./view";

/** In CSS pixels. */
const MAP = { width: 168, height: 112 };
/** Minimum pane size for the minimap. */
const LEAST = { width: 560, height: 400 };

const whole = computed(() => fitted(drawing.value?.bounds ?? [0, 0, 1, 1], MAP, 0, 4));

/** Whether a part of the drawing is out of view, and the pane is large enough. */
const needed = computed(() => {
  const drawn = drawing.value;
  if (!drawn?.plan || size.value.width < LEAST.width || size.value.height < LEAST.height) return false;
  const [x, y, width, height] = sight(view.value, size.value);
  const [left, top, wide, high] = drawn.bounds;
  return left < x || top < y || left + wide > x + width || top + high > y + height;
});

/** Whether the selection is under the map, which then moves up. */
const covers = computed(() => {
  const last = selected.value.at(-1);
  const rect = last && drawing.value ? (drawing.value.elements.get(last.item)?.outer ?? actions.rectOfPart(last)) : null;
  if (!rect) return false;
  const [right, bottom] = toPane(view.value, [rect[0] + rect[2], rect[1] + rect[3]]);
  return right > size.value.width - MAP.width - 24 && bottom > size.value.height - MAP.height - 24;
});

export function Minimap() {
  return needed.value ? <Map /> : null;
}

function Map() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    if (canvas.current && drawing.value && colours.value) paint(canvas.current, drawing.value, whole.value, MAP, colours.value);
  }, [drawing.value, colours.value, whole.value]);
  const go = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    const { left, top } = event.currentTarget.getBoundingClientRect();
    view.value = centred(view.peek(), toPlan(whole.peek(), [event.clientX - left, event.clientY - top]), size.peek());
  };
  const down = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    event.currentTarget.setPointerCapture(event.pointerId);
    go(event);
  };
  const move = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    if (event.buttons & 1) go(event);
  };
  return (
    <div class={`over minimap ${covers.value ? "up" : ""}`} aria-hidden="true" onPointerDown={down} onPointerMove={move}>
      <canvas ref={canvas} />
      <Frame />
    </div>
  );
}

/** The visible part. */
function Frame() {
  const [x, y, width, height] = sight(view.value, size.value);
  const [left, top] = toPane(whole.value, [x, y]);
  const [right, bottom] = toPane(whole.value, [x + width, y + height]);
  const place = (node: HTMLElement | null): void => {
    node?.style.setProperty("transform", `translate(${left}px, ${top}px)`);
    node?.style.setProperty("width", `${right - left}px`);
    node?.style.setProperty("height", `${bottom - top}px`);
  };
  return <div class="minimap-frame" ref={place} />;
}
