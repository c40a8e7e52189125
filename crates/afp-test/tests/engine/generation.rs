//! Generation: scenarios for every event, and unreachable elements.

use std::path::Path;

use afp_dsl::scenario::Scenario;
use afp_session::Loader;
use afp_test::Setting;

use super::{PLAN, compiled, robot};

#[test]
fn scenarios_are_made_for_every_event_at_five_points_and_pass() {
    let base = compiled(PLAN, "expect go active\n until 20 s");
    let scenario = &base.scenarios[0];
    let setting = Setting::find(scenario, Path::new("case.afp"), robot().kind()).unwrap();
    let quiet = Scenario::quiet("", scenario.graph.clone(), "case.afp", 30_000_000_000);
    let mut go = |scenario: &Scenario| afp_test::run(scenario, &setting, &robot(), None);
    let made = afp_test::generate(&quiet, robot().kind().devices(), &mut go).unwrap();
    assert_eq!(made.left_out, [""; 0]);
    let text = made.text("case.afp");
    assert!(made.count() >= 15, "{text}");
    assert!(text.contains("expect go -> back by touch.TouchSensorPressed once within"));
    let text = text.split_once("\n\n").unwrap().1;
    let all = compiled(
        PLAN,
        &format!("expect go active }}\n{text}\nscenario \"end\" for Ahead {{ expect go active"),
    );
    assert_eq!(all.scenarios.len(), made.count() + 2);
    for scenario in &all.scenarios {
        let verdict = afp_test::run(scenario, &setting, &robot(), None).unwrap();
        assert!(verdict.passed(), "{}\n{}", scenario.name, verdict.report());
    }
}

#[test]
fn generation_uses_events_and_lists_unreached_elements() {
    const HIDDEN: &str = r#"
use carbot
use std
plan Ahead {
    start go
    actor go: Wait(duration = 5 s) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> aside }
        Elapsed -> terminate
    }
    actor aside: Wait(duration = 2 s) {
        supervise escape: CheckEscapeButton { EscapeButtonPressed -> pick }
        Elapsed -> terminate
    }
    computation pick: Compare(left = 1, right = 2) { Less -> deep, Equal -> never, Greater -> never }
    actor deep: Forward(distance = 1 m) {
        supervise touch: CheckTouchSensor { TouchSensorPressed -> go }
        ForwardSuccessful -> terminate
    }
    actor never: Wait(duration = 1 s) { Elapsed -> terminate }
}
"#;
    let base = compiled(HIDDEN, "expect end");
    let quiet = Scenario::quiet("", base.scenarios[0].graph.clone(), "case.afp", 30_000_000_000);
    let setting = Setting::find(&quiet, Path::new("case.afp"), robot().kind()).unwrap();
    let mut runs = 0;
    let made = afp_test::generate(&quiet, robot().kind().devices(), &mut |scenario: &Scenario| {
        runs += 1;
        afp_test::run(scenario, &setting, &robot(), None)
    });
    let made = made.unwrap();
    assert_eq!(made.left_out, ["no run reached 'never'"]);
    assert!(runs < 20, "{runs} runs");
    let made = made.text("case.afp");
    let (_, deep) = made.split_once("\"deep: touch.TouchSensorPressed at 10 %").unwrap();
    let place = |text: &str| deep.find(text).unwrap();
    assert!(place("fire go.touch.TouchSensorPressed") < place("fire aside.escape.Escape"));
    assert!(place("fire aside.escape.Escape") < place("fire deep.touch.TouchSensorPressed"));
    let (_, text) = made.split_once('\n').unwrap();
    let plan = format!("{}\n{text}", HIDDEN);
    for scenario in compiled(&plan, "expect end").scenarios {
        let verdict = afp_test::run(&scenario, &setting, &robot(), None).unwrap();
        assert!(verdict.passed(), "{}\n{}", scenario.name, verdict.report());
    }
}
