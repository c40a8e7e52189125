//! Plans of any size that look like plans somebody wrote: several supervisors, data in and out,
//! comments, and edges back and forth.

use std::fmt::Write;

/// Data entries; each actor writes one and reads another.
const ENTRIES: usize = 50;

/// A supervisor with many ports, which one actor in six has, as in the plan of the paper.
const LANE: &str =
    "CheckDrivingLane(distance = walldist, clearance = 10 cm, margin = 10 cm, halfwidth = 25 cm)";

/// The text of a plan with that many actors, about 280 bytes each; the plan of the paper has 255.
pub fn text(actors: usize) -> String {
    let mut text = String::from("use carbot\n\n/// Drives here and there.\nplan Big {\n");
    text += "    in walldist: length = 30 cm\n";
    // Writing to a string cannot fail.
    for entry in 0..ENTRIES {
        let _ = writeln!(text, "    var angle{entry}: angle = {entry} deg");
    }
    text += "\n    start drive0\n\n    supervise escape: CheckEscapeButton {\n";
    text += "        EscapeButtonPressed -> terminate\n    }\n";
    for actor in 0..actors {
        actor_text(&mut text, actor, actors);
    }
    text += "}\n";
    text
}

fn actor_text(text: &mut String, actor: usize, actors: usize) {
    let next = (actor + 1) % actors;
    let turn = actor / 3 * 3 + 2;
    let turn = if turn < actors { turn } else { 2 };
    let lane = match actor % 6 {
        0 => format!("        supervise lane{actor}: {LANE} {{ LaneNotFree -> drive{turn} }}\n"),
        _ => String::new(),
    };
    let entry = actor % ENTRIES;
    let _ = match actor % 3 {
        0 => writeln!(
            text,
            "
    // Ahead, unless something stands there.
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
