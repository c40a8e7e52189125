//! Realistic plans of any size: several supervisors, inputs and outputs, comments, and edges to and
//! fro.

use std::fmt::Write;

/// Data entries; each actor writes one and reads another.
const ENTRIES: usize = 50;

/// A supervisor with many ports, used by one actor in six like in the paper's plan.
const LANE: &str =
    "CheckDrivingLane(distance = walldist, clearance = 10 cm, margin = 10 cm, halfwidth = 25 cm)";

/// The text of a plan with that many actors, about 280 bytes each; the paper's plan has 255.
pub fn text(actors: usize) -> String {
    written(actors, |actor| {
        let turn = actor / 3 * 3 + 2;
        [(actor + 1) % actors, if turn < actors { turn } else { 2 }]
    })
}

/// A plan in which any actor may lead to any other; it is always the same.
pub fn random(actors: usize) -> String {
    let mut state = 1_u64;
    let mut draw = move || {
        // Knuth's generator MMIX; the upper bits are the random ones.
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % actors
    };
    written(actors, |_| [draw(), draw()])
}

/// The text of a plan; `targets` gives the targets of an actor's success and of its other states.
fn written(actors: usize, mut targets: impl FnMut(usize) -> [usize; 2]) -> String {
    let mut text = String::from("use carbot\n\n/// Drives here and there.\nplan Big {\n");
    text += "    in walldist: length = 30 cm\n";
    // Writing to a string cannot fail.
    for entry in 0..ENTRIES {
        let _ = writeln!(text, "    var angle{entry}: angle = {entry} deg");
    }
    text += "\n    start drive0\n\n    supervise escape: CheckEscapeButton {\n";
    text += "        EscapeButtonPressed -> terminate\n    }\n";
    for actor in 0..actors {
        actor_text(&mut text, actor, targets(actor));
    }
    text += "}\n";
    text
}

fn actor_text(text: &mut String, actor: usize, [next, turn]: [usize; 2]) {
    let lane = match actor % 6 {
        0 => format!("        supervise lane{actor}: {LANE} {{ LaneNotFree -> drive{turn} }}\n"),
        _ => String::new(),
    };
    let entry = actor % ENTRIES;
    let _ = match actor % 3 {
        0 => writeln!(
            text,
            "
    // Drives ahead, unless an obstacle is in the way.
    actor drive{actor}: Forward(distance = 2 * walldist + {actor} mm, speed = 20 cm/s) {{
        supervise touch{actor}: CheckTouchSensor every 5 ms {{
            TouchSensorPressed -> drive{turn}
        }}
{lane}        ForwardSuccessful -> drive{next}
    }}"
        ),
        1 => writeln!(
            text,
            "
    actor drive{actor}: SearchWall(sweep = 60 deg, range = walldist * 5, angle => angle{entry}) {{
        supervise touch{actor}: CheckTouchSensor every 10 ms deadline 5 ms {{
            TouchSensorPressed -> drive{turn}
            DeadlineMissed     -> terminate
        }}
        WallFound   -> drive{next} // there it is
        NoWallFound -> drive{turn}
        Error       -> terminate
    }}"
        ),
        _ => writeln!(
            text,
            "
    actor drive{actor}: Turn(angle = angle{entry} / 2 - 5 deg) {{
        TurnSuccessful -> drive{next}
    }}"
        ),
    };
}
