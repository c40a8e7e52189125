// The world of a run: its selection, the floor, and interaction.
import { useEffect, useRef } from "preact/hooks";
import { Tool } from "../screen/bar";
import { robot } from "../debug/attached";
import { active, given, log, seed, state, world as chosen } from "../debug/run";
import { putBack } from "../debug/arranged";
import { arranged } from "../world/hand";
import { refuse } from "../drawing/say";
import { show, watched } from "../world/camera";
import { again, awaited, choose, missing, sow, surroundings, type Surroundings } from "../world/surroundings";
import { begin, chosenTool, file, tool } from "../world/room";
import { current } from "../documents/documents";
import { pen } from "../server/session";
import { words } from "../words";
import { Floor } from "./floor";
import { Drops, Faults, Stimuli } from "./outside";
import { Sensors } from "./sensors";

export function WorldPane() {
  const world = surroundings.value;
  if (robot.value && active.value) return <RealWorld />;
  return (
    <div class="world">
      {world && <Where world={world} />}
      {world ? <Floor world={world} /> : <Absent />}
      {world && <Hand world={world} />}
      {world?.camera && watched.value && <Camera />}
      <Sensors />
      <Stimuli />
      <Faults />
    </div>
  );
}

/** Only the sensors of a real robot are known. */
function RealWorld() {
  const pose = state.value?.pose;
  return (
    <div class="world">
      <p class="empty">{words.realWorld}{pose && ` ${words.realPose(pose)}`}</p>
      <Sensors />
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
    <p class="empty">{awaited.value || words.worldComes}</p>
  );

/** World and seed of the next run. */
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
        <input type="number" min="0" step="1" value={world.seed ?? seed.value} disabled={active.value || world.seed !== null} onChange={(event) => sowIn(event.currentTarget)} />
      </label>
      {Object.entries(given.value).map(([name, text]) => <Given name={name} text={text} key={name} />)}
    </div>
  );
}

/** Sets a seed; an invalid one is reported, and the field reverts. */
function sowIn(field: HTMLInputElement): void {
  if (sow(field.value)) return;
  field.value = String(seed.peek());
  refuse(words.seedWrong);
}

/** An input of the next runs that differs from the plan. */
const Given = ({ name, text }: { name: string; text: string }) => (
  <span class="given">
    {words.givenTo(name, text)}
    <Tool icon="close" label={words.takeBack(name)} disabled={active.value} run={() => (given.value = Object.fromEntries(Object.entries(given.value).filter(([other]) => other !== name)))} />
  </span>
);

/** Objects to drop, reset, camera. */
const Hand = ({ world }: { world: Surroundings }) => (
  <div class="hand">
    {tool.value ? <RoomTools /> : <Drops world={world} />}
    {!active.value && !log.value && <EditRoom />}
    {arranged.value && !active.value && <button onClick={putBack}>{words.putBack}</button>}
    {world.camera && <button aria-pressed={watched.value} onClick={() => (watched.value = !watched.value)}>{words.camera}</button>}
  </div>
);

/** Begins and ends the editor of the room; without a world file, makes a new room. */
function EditRoom() {
  if (file.value) return <button aria-pressed={tool.value !== null} disabled={!pen.value} onClick={() => (chosenTool.value = tool.value ? null : "move")}>{tool.value ? words.roomDone : words.editRoom}</button>;
  return <button disabled={!pen.value || !current.value} title={words.newRoomHint} onClick={() => void begin()}>{words.newRoom}</button>;
}

const RoomTools = () => (
  <span class="drops" role="group" aria-label={words.editRoom}>
    {(["move", "box", "wall", "remove"] as const).map((each) => (
      <button key={each} aria-pressed={tool.value === each} title={words.roomToolHints[each]} onClick={() => (chosenTool.value = each)}>{words.roomTools[each]}</button>
    ))}
  </span>
);

function Camera() {
  const host = useRef<HTMLCanvasElement>(null);
  useEffect(() => show(host.current!), []);
  return (
    <figure class="camera">
      <canvas width="4" height="3" role="img" aria-label={words.cameraSees} ref={host} />
      {!active.value && <figcaption>{words.cameraLater}</figcaption>}
    </figure>
  );
}
