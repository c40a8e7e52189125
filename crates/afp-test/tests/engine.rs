//! Verdicts of scenarios: each kind of claim kept and broken, stimuli, faults, repeated runs.

#[path = "engine/edges.rs"]
mod edges;
#[path = "engine/endings.rs"]
mod endings;
#[path = "engine/generation.rs"]
mod generation;
#[path = "engine/moments.rs"]
mod moments;
#[path = "engine/panics.rs"]
mod panics;

use std::path::Path;

use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_session::Loader;
use afp_syntax::source::Source;
use afp_test::{Setting, Verdict};

const PLAN: &str = r#"
use carbot
use std

plan Ahead {
    in way: length = 1 m
    var gone: length = 0 m
    var i: int = 0
    start go
    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }
    actor go: Forward(distance = way, driven => gone) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> back }
        ForwardSuccessful -> count
    }
    computation count: Count(value = i, limit = 1, next => i) { Again -> nested, Done -> terminate }
    actor back: Forward(distance = -10 cm) { ForwardSuccessful -> count }
    subplan nested: Nested(way = 20 cm) { OK -> count, Interrupted -> terminate }
}

plan Nested {
    in way: length
    start turn
    actor turn: Forward(distance = way) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> terminate }
        ForwardSuccessful -> terminate
    }
}
"#;

fn robot() -> impl Loader {
    afp_sim::carbot(|_| {})
}

fn compiled(plan: &str, lines: &str) -> Compiled {
    let text = format!("{plan}\nscenario \"it\" for Ahead {{\n{lines}\n}}\n");
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let source = Source::new("case.afp", text);
    let compiled = afp_dsl::compile(&source, &toolboxes, &Texts::default());
    assert!(!compiled.scenarios.is_empty(), "{}", compiled.render(false));
    compiled
}

fn run(lines: &str) -> Verdict {
    run_of(PLAN, lines)
}

/// The verdict on a plan `Ahead`.
fn run_of(plan: &str, lines: &str) -> Verdict {
    let compiled = compiled(plan, lines);
    let [scenario] = compiled.scenarios.as_slice() else { panic!("{}", compiled.render(false)) };
    let setting = Setting::find(scenario, Path::new("case.afp"), robot().kind()).unwrap();
    afp_test::run(scenario, &setting, &robot(), None).unwrap()
}

#[track_caller]
fn passes(lines: &str) {
    let verdict = run(lines);
    assert!(verdict.passed(), "{}", verdict.report());
}

/// Expects one broken line with that reason and time.
#[track_caller]
fn breaks(lines: &str, why: &str, at: f64) {
    let verdict = run(lines);
    let [broken] = verdict.broken.as_slice() else { panic!("{:?}", verdict.broken) };
    assert!(broken.why.contains(why), "{broken:?}");
    assert!((broken.at.as_secs_f64() - at).abs() < 1e-6, "{broken:?}");
}

/// The robot has two metres of free space to the east.
const FREE: &str = "robot at (3.5 m, 2.4 m) heading 0 deg\n";

#[test]
fn an_unreached_expectation_fails() {
    let short = format!("{FREE} at 1 s: press escape\n expect end\n until 40 s\n");
    // The robot rests for a second after the end of its plan.
    breaks(
        &format!("{short} at 30 s: press touch"),
        "did not happen: the run was over at 2.000 s",
        2.0,
    );
    breaks(&format!("{short} at 30 s: fail wheels.slip"), "did not happen: the run was over", 2.0);
    for claim in [
        "collision",
        "halted",
        "robot.pose.x > 1 m",
        "way == 1 m",
        "way < gone",
        "go active",
        "running",
    ] {
        for line in ["never C", "expect C", "expect C always"] {
            let line = line.replace('C', claim);
            breaks(&format!("{short} {line} after 15 s"), "that time never came", 2.0);
        }
    }
    for claim in
        ["go -> back", "go.ForwardSuccessful", "interrupt of go", "commit by go", "end by OK"]
    {
        for line in ["never C", "expect C", "expect C once", "expect C 2 times"] {
            // An earlier claim gives the time.
            if !(claim == "interrupt of go" && line == "expect C") {
                let line = line.replace('C', claim);
                breaks(&format!("{short} {line} after 15 s"), "that time never came", 2.0);
            }
        }
    }
    passes(&format!("{short} never running after 2 s\n never collision after 500 ms before 30 s"));
}

