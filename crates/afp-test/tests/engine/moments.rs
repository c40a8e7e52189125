//! Lines relative to a moment of the run: `from go active { ... }`.

use super::{breaks, passes, run};

#[test]
fn times_count_from_the_moment() {
    passes(
        "from nested.turn active {
            at 200 ms: fire nested.turn.touch.TouchSensorPressed
            expect nested.turn -> terminate once within 10 ms after 200 ms
            never nested.turn -> terminate before 200 ms
            until 1 s
        }
        expect running before 2 s",
    );
}

#[test]
fn a_moment_within_another_comes_after_it() {
    let verdict = run("from go active {
            at 1 s: fire go.touch.TouchSensorPressed
            from back active {
                at 100 ms: finish back.ForwardSuccessful
                expect back.ForwardSuccessful once within 5 ms after 100 ms
                from commit by count { until 10 ms }
            }
        }");
    assert!(verdict.passed(), "{}", verdict.report());
    assert!((1.1..1.2).contains(&verdict.end.as_secs_f64()), "{}", verdict.end.as_secs_f64());
}

#[test]
fn a_moment_is_an_occurrence_or_a_state() {
    passes("from robot.pose.x > 1 m { expect go active always before 1 ms  until 10 ms }");
    passes(
        "from go -> back by touch { expect back active within 1 ms  until 1 s }
        at 500 ms: fire go.touch.TouchSensorPressed",
    );
    passes("from end { expect standing within 1 s }  at 1 s: press escape");
}

#[test]
fn a_missing_moment_is_reported_once() {
    breaks(
        "from back active {
            at 1 s: press touch
            never collision
            expect back active always before 1 s
            from go active { expect end }
        }
        until 2 s",
        "that never came",
        2.0,
    );
}

#[test]
fn actions_after_the_end_are_not_performed() {
    breaks(
        "from end { at 3 s: press touch }  at 500 ms: press escape  expect end",
        "this did not happen: the run was over",
        1.5,
    );
}
