// The timeline of a run: activity, supervisors, writes, missed deadlines. The ruler scrubs; rows
// and ruler share a window for zoom and pan.
import { computed, signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { forked, phase, records, seek, state, turns } from "../debug/run";
import { beside, moments, rows, scale, within, zoomed, type Row, type Window } from "../debug/trace";
import { Tool } from "../screen/bar";
import { words } from "../words";
import { Choose, Plots } from "./plots";

/** The chosen window; null follows the run. */
const chosen = signal<Window | null>(null);
/** Visible seconds while following. */
const FOLLOWED = 20;
/** Height of a row, pixels. */
const TALL = 22;
/** Milliseconds between requests while the ruler is dragged. */
const PAUSE = 80;

// A new run is followed.
records.subscribe((known) => {
  if (!known.length) chosen.value = null;
});

const all = computed(() => rows(records.value));
const times = computed(() => moments(records.value));
const end = computed(() => Math.max(times.value.at(-1) ?? 0, state.value?.at ?? 0, 0.1));
const now = computed(() => state.value?.at ?? 0);
const sight = computed<Window>(() => chosen.value ?? within({ from: now.value - FOLLOWED / 2, to: now.value + FOLLOWED / 2 }, Math.max(end.value, Math.min(FOLLOWED, end.value))));

const zoom = (factor: number, around = now.value): void => {
  chosen.value = zoomed(sight.value, around, factor, end.value);
};
const jump = (by: -1 | 1): void => {
  const to = beside(times.value, now.value, by);
  if (to !== null) seek(to);
};

export function Timeline() {
  const host = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(600);
  useEffect(() => {
    if (!host.current) return;
    const measure = new ResizeObserver(([entry]) => entry && setWidth(Math.max(100, entry.contentRect.width)));
    measure.observe(host.current);
    return () => measure.disconnect();
  }, [records.value.length > 0]);
  if (!records.value.length) return <p class="empty">{words.noTimeline}</p>;
  const of = sight.value;
  const x = (at: number): number => ((at - of.from) / (of.to - of.from)) * width;
  return (
    <div class="timeline">
      <div class="corner">
        <Tool icon="before" label={words.eventBefore} disabled={!turns.value || beside(times.value, now.value, -1) === null} run={() => jump(-1)} />
        <Tool icon="after" label={words.eventAfter} disabled={!turns.value || beside(times.value, now.value, 1) === null} run={() => jump(1)} />
        <Tool icon="minus" label={words.zoomOut} run={() => zoom(2)} />
        <Tool icon="plus" label={words.zoomIn} run={() => zoom(0.5)} />
        <Tool icon="fit" label={words.wholeRun} run={() => (chosen.value = { from: 0, to: end.value })} />
        <Choose />
      </div>
      <Ruler x={x} of={of} width={width} />
      <div class="rows" onWheel={(event) => wheel(event, of, width)}>
        <Plots of={of} x={x} now={now.value} width={width} />
        <div class="names">{all.value.map((row) => <div class={`name ${row.kind}`} title={label(row)} key={key(row)}>{label(row)}</div>)}</div>
        <div class="lanes" ref={host}>
          <svg width={width} height={all.value.length * TALL} role="img" aria-label={words.rowsOf(all.value.length)}>
            {all.value.map((row, at) => <Lane row={row} at={at} x={x} of={of} width={width} key={key(row)} />)}
            {forked.value !== null && (
              <line class="forked" x1={x(forked.value)} x2={x(forked.value)} y1="0" y2={all.value.length * TALL}><title>{words.forkedAt(forked.value)}</title></line>
            )}
            <line class="now" x1={x(now.value)} x2={x(now.value)} y1="0" y2={all.value.length * TALL} />
          </svg>
        </div>
      </div>
    </div>
  );
}

const key = ({ kind, name }: Row): string => `${kind} ${name}`;
const label = ({ kind, name }: Row): string => (kind === "flow" ? name || words.flow : kind === "misses" ? words.misses : name);

function wheel(event: WheelEvent & { currentTarget: HTMLElement }, { from, to }: Window, width: number): void {
  const lanes = event.currentTarget.querySelector(".lanes")!.getBoundingClientRect();
  const at = from + ((event.clientX - lanes.left) / width) * (to - from);
  if (event.ctrlKey || event.metaKey) {
    event.preventDefault();
    zoom(event.deltaY > 0 ? 1.25 : 0.8, at);
  } else if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
    const by = (((event.deltaX || event.deltaY) / width) * (to - from)) as number;
    chosen.value = within({ from: from + by, to: to + by }, end.value);
  }
}