#[test]
fn each_kind_of_claim_can_hold() {
    passes(&format!(
        "{FREE} set way = 20 cm
        expect go -> count by ForwardSuccessful before 10 s
        expect go.ForwardSuccessful
        expect count.Again
        expect count -> nested
        expect nested active after 1 s
        expect nested.turn active
        expect nested.way == 20 cm
        expect i == 1
        expect i <= 1 always
        expect i < 1.5 always
        expect i == 1.0
        never i == 0.7
        expect i < battery.left
        expect gone > 19 cm
        expect count -> terminate by Done
        expect end by count.Done
        expect end by OK
        expect running before 1 s
        expect count.Again once
        expect count -> nested by Again 1 times
        expect commit by go once
        expect commit of gone by go 1 times
        expect commit of i by count 2 times
        never commit by go before 1 s
        never interrupt of go
        never halted within 100 ms after 50 ms
        expect halted before 20 s
        never standing within 100 ms after 500 ms
        expect standing always after 3.5 s
        never running after 3.5 s
        never collision
        expect robot.pose.x != 0 m always
        expect robot.standing == false within 1 s after 500 ms
        expect ultrasonic.echo.distance > 1 cm
        expect battery.left <= 1 always
        never battery.left < 0.5
        expect gone < way
        expect gone <= nested.way
        never back active
        until 30 s"
    ));
}

#[test]
fn a_silent_signal_has_no_value() {
    const PLAN: &str = r#"
use carbot
use std
plan Ahead {
    start beep
    actor beep: Signal(tone = 880 Hz, times = 1) { Signalled -> rest }
    actor rest: Wait(duration = 10 s) { Elapsed -> terminate }
}
"#;
    let verdict = |lines: &str| run_of(PLAN, lines);
    let kept = verdict("expect signals.tone == 880 Hz\n never signals.tone > 800 Hz after 2 s");
    assert!(kept.passed(), "{}", kept.report());
    let broken = verdict("expect signals.tone > 800 Hz after 5 s").broken;
    assert!(broken[0].why.contains("in the end it is nothing"), "{broken:?}");
}

#[test]
fn each_kind_of_claim_can_fail() {
    breaks("expect go -> back before 100 ms\n until 1 s", "did not happen", 0.099_999_999);
    breaks("expect back active before 1 s", "did not happen", 0.999_999_999);
    breaks("at 1 s: press touch\n never go -> back by touch", "it held", 1.0);
    breaks("at 1 s: press touch\n expect go active always\n until 2 s", "did not hold", 1.0);
    breaks("at 1 s: press touch\n expect go -> back within 2 ms after 1.5 s", "at 1.000 s", 1.502);
    breaks("expect way == 2 m\n until 1 s", "in the end it is 1 m", 1.0);
    breaks("at 1 s: set way = 2 m\n expect way == 1 m always\n until 2 s", "it is 2 m", 1.0);
    breaks("at 1 s: press escape\n expect end by OK", "as Interrupted", 2.0);
    breaks("expect end before 1 s\n until 1 s", "did not end", 0.999_999_999);
    breaks("expect collision before 1 s", "it did not hold", 0.999_999_999);
    breaks(
        "at 1 s: press touch\n expect interrupt of go 2 times\n until 2 s",
        "once, at 1.000",
        2.0,
    );
    breaks("at 1 s: press touch\n expect commit by go once\n until 2 s", "did not happen", 2.0);
    breaks("expect halted always\n until 2 s", "it did not hold", 0.01);
    breaks("expect standing after 1 s\n until 2 s", "it did not hold", 2.0);
    breaks("expect robot.pose.x > 90 m\n until 2 s", "it did not hold; in the end it is", 2.0);
    breaks("expect way < gone\n until 1 s", "in the end it is 1 m, compared with ", 1.0);
    breaks("never robot.pose.x > -90 m after 1 s\n until 2 s", "it held", 1.0);
    breaks("at 1 s: press escape\n expect running always\n until 5 s", "did not hold", 1.0);
}

#[test]
fn messages_show_values_like_the_timeline() {
    let plan = r#"
        use carbot
        enum Lamp { red, green }
        plan Ahead {
            in lamp: Lamp = Lamp.red
            var other: Lamp = Lamp.green
            var word: string = "on"
            var way: length = 20 cm
            start go
            supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }
            subplan go: Inner(lamp) { OK -> terminate, Interrupted -> terminate }
        }
        plan Inner {
            in lamp: Lamp
            start wait
            actor wait: Forward(distance = 1 m) { ForwardSuccessful -> terminate }
        }"#;
    for (claim, is) in [
        ("lamp == Lamp.green", "Lamp.red"),
        ("other == Lamp.red", "Lamp.green"),
        ("lamp == other", "Lamp.red, compared with Lamp.green"),
        ("go.lamp == Lamp.green", "Lamp.red"),
        ("word == \"off\"", "\"on\""),
        ("way < 10 cm", "20 cm"),
    ] {
        let verdict = run_of(plan, &format!("expect {claim} always after 10 ms\n until 1 s"));
        let whys: Vec<_> = verdict.broken.iter().map(|broken| broken.why.as_str()).collect();
        assert_eq!(whys, [format!("it did not hold; in the end it is {is}")], "{claim}");
    }
}

