//! Plans for the tests of drawings.

use std::fmt::Write;

use afp_dsl::Toolboxes;
use afp_dsl::{Compiled, compile};
use afp_syntax::source::Source;

/// The plan of the paper.
pub(super) const WALL_FOLLOWING: &str = include_str!("../../../plans/wall_following.afp");

/// A plan with a sub-plan, a computation, `Error` and `DeadlineMissed` edges and an ignored event.
pub(super) const EVERY_PART: &str = include_str!("../tests/draw/every_part.afp");

/// Compiles a plan without errors.
pub(super) fn compiled(text: &str) -> Compiled {
    compiled_with(&Source::new("sample.afp", text), &[])
}

/// Compiles a plan that needs more toolboxes than the built-in ones. Its name is a path for finding
/// the used files.
pub(super) fn compiled_with(source: &Source, toolbox_texts: &[String]) -> Compiled {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    for text in toolbox_texts {
        toolboxes.add(Source::new("more.afp", text.as_str()), "more");
    }
    let read = |path: &str| std::fs::read_to_string(path).map_err(|error| error.to_string());
    let compiled = compile(source, &toolboxes, &read);
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    compiled
}

/// A plan of `count` elements of every kind, with entries, two global supervisors and two
/// sub-plans. The edges are random but reproducible; each element leads to the next one.
pub(super) fn generated(count: u64, seed: u64) -> String {
    let mut state = seed;
    let mut next = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) % below
    };
    let mut text = HEAD.to_owned();
    for index in 0..count {
        // Mostly forwards, like real plans.
        let mut any = || match next(10) {
            0 => "terminate".to_owned(),
            1 => format!("fail \"no {index}\""),
            2 | 3 => format!("element{}", next(count)),
            _ => format!("element{}", (index + 1 + next(3)) % count),
        };
        let onwards = format!("element{}", (index + 1) % count);
        let element = element(index, &onwards, [any(), any(), any()]);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{element}");
    }
    format!("{text}}}\n{SUB_PLANS}")
}

const HEAD: &str = "use std\nuse carbot\nplan Generated {\nin walldist: length = 30 cm\n\
    var round: int = 0\nconst limit: int = 4\nout result: angle\nstart element0\n\
    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }\n\
    supervise tired: CheckTimeout(duration = 90 s) { TimedOut -> element0 }\n";

const SUB_PLANS: &str = "/// Back up and turn away.\nplan Avoid {\nin backwards: length\nout turned: angle\n\
    start back\nsupervise touch: CheckTouchSensor { TouchSensorPressed -> terminate }\n\
    actor back: Forward(distance = backwards) { ForwardSuccessful -> away }\n\
    actor away: SearchWall(angle => turned) { WallFound -> terminate NoWallFound -> nap }\n\
    subplan nap: Nap { OK -> back }\n}\n\
    plan Nap { start wait actor wait: Wait(duration = 2 s) { Elapsed -> terminate } }\n";

fn element(index: u64, onwards: &str, [one, two, three]: [String; 3]) -> String {
    let guards = match index % 3 {
        0 => format!(
            "supervise touch: CheckTouchSensor {{ TouchSensorPressed -> {one} \
             DeadlineMissed -> {two} }}\n"
        ),
        1 => format!(
            "supervise near: CheckValue(value = walldist, limit = 2 * walldist + 5 cm) {{ \
             Below -> {}, Above -> {three} }}\n",
            if index.is_multiple_of(2) { "ignore" } else { "resume" }
        ),
        _ => String::new(),
    };
    match index % 6 {
        0 => format!(
            "actor element{index}: Forward(distance = -walldist) {{ {guards} \
             ForwardSuccessful -> {onwards}, Error -> {two} }}"
        ),
        1 => format!(
            "actor element{index}: SearchWall(angle => result) {{ {guards} \
             WallFound -> {onwards}, NoWallFound -> {one} }}"
        ),
        2 => format!(
            "actor element{index}: WallForward(walldist = walldist, gain = 2) {{ {guards} \
             ForwardSuccessful -> {onwards}, LaneNotFree -> {one}, WallLost -> {two} }}"
        ),
        3 => format!(
            "computation element{index}: Compare(left = walldist, right = 1 m) {{ \
             Less -> {onwards}, Equal -> {one}, Greater -> {three} }}"
        ),
        4 => format!(
            "subplan element{index}: Avoid(backwards = -walldist / 4, turned => result) {{ \
             {guards} OK -> {onwards}, Interrupted -> {two} }}"
        ),
        _ => format!(
            "computation element{index}: Count(value = round, limit = limit, next => round) {{ \
             Again -> {onwards}, Done -> {one} }}"
        ),
    }
}

/// Whether a file declares a toolbox.
pub(super) fn is_toolbox(text: &str) -> bool {
    text.lines().any(|line| line.starts_with("toolbox "))
}

/// All `.afp` files below a folder, except generated ones.
pub(super) fn afp_files(folder: &str) -> Vec<std::path::PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![std::path::PathBuf::from(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.extension() {
                _ if path.is_dir() && !path.ends_with("target") => folders.push(path),
                Some(extension) if extension == "afp" => found.push(path),
                _ => {}
            }
        }
    }
    found
}
