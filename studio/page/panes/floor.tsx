// The floor from above: objects, the robot and its path; the robot and movable objects can be
// dragged.
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { start } from "../debug/arranged";
import { active, state } from "../debug/run";
import { frame, placeOf, points, scaleIn, sector, short, viewBox, type Point, type Pose, type Thing } from "../world/geometry";
import { grab, nudged, placeOn } from "../world/grab";
import { ghost, held, poseNow, putDown, reach, robotAt, standing, takeAway, type Held } from "../world/hand";
import { shown, towards, type Motion } from "../world/motion";
import { draw, outlined, sketch, tool } from "../world/room";
import { sensed } from "../world/sensed";
import { path, type Surroundings } from "../world/surroundings";
import { words } from "../words";

/** Height of a name and width of a letter, pixels. */
const TALL = 11;
const LETTER = 6;

export function Floor({ world }: { world: Surroundings }) {
  const host = useRef<SVGSVGElement>(null);
  const [scale, setScale] = useState(100);
  const box = frame(world);
  useEffect(() => {
    const measure = new ResizeObserver(([entry]) => entry && setScale(scaleIn(box, entry.contentRect.width, entry.contentRect.height) || 1));
    measure.observe(host.current!);
    return () => measure.disconnect();
  }, [world]);
  const begin = (event: PointerEvent): void => {
    if (tool.value === "box" || tool.value === "wall") sketching(event);
  };
  const pixels = (number: number): string => short(number / scale);
  const things = standing.value;
  return (
    <svg class={`floor ${tool.value ?? ""}`} viewBox={viewBox(box)} role="group" aria-label={words.seenFromAbove(robotAt(world))} ref={host}>
      <g class="metres" transform="scale(1 -1)">
        <rect class="ground" x={short(box.x)} y={short(box.y)} width={short(box.width)} height={short(box.height)} onPointerDown={begin} />
        {world.patches.map(({ corners, color }, at) => <polygon class="patch" points={points(corners)} fill={`rgb(${color.join()})`} key={at} />)}
        {things.map((thing) => <Obstacle thing={thing} world={world} key={thing.id} />)}
        {world.lights.map(([x, y], at) => <circle class="light" cx={short(x)} cy={short(y)} r={pixels(6)} key={at} />)}
        <Driven />
        <Cones />
        {things.filter(({ labelled }) => labelled).map(({ name, outline, id }) => <Label name={name} at={placeOf(outline, box, [(name.length * LETTER) / scale, TALL / scale])} size={pixels(TALL)} key={id} />)}
        <Robot world={world} />
        <Ghost world={world} />
        {sketch.value && <polygon class="ghost" points={points(sketch.value)} />}
      </g>
    </svg>
  );
}

/** Makes an object on the floor draggable, by pointer and by arrow keys. */
const grip = (what: Held, name: string, world: Surroundings) => ({
  tabindex: 0,
  role: "button" as const,
  "aria-label": words.grip(name),
  onPointerDown: (event: PointerEvent) => pressed(event, what, world),
  onKeyDown: (event: KeyboardEvent) => {
    const to = nudged(poseNow(what, world), event.key, event.shiftKey);
    if (event.key === "Delete") takeAway(what);
    if (!to) return;
    event.preventDefault();
    event.stopPropagation();
    reach();
    putDown(what, to);
  },
});

function pressed(event: PointerEvent, what: Held, world: Surroundings): void {
  if (tool.peek() === "remove") takeAway(what);
  else if (tool.peek() === "box" || tool.peek() === "wall") sketching(event);
  else grab(event, what, world);
}

/** Draws a box or a wall with the pressed pointer. */
function sketching(event: PointerEvent): void {
  if (event.button !== 0) return;
  const target = event.currentTarget as SVGGraphicsElement;
  const floor = target.ownerSVGElement!.querySelector<SVGGraphicsElement>(".metres")!;
  const from = placeOn(floor, event);
  target.setPointerCapture(event.pointerId);
  const move = (moved: PointerEvent): void => void (sketch.value = outlined(from, placeOn(floor, moved)));
  const end = (up: PointerEvent | null): void => {
    target.removeEventListener("pointermove", move);
    document.removeEventListener("keydown", cancel, true);
    const isDrawn = sketch.peek() !== null;
    sketch.value = null;
    if (up && isDrawn) draw(from, placeOn(floor, up));
  };
  const cancel = (key: KeyboardEvent): void => {
    if (key.key !== "Escape") return;
    key.stopPropagation();
    end(null);
  };
  target.addEventListener("pointermove", move);
  target.addEventListener("pointerup", end, { once: true });
  target.addEventListener("pointercancel", () => end(null), { once: true });
  document.addEventListener("keydown", cancel, true);
}

function Obstacle({ thing, world }: { thing: Thing; world: Surroundings }) {
  const { id, name, outline, low, movable, path } = thing;
  return (
    <>
      {path.length > 1 && <polyline class="course" points={points(path)} />}
      <polygon class={`thing${low ? " low" : ""}${movable ? " loose" : ""}`} points={points(outline)} {...(movable || tool.value ? grip({ id }, name, world) : {})} />
    </>
  );
}

const Label = ({ name, at: [x, y], size }: { name: string; at: Point; size: string }) => (
  <text class="label" transform={`translate(${short(x)} ${short(y)}) scale(1 -1)`} font-size={size} dy=".35em">{name}</text>
);

/** In pieces, so that the cost of a frame does not grow with the path. */
const Driven = () => <>{path.value.map((piece, at) => <polyline class="driven" points={points(piece)} key={at} />)}</>;

/** Latest readings of range sensors. */
const Cones = () => (
  <>{sensed.value?.sensed.map(({ signal, cone }) => cone && cone.range !== null && <path class="cone" d={sector(cone.pose, cone.half, cone.range)} key={signal} />)}</>
);

/** Preview of the dragged object. */
const Ghost = ({ world }: { world: Surroundings }) => (held.value ? <polygon class="ghost" points={points(ghost(held.value, world))} /> : null);

const isStill = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** The robot, moved by one attribute per frame during a motion; its nose turns it. */
function Robot({ world }: { world: Surroundings }) {
  const host = useRef<SVGGElement>(null);
  // Before the first paint, so that it is never at the origin.
  useLayoutEffect(() => {
    let motion: Motion | null = null;
    let waiting = 0;
    const set = ([x, y, heading]: Pose): void => host.current!.setAttribute("transform", `translate(${short(x)} ${short(y)}) rotate(${short((heading * 180) / Math.PI)})`);
    const move = (): void => {
      cancelAnimationFrame(waiting);
      waiting = 0;
      const now = performance.now();
      set(shown(motion!, now));
      if (now < motion!.end) waiting = requestAnimationFrame(move);
    };
    const told = (): void => {
      const now = state.value;
      motion = towards(now ? motion : null, now?.pose ?? start.value ?? world.start, performance.now(), isStill());
      waiting ||= requestAnimationFrame(move);
    };
    const ends = [state.subscribe(told), start.subscribe(told)];
    move();
    return () => {
      ends.forEach((end) => end());
      cancelAnimationFrame(waiting);
    };
  }, [world]);
  const nose = Math.max(0.05, ...world.body.map(([x]) => x));
  return (
    <g class="robot" ref={host} {...grip("robot", words.robot, world)}>
      <polygon points={points(world.body)} />
      <path d={`M0 0H${short(nose)}`} />
      {!active.value && <circle class="nose" cx={short(nose)} cy="0" r={short(nose / 4)} onPointerDown={(event) => { event.stopPropagation(); grab(event, "robot", world, true); }} />}
    </g>
  );
}
