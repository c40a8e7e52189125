//! Scenarios about edges to `fail` and to `resume`.

use super::{FREE, run_of as run};

const FAILS: &str = r#"
use carbot

plan Ahead {
    start go
    actor go: Forward(distance = 20 cm) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> fail "blocked" }
        ForwardSuccessful -> fail
    }
}
"#;

#[test]
fn a_plan_may_be_expected_to_fail() {
    let verdict = |lines: &str| run(FAILS, &format!("{FREE}{lines}"));
    let pressed = "at 500 ms: press touch until 5 s";
    for lines in [
        format!("expect go -> fail by touch expect end by go.touch expect end by Error {pressed}"),
        format!("expect end by Error {pressed}"),
        "expect end by go.ForwardSuccessful expect end by Error until 5 s".into(),
    ] {
        let verdict = verdict(&lines);
        assert!(verdict.passed(), "{lines}: {}", verdict.report());
    }
    let broken = verdict(&format!("expect go -> fail by ForwardSuccessful {pressed}"));
    let report = broken.report();
    assert!(!broken.passed() && report.contains("blocked"), "{report}");
}

const RESUMES: &str = r#"
use carbot
use std

plan Ahead {
    start go
    var seconds: int = 0
    actor go: Forward(distance = 10 m) {
        supervise tick: Every(period = 1 s) { Due -> count }
        supervise touch: CheckTouchSensor { TouchSensorPressed -> resume }
        ForwardSuccessful -> terminate
    }
    computation count: Count(value = seconds, limit = 3, next => seconds) {
        Again -> resume
        Done  -> terminate
    }
}
"#;

#[test]
fn events_that_resume_may_be_expected() {
    let verdict = |lines: &str| run(RESUMES, &format!("{FREE}{lines} until 5 s"));
    for lines in [
        "expect go -> count by tick once within 50 ms after 1 s expect end by count.Done",
        "expect count -> resume once within 50 ms after 2 s never interrupt of go within 900 ms after 2 s",
        "at 500 ms: fire go.touch.TouchSensorPressed expect go -> resume by touch within 50 ms after 500 ms",
    ] {
        let verdict = verdict(lines);
        assert!(verdict.passed(), "{lines}: {}", verdict.report());
    }
    assert!(!verdict("expect go -> resume by touch").passed());
}