#[test]
fn presses_that_overlap_hold_until_the_last_one_ends() {
    let plan = "use carbot
        use std
        plan Ahead {
            start wait
            actor wait: Wait(duration = 10 s) { Elapsed -> terminate }
        }";
    for (lines, pressed, released) in [
        ("at 1 s: press touch for 500 ms\n at 1.1 s: press touch for 100 ms", "1.25 s", "1.5 s"),
        ("at 1.1 s: press touch for 100 ms\n at 1 s: press touch for 500 ms", "1.25 s", "1.5 s"),
        ("at 1 s: press touch\n at 1.1 s: press touch", "1.25 s", "1.3 s"),
        ("at 1 s: press touch for 3 s\n at 1.3 s: release touch", "1.2 s", "1.3 s"),
    ] {
        let claims = format!(
            "expect touch.touched always after 1.01 s before {released}
            expect touch.touched after {pressed} before {released}
            never touch.touched after {released} before 2 s
            until 2 s"
        );
        let verdict = run_of(plan, &format!("{lines}\n{claims}"));
        assert!(verdict.passed(), "{lines}\n{}", verdict.report());
    }
    let late = run_of(plan, "expect wait active\n at 11.5 s: release touch\n until 12 s");
    assert!(
        late.broken.iter().any(|it| it.why.contains("this did not happen")),
        "{}",
        late.report()
    );
}

#[test]
fn outcomes_are_injected_at_the_next_poll_and_traced() {
    let lines = format!(
        "{FREE} at 1.004 s: finish go.ForwardSuccessful(driven = 7 m)
        at 2 s: fire nested.turn.touch.TouchSensorPressed
        expect gone == 7 m after 1.1 s
        expect go -> count within 6 ms after 1.004 s
        expect nested -> terminate by Interrupted within 10 ms after 2 s
        expect end by nested.Interrupted"
    );
    let verdict = run(&lines);
    assert!(verdict.passed(), "{}", verdict.report());
    let traced = verdict.timeline.iter().filter(|(_, line)| line.contains("(injected)")).count();
    assert_eq!(traced, 2);
}

/// A plan that continues after faults and missed deadlines.
const CAREFUL: &str = r#"
use carbot

plan Ahead {
    start go
    actor go: Forward(distance = 1 m) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> terminate, DeadlineMissed -> slow }
        ForwardSuccessful -> terminate
        Error -> back
    }
    actor back: Forward(distance = -10 cm) { ForwardSuccessful -> terminate }
    actor slow: Forward(distance = 10 cm) { ForwardSuccessful -> terminate }
}
"#;

#[test]
fn errors_and_missed_deadlines_are_fired() {
    let run = |lines: &str| {
        let compiled = compiled(CAREFUL, &format!("{FREE} {lines}"));
        let scenario = &compiled.scenarios[0];
        let setting = Setting::find(scenario, Path::new("case.afp"), robot().kind()).unwrap();
        afp_test::run(scenario, &setting, &robot(), None).unwrap()
    };
    let missed = "at 500 ms: fire go.touch.DeadlineMissed
        expect go -> slow by touch.DeadlineMissed once within 20 ms after 500 ms
        expect interrupt of go once within 20 ms after 500 ms
        expect end by slow";
    let failed = "at 500 ms: fire go.Error
        expect go -> back by Error once within 20 ms after 500 ms
        never slow active
        expect end by back";
    for (lines, word) in [(missed, "DeadlineMissed"), (failed, "a test made the component fail")] {
        let verdict = run(lines);
        assert!(verdict.passed(), "{}", verdict.report());
        let text: String = verdict.timeline.iter().map(|(_, line)| format!("{line}\n")).collect();
        assert!(text.contains("(injected)") && text.contains(word), "{text}");
        let (_, expected) = lines.split_once('\n').unwrap();
        assert!(!run(expected).passed(), "it does not happen by itself");
    }
}

