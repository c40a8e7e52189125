// The bar above a page that is attached to a robot: it stays visible while the robot runs the plan.
import { operator, robot } from "../debug/attached";
import { step } from "../debug/robot";
import { active, goOn, leave, older, order, pause, phase, stop, why } from "../debug/run";
import { Sign } from "../screen/icons";
import { words } from "../words";

export function RobotBar() {
  if (!robot.value || !active.value) return null;
  const held = phase.value === "held";
  const press = (event: KeyboardEvent): void => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    step();
  };
  return (
    <div class={`robot-bar ${held ? "held" : ""}`} role="status">
      <Sign name={held ? "pause" : "run"} />
      <strong>{words.attachedTo(robot.value)}</strong>
      <span>{held ? words.robotHeld(why.value) : words.robotDrives}</span>
      {older.value && <span>{words.robotOlder}</span>}
      <span class="choices">
        {operator.value && <span>{words.operatedBy(operator.value)}</span>}
        {operator.value && <button onClick={() => void order("afp/role", { take: "operator", lease: true })}>{words.takeControl}</button>}
        {!operator.value && !held && <button title="F8" onClick={() => void pause()}>{words.hold}</button>}
        {!operator.value && held && <button title={words.robotStepHint} onPointerDown={step} onKeyDown={press}>{words.robotStep}</button>}
        {!operator.value && held && <button title="F5" onClick={() => void goOn()}>{words.goOn}</button>}
        <button class="stop" title="Shift+F5" onClick={() => void stop()}>{words.stop}</button>
        <button onClick={() => void leave()}>{words.detach}</button>
      </span>
    </div>
  );
}
