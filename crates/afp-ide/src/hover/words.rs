//! Descriptions of keywords.

use afp_syntax::kind::Kind;

/// Returns the description of a keyword in a node; `None` for self-explanatory words.
pub(super) fn help(word: &str, within: Kind) -> Option<&'static str> {
    let in_toolbox = matches!(within, Kind::Template | Kind::InPort | Kind::OutPort);
    Some(match word {
        "use" => "Imports a toolbox, or the plans of another file.",
        "plan" => "A robot's behaviour: elements, one of which is active, and their supervisors.",
        "scenario" => "A test of a plan: stimuli and expected behaviour.",
        "enum" => "A type whose values are listed.",
        "table" => "Rows of constants for a computation that reads tables.",
        "toolbox" => "Templates, and the devices of a robot, for plans to use.",
        "start" => "The element that is active first.",
        "actor" if in_toolbox => "A template that acts over time and ends in a state.",
        "actor" => "An element that acts over time and ends in a state.",
        "computation" => "Computes at once and ends in a state; takes no time.",
        "subplan" => "A plan used like an actor.",
        "supervise" => {
            "Watches while its element is active, or during the whole plan if it belongs to the plan; its events interrupt."
        }
        "on" if within == Kind::Reactions => {
            "Targets of a plan supervisor's events while this element is active; unlisted events keep their edges."
        }
        "supervisor" => "A template that watches and reports events.",
        "in" if in_toolbox => "An input of a template.",
        "in" => "An entry that is set from outside; a port where the plan is used as a sub-plan.",
        "out" if in_toolbox => "An output of a template.",
        "out" => "An entry that is a result; a port where the plan is used as a sub-plan.",
        "var" => "A variable of the plan.",
        "const" => "An entry that never changes.",
        "forever" => "The plan never ends by itself.",
        "from" | "to" if within == Kind::Range => "The range of the value, with both bounds.",
        "from" if within == Kind::Moment => {
            "Times in its braces count from the first moment when this condition holds or this event happens."
        }
        "live" if within == Kind::Entry => "A sub-plan reads it again before each of its steps.",
        "live" => "Read again at every poll.",
        "every" => "The period of its polls.",
        "deadline" => "The time from a release to the latest end of its poll.",
        "budget" => "The longest time of one poll.",
        "stop" if within == Kind::Timing => "The longest time from an interruption to standstill.",
        "uses" => "A part of the robot that it controls; only one element at a time may.",
        "needs" => "Another part that the robot must have.",
        "state" => "One of its endings.",
        "and" if within == Kind::When => "Both comparisons must hold.",
        "event" => "A report that may interrupt the active element.",
        "exclusive" => "Two events that never hold at the same time.",
        "when" => "The state is reached, or the event holds, only if all comparisons hold.",
        "after" if within == Kind::After => "The time from the start to the event.",
        "expect" => "A claim that must hold.",
        "never" => "A claim that must never hold.",
        "until" => "The latest end of the run.",
        "at" if within == Kind::Stimulus => "An action from outside, and its time.",
        _ => return None,
    })
}
