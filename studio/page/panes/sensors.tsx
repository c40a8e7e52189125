// Sensor values during a run, as a folded list.
import { sensed } from "../world/sensed";
import { devices } from "../world/surroundings";
import { words } from "../words";

export function Sensors() {
  const all = sensed.value?.sensed ?? [];
  if (!all.length) return null;
  const help = new Map(devices.value.flatMap(({ signals }) => signals.map((each) => [each.words, each.help])));
  return (
    <details class="sensors">
      <summary>{words.sensors}</summary>
      <dl>
        {all.map(({ signal, text }) => <div title={help.get(signal)} key={signal}><dt>{signal}</dt><dd>{text}</dd></div>)}
      </dl>
    </details>
  );
}
