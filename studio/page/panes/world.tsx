// The world from above: what stands in it, the robot at its pose, the path that it has driven; seen before any run.
import { useEffect, useRef, useState } from "preact/hooks";
import { active, seed, state, world as chosen } from "../debug/run";
import { frame, placeOf, points, scaleIn, short, viewBox, type Point, type Pose, type Thing } from "../world/geometry";
import { shown, towards, type Motion } from "../world/motion";
import { again, choose, missing, path, sow, surroundings, type Surroundings } from "../world/surroundings";
import { words } from "../words";
import { Faults, Stimuli } from "./outside";

export function WorldPane() {
  const world = surroundings.value;
  return (
    <div class="world">
      {world && <Where world={world} />}
      {world ? <Picture world={world} /> : <Absent />}
      <Stimuli />
      <Faults />
    </div>
  );
}

const Absent = () =>
  missing.value ? (
    <div class="empty">
      <p>{words.noWorld(missing.value)}</p>
      <button onClick={() => void again()}>{words.tryAgain}</button>
    </div>
  ) : (
    <p class="empty">{words.worldComes}</p>
  );

/** In which world the next run takes place, and with which noise. */
function Where({ world }: { world: Surroundings }) {
  const known = world.worlds.some(({ name }) => name === chosen.value);
  const value = known ? chosen.value! : (world.worlds[0]?.name ?? "");
  return (
    <div class="where">
      <select aria-label={words.world} title={words.world} value={value} disabled={active.value} onChange={(event) => choose(event.currentTarget.value)}>
        {world.worlds.map(({ name, from }) => <option value={name} key={name}>{words.worldOf(name, from)}</option>)}
      </select>
      <label title={words.seedHint}>
        {words.seed}
        <input type="number" min="0" step="1" value={seed.value} disabled={active.value} onChange={(event) => sow(event.currentTarget.value)} />
      </label>
    </div>
  );
}

/** Pixels of a name: its height, and the width of a letter. */
const TALL = 11;
const LETTER = 6;

function Picture({ world }: { world: Surroundings }) {
  const host = useRef<SVGSVGElement>(null);
  const [scale, setScale] = useState(100);
  const box = frame(world);
  useEffect(() => {
    const measure = new ResizeObserver(([entry]) => entry && setScale(scaleIn(box, entry.contentRect.width, entry.contentRect.height) || 1));
    measure.observe(host.current!);
    return () => measure.disconnect();
  }, [world]);
  const pixels = (number: number): string => short(number / scale);
  return (
    <svg class="floor" viewBox={viewBox(box)} role="img" aria-label={words.seenFromAbove(state.value?.pose ?? world.start)} ref={host}>
      <g transform="scale(1 -1)">
        <rect class="ground" x={short(box.x)} y={short(box.y)} width={short(box.width)} height={short(box.height)} />
        {world.patches.map(({ corners, color }, at) => <polygon class="patch" points={points(corners)} fill={`rgb(${color.join()})`} key={at} />)}
        {world.things.map((thing, at) => <Obstacle thing={thing} key={at} />)}
        {world.lights.map(([x, y], at) => <circle class="light" cx={short(x)} cy={short(y)} r={pixels(6)} key={at} />)}
        <Driven />
        {world.things.filter(({ labelled }) => labelled).map(({ name, outline }, at) => <Label name={name} at={placeOf(outline, box, [(name.length * LETTER) / scale, TALL / scale])} size={pixels(TALL)} key={at} />)}
        <Robot world={world} />
      </g>
    </svg>
  );
}

const Obstacle = ({ thing: { outline, low, path } }: { thing: Thing }) => (
  <>
    {path.length > 1 && <polyline class="course" points={points(path)} />}
    <polygon class={`thing${low ? " low" : ""}`} points={points(outline)} />
  </>
);

const Label = ({ name, at: [x, y], size }: { name: string; at: Point; size: string }) => (
  <text class="label" transform={`translate(${short(x)} ${short(y)}) scale(1 -1)`} font-size={size} dy=".35em">{name}</text>
);

/** In pieces, so that an hour of driving costs no more a frame than the first minute. */
const Driven = () => <>{path.value.map((piece, at) => <polyline class="driven" points={points(piece)} key={at} />)}</>;

const isStill = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** The robot, moved by one attribute at every frame while there is a way to go. */
function Robot({ world }: { world: Surroundings }) {
  const host = useRef<SVGGElement>(null);
  useEffect(() => {
    let motion: Motion | null = null;
    let waiting = 0;
    const put = ([x, y, heading]: Pose): void => host.current!.setAttribute("transform", `translate(${short(x)} ${short(y)}) rotate(${short((heading * 180) / Math.PI)})`);
    const move = (): void => {
      waiting = 0;
      const now = performance.now();
      put(shown(motion!, now));
      if (now < motion!.end) waiting = requestAnimationFrame(move);
    };
    const ends = state.subscribe((told) => {
      motion = towards(told ? motion : null, told?.pose ?? world.start, performance.now(), isStill());
      waiting ||= requestAnimationFrame(move);
    });
    return () => {
      ends();
      cancelAnimationFrame(waiting);
    };
  }, [world]);
  const nose = Math.max(0.05, ...world.body.map(([x]) => x));
  return (
    <g class="robot" ref={host}>
      <polygon points={points(world.body)} />
      <path d={`M0 0H${short(nose)}`} />
    </g>
  );
}
