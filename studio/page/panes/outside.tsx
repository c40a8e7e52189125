// Interaction with the robot during a run: pressing controls, injecting faults.
import { computed, signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { active, log, order } from "../debug/run";
import { Sign } from "../screen/icons";
import { press, tap } from "../world/press";
import { points, type Point } from "../world/geometry";
import { placeOn } from "../world/grab";
import { drop, robotAt } from "../world/hand";
import { devices, type Fault, type Stimulus, type Surroundings } from "../world/surroundings";
import { words } from "../words";

/** Whether a robot is running: a log is not. */
const live = computed(() => active.value && !log.value);

const nameOf = (spoken: string): string => spoken.split(".").at(-1)!;

/** A button for each control, stop controls first. */
export function Stimuli() {
  const all = devices.value.flatMap(({ stimuli }) => stimuli);
  const sorted = [...all.filter(({ stops }) => stops), ...all.filter(({ stops }) => !stops)];
  if (!sorted.length) return null;
  return (
    <div class="stimuli" role="group" aria-label={words.controlsOfRobot}>
      {sorted.map((each) => <Control of={each} key={each.words} />)}
    </div>
  );
}

function Control({ of: { words: spoken, help, stops } }: { of: Stimulus }) {
  const release = useRef<(() => void) | null>(null);
  const down = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    if (event.button !== 0 || !live.value) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    release.current ??= press(spoken);
  };
  const up = (): void => {
    release.current?.();
    release.current = null;
  };
  // Keys and screen readers click without a pointer: a whole press.
  const click = (event: MouseEvent): void => {
    if (event.detail === 0) tap(spoken);
  };
  return (
    <button class={stops ? "stops" : ""} disabled={!live.value} title={live.value ? help : words.pressLater(help)}
      onPointerDown={down} onPointerUp={up} onPointerCancel={up} onLostPointerCapture={up} onClick={click}>
      {stops && <Sign name="stop" />}
      {nameOf(spoken)}
    </button>
  );
}

/** Distance in front of the robot for a dropped object, metres. */
const AHEAD = 0.6;

/**
 * Buttons for dropping objects: dragged onto the floor, or clicked for a place in front of the
 * robot.
 */
export function Drops({ world }: { world: Surroundings }) {
  const dropped = useRef(false);
  if (!world.drops.length) return null;
  const down = (event: PointerEvent & { currentTarget: HTMLElement }, shape: string): void => {
    const button = event.currentTarget;
    button.setPointerCapture(event.pointerId);
    dropped.current = false;
    button.onpointerup = (up) => {
      button.onpointerup = null;
      const floor = document.elementFromPoint(up.clientX, up.clientY)?.closest(".floor")?.querySelector<SVGGraphicsElement>(".metres");
      if (!floor) return;
      dropped.current = true;
      drop(shape, placeOn(floor, up));
    };
  };
  const click = (shape: string): void => {
    const [x, y, heading] = robotAt(world);
    if (!dropped.current) drop(shape, [x + AHEAD * Math.cos(heading), y + AHEAD * Math.sin(heading)]);
    dropped.current = false;
  };
  return (
    <span class="drops" role="group" aria-label={words.drop}>
      {world.drops.map(({ shape, outline }) => (
        <button title={words.dropOf(shape)} onPointerDown={(event) => down(event, shape)} onClick={() => click(shape)} key={shape}>
          <svg viewBox={whole(outline)} width="16" height="16" aria-hidden="true"><polygon points={points(outline)} /></svg>
          {shape}
        </button>
      ))}
    </span>
  );
}

/** The view box of an outline around its middle. */
function whole(outline: readonly Point[]): string {
  const reach = 1.2 * Math.max(...outline.flat().map(Math.abs), 0.01);
  return `${-reach} ${-reach} ${2 * reach} ${2 * reach}`;
}

/**
 * The next fault, its amount (null: the robot's default), and its duration in seconds (null: until
 * the end).
 */
const fault = signal("");
const amount = signal<number | null>(null);
const lasting = signal<number | null>(5);
const SECONDS = [1, 5, 30, null] as const;

const inject = ({ words: spoken }: Fault): unknown =>
  order("afp/fault", { fault: spoken, ...(amount.value === null ? {} : { amount: amount.value }), ...(lasting.value === null ? {} : { seconds: lasting.value }) });

/** A folded list of faults. */
export function Faults() {
  const failing = devices.value.filter(({ faults }) => faults.length);
  if (!failing.length) return null;
  const all = failing.flatMap(({ faults }) => faults);
  const one = all.find((each) => each.words === fault.value) ?? all[0]!;
  const pick = (spoken: string): void => {
    [fault.value, amount.value] = [spoken, null];
  };
  return (
    <details class="faults">
      <summary>{words.faults}</summary>
      <div>
        <select aria-label={words.fault} value={one.words} onChange={(event) => pick(event.currentTarget.value)}>
          {failing.map(({ name, faults }) => (
            <optgroup label={name} key={name}>
              {faults.map((each) => <option value={each.words} key={each.words}>{each.words}</option>)}
            </optgroup>
          ))}
        </select>
        {one.amount && (
          <label>
            {one.amount.name}
            <input type="number" step="any" min={one.amount.range[0]} max={one.amount.range[1]} value={amount.value ?? one.amount.default}
              onChange={(event) => (amount.value = Number.isFinite(event.currentTarget.valueAsNumber) ? event.currentTarget.valueAsNumber : null)} />
            {one.amount.unit}
          </label>
        )}
        <select aria-label={words.lasting} value={String(lasting.value)} onChange={(event) => (lasting.value = event.currentTarget.value === "null" ? null : Number(event.currentTarget.value))}>
          {SECONDS.map((each) => <option value={String(each)} key={each}>{words.lastingOf(each)}</option>)}
        </select>
        <button disabled={!live.value} onClick={() => inject(one)}>{words.inject}</button>
      </div>
      <p>{one.help}</p>
    </details>
  );
}