interface Drawn {
  x: (at: number) => number;
  of: Window;
  width: number;
}

/** The scale and the displayed moment: dragged, or moved by keys from event to event. */
function Ruler({ x, of, width }: Drawn) {
  const last = useRef(0);
  const timeOf = (event: PointerEvent & { currentTarget: HTMLElement }): number => {
    const { left } = event.currentTarget.getBoundingClientRect();
    return Math.min(end.value, Math.max(0, of.from + ((event.clientX - left) / width) * (of.to - of.from)));
  };
  const go = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    if (!chosen.value) chosen.value = of;
    last.current = performance.now();
    seek(timeOf(event));
  };
  const down = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    event.currentTarget.setPointerCapture(event.pointerId);
    go(event);
  };
  const move = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    if (event.currentTarget.hasPointerCapture(event.pointerId) && performance.now() - last.current > PAUSE) go(event);
  };
  const keys: Record<string, () => void> = {
    ArrowLeft: () => jump(-1),
    ArrowRight: () => jump(1),
    Home: () => seek(0),
    End: () => seek(end.value),
    "+": () => zoom(0.5),
    "-": () => zoom(2),
  };
  return (
    <div class="ruler" role="slider" tabIndex={0} aria-label={words.moment} aria-valuemin={0} aria-valuemax={Number(end.value.toFixed(3))}
      aria-valuenow={Number(now.value.toFixed(3))} aria-valuetext={words.seconds(now.value)} onPointerDown={down} onPointerMove={move} onPointerUp={go}
      onKeyDown={(event) => { const act = keys[event.key]; if (act) { event.preventDefault(); event.stopPropagation(); act(); } }}>
      <svg width={width} height="24" aria-hidden="true">
        {scale(of).map((at) => (
          <g transform={`translate(${x(at)} 0)`} key={at}>
            <line class="tick" y1="16" y2="24" />
            <text x="3" y="15">{`${at} s`}</text>
          </g>
        ))}
        {forked.value !== null && <text class="forked" x={x(forked.value) + 3} y="23">{words.simulated}</text>}
        <path class={`cursor ${phase.value}`} d={`M${x(now.value)} 24l-6 -9h12z`} />
      </svg>
    </div>
  );
}

/** The visible part of a row; overlapping marks are merged. */
function Lane({ row, at, x, of, width }: Drawn & { row: Row; at: number }) {
  const [top, long] = [at * TALL, (row.bars.at(-1)?.to ?? end.value) >= 0];
  const bars = row.bars.filter(({ from, to }) => from < of.to && (to ?? end.value) > of.from && long);
  let before = -Infinity;
  const marks = row.marks.filter((mark) => {
    const place = x(mark.at);
    if (place < -4 || place > width + 4 || place - before < 2) return false;
    before = place;
    return true;
  });
  return (
    <g class={`lane ${row.kind}`}>
      {bars.map(({ from, to, label }) => {
        const [left, right] = [Math.max(x(from), -2), Math.min(x(to ?? end.value), width + 2)];
        return (
          <g key={`${from} ${label}`} onClick={() => seek(from)}>
            <rect x={left} y={top + 3} width={Math.max(1, right - left)} height={TALL - 6} rx="3"><title>{words.barOf(label, from, to)}</title></rect>
            {right - left > label.length * 7 + 8 && <text x={left + 5} y={top + TALL - 7}>{label}</text>}
          </g>
        );
      })}
      {marks.map((mark) => (
        <g key={`${mark.at} ${mark.label}`} onClick={() => seek(mark.at)}>
          <circle cx={x(mark.at)} cy={top + TALL / 2} r="4"><title>{`${words.seconds(mark.at)}: ${mark.label}`}</title></circle>
          {row.kind === "entry" && <text x={x(mark.at) + 7} y={top + TALL - 7}>{mark.label}</text>}
        </g>
      ))}
    </g>
  );
}
