// Plans of any size: elements of every kind, connected at random but reproducibly.
import { random } from "./random";

const HEAD = `use std
use carbot

plan Large {
    in walldist: length = 30 cm
    out result: angle

    start element0

    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }
    supervise tired: CheckTimeout(duration = 90 s) { TimedOut -> element0 }
`;

const SUB_PLAN = `
plan Avoid {
    start back
    actor back: Forward(distance = -10 cm) { ForwardSuccessful -> terminate }
}
`;

/** Templates of elements with their exits; the first exit leads to the next element. */
const KINDS: [head: string, exits: string[]][] = [
  ["actor NAME: Forward(distance = -walldist)", ["ForwardSuccessful"]],
  ["actor NAME: SearchWall(angle => result)", ["WallFound", "NoWallFound"]],
  ["actor NAME: WallForward(walldist = walldist, gain = 2)", ["ForwardSuccessful", "LaneNotFree", "WallLost"]],
  ["computation NAME: Compare(left = walldist, right = 1 m)", ["Less", "Equal", "Greater"]],
  ["subplan NAME: Avoid", ["OK"]],
];

/**
 * The text of a plan with this many elements: each leads to the next one, most also to a later one
 * nearby.
 */
export function large(count: number): string {
  const below = random(7);
  const target = (nth: number): string => {
    const kind = below(10);
    return kind === 0 ? "terminate" : `element${kind === 1 ? below(count) : (nth + 1 + below(3)) % count}`;
  };
  const element = (nth: number): string => {
    const [head, exits] = KINDS[nth % KINDS.length]!;
    const guard = nth % 2 === 0 && !head.startsWith("computation") ? `        supervise touch: CheckTouchSensor { TouchSensorPressed -> ${target(nth)} }\n` : "";
    const lines = exits.map((exit, at) => `        ${exit} -> ${at === 0 ? `element${(nth + 1) % count}` : target(nth)}`);
    return `    ${head.replace("NAME", `element${nth}`)} {\n${guard}${lines.join("\n")}\n    }`;
  };
  return `${HEAD}\n${Array.from({ length: count }, (_, nth) => element(nth)).join("\n\n")}\n}\n${SUB_PLAN}`;
}
