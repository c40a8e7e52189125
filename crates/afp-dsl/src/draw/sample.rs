//! Plans for the tests of drawings.

use std::fmt::Write;

use crate::files::Texts;
use crate::source::Source;
use crate::toolbox::Toolboxes;
use crate::{Compiled, compile};

/// The plan of the paper.
pub(super) const WALL_FOLLOWING: &str = include_str!("../../../../plans/wall_following.afp");

/// A plan with a sub-plan, a computation, `Error` and `DeadlineMissed` edges and an ignored event.
pub(super) const EVERY_PART: &str = include_str!("../../tests/draw/every_part.afp");

/// Compiles a plan that has no errors.
pub(super) fn compiled(text: &str) -> Compiled {
    let mut toolboxes = Toolboxes::default();
    for builtin in afp_toolboxes::ALL {
        toolboxes.add(Source::new(builtin.file_name, builtin.text), builtin.rust_path);
    }
    let compiled = compile(&Source::new("sample.afp", text), &toolboxes, &Texts::default());
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    compiled
}

/// A plan of `count` elements, wired at random but the same each time; each leads to the next one.
pub(super) fn generated(count: u64, seed: u64) -> String {
    let mut state = seed;
    let mut next = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) % below
    };
    let mut text = "use std\nuse carbot\nplan Generated {\nin walldist: length = 30 cm\n\
                    out result: angle\nstart element0\n\
                    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }\n"
        .to_owned();
    for index in 0..count {
        // Mostly onwards, as plans are.
        let mut any = || match next(10) {
            0 | 1 => "terminate".to_owned(),
            2 | 3 => format!("element{}", next(count)),
            _ => format!("element{}", (index + 1 + next(3)) % count),
        };
        let onwards = format!("element{}", (index + 1) % count);
        let (one, two, three) = (any(), any(), any());
        let guards = match index % 3 {
            0 => format!(
                "supervise touch: CheckTouchSensor {{ TouchSensorPressed -> {one} \
                 DeadlineMissed -> {two} }}\n"
            ),
            1 => format!(
                "supervise near: CheckValue(value = walldist, limit = 2 * walldist + 5 cm) {{ \
                 Below -> ignore, Above -> {three} }}\n"
            ),
            _ => String::new(),
        };
        let element = match index % 4 {
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
            _ => format!(
                "computation element{index}: Compare(left = walldist, right = 1 m) {{ \
                 Less -> {onwards}, Equal -> {one}, Greater -> {three} }}"
            ),
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{element}");
    }
    text + "}\n"
}