#[test]
fn one_scenario_runs_over_seeds_and_worlds() {
    let both = compiled(
        PLAN,
        "over seeds 3..5\n over worlds \"random:7..9\"\n set way = 8 m\n expect running before 100 ms\n until 30 s",
    );
    let names: Vec<_> = both.scenarios.iter().map(|scenario| scenario.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "it (random:7, seed 3)",
            "it (random:7, seed 4)",
            "it (random:8, seed 3)",
            "it (random:8, seed 4)"
        ]
    );
    let traces = both.scenarios.iter().map(|scenario| {
        let setting = Setting::find(scenario, Path::new("tests/case.afp"), robot().kind()).unwrap();
        let verdict = afp_test::run(scenario, &setting, &robot(), None).unwrap();
        assert!(verdict.passed(), "{}", verdict.report());
        verdict.trace
    });
    let traces: std::collections::BTreeSet<_> = traces.collect();
    assert!(traces.len() >= 3, "they are different runs");
}

#[test]
fn a_stale_request_fails_only_its_line() {
    let gone = "expect go -> back by escape\n}\nscenario \"other\" for Ahead {\n expect end";
    let compiled = compiled(PLAN, gone);
    assert!(compiled.graph.is_none(), "the file has an error");
    let [sound] = compiled.scenarios.as_slice() else { panic!("{}", compiled.render(false)) };
    let [invalid] = compiled.invalid.as_slice() else { panic!("{}", compiled.render(false)) };
    assert_eq!((&*sound.name, &*invalid.name, &*invalid.plan), ("other", "it", "Ahead"));
    let why = invalid.errors.render(&compiled.sources, false);
    assert!(
        why.contains("E0603") && why.contains("'escape' does not lead from 'go' to 'back'"),
        "{why}"
    );
    let wrong = PLAN.replace("-> nested,", "-> nowhere,");
    let text = format!("{wrong}\nscenario \"it\" for Ahead {{ {gone} }}\n");
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = afp_dsl::compile(&Source::new("case.afp", text), &toolboxes, &Texts::default());
    assert!(compiled.scenarios.is_empty() && compiled.invalid.is_empty(), "the plan is wrong");
}

#[test]
fn an_inactive_component_cannot_report() {
    let idle = "expect go active\n until 2 s";
    breaks(&format!("at 1 s: finish back.ForwardSuccessful\n {idle}"), "'back' is not", 1.0);
    let nested = "at 1 s: fire nested.turn.touch.TouchSensorPressed\n";
    breaks(&format!("{nested} {idle}"), "'nested.turn.touch' is not active", 1.0);
}

#[test]
fn idle_actors_are_active_and_do_nothing() {
    let lines = format!(
        "{FREE} at 0 s: idle back
        at 1 s: press touch
        expect go -> back by touch
        expect back active before 1.1 s
        expect standing always after 1.5 s
        at 3 s: finish back.ForwardSuccessful
        at 2 s: idle all
        expect nested.turn active always after 3.1 s
        expect halted always after 1.1 s
        until 5 s"
    );
    passes(&lines);
    let moving = run(&lines.replace("idle all", "release touch"));
    let said = |broken: &afp_test::Broken| format!("{}: {}", broken.text, broken.why);
    let whys: Vec<_> = moving.broken.iter().map(said).collect();
    assert_eq!(
        whys[..2],
        [
            "expect halted always after 1.1 s: it did not hold",
            "expect standing always after 1.5 s: it did not hold",
        ]
    );
}

#[test]
fn an_unexpected_error_breaks_a_scenario() {
    let dead = "at 1 s: fail odometry.lost\n";
    let verdict = run(&format!("{FREE} {dead} expect go active"));
    let [broken] = verdict.broken.as_slice() else { panic!("{:?}", verdict.broken) };
    assert!(broken.why.contains("ended in Error"), "{broken:?}");
    passes(&format!("{FREE} {dead} expect end by go.Error"));
}

#[test]
fn a_scenario_repeats_its_run() {
    let lines = "seed 3\n set way = 20 cm\n expect end";
    assert_eq!(run(lines).trace, run(lines).trace);
    assert_ne!(run(lines).trace, run(&lines.replace("seed 3", "seed 4")).trace);
}

#[test]
fn the_report_shows_the_timeline_around_the_failed_claim() {
    let verdict = run("at 1 s: press touch\n never go -> back by touch\n until 3 s");
    let report = verdict.report();
    assert!(report.contains("never go -> back by touch\n    1.000 s: it held\n"), "{report}");
    let (before, behind) = report.split_once("broken here").unwrap();
    assert!(before.contains("TouchSensorPressed → back") && !behind.contains("→ back"), "{report}");
}
