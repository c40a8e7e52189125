//! A panic fails only its own scenario, and the verdict contains its message.

use std::path::Path;

use afp::load::Graph;
use afp_carbot::devices::Navigator;
use afp_core::{Actor, Fault, Instant, Poll};
use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_run::RunError;
use afp_session::{AnyRobot, AnySession, AnyWorld, Loader, SessionError};
use afp_syntax::source::Source;
use afp_test::{Setting, Verdict};

use super::robot;

mod templates {
    afp_macros::toolbox!("../afp-run/tests/panicking.afp", robot: super::Navigator);
}

#[derive(Clone)]
struct Panics;

impl<E: Navigator + ?Sized> Actor<templates::Panics, E> for Panics {
    fn start(_: templates::panics::Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(Panics)
    }

    fn poll(
        &mut self,
        _: templates::panics::Live,
        _: &mut E,
        _: Instant,
    ) -> Result<Poll<templates::panics::State>, Fault> {
        panic!("this component is broken");
    }

    fn interrupt(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }
}

/// A robot that panics when it is made.
struct Broken<L>(L);

impl<L: Loader> Loader for Broken<L> {
    fn kind(&self) -> &dyn AnyRobot {
        self.0.kind()
    }

    fn session(
        &self,
        _: &Graph,
        _: &dyn AnyWorld,
        _: u64,
        _: &[&str],
    ) -> Result<Box<dyn AnySession>, SessionError> {
        panic!("the mast is missing");
    }
}

fn compiled(expected: &str) -> Compiled {
    let text = format!(
        "use panicking
plan Ahead {{
    start go
    actor go: Panics() {{ Never -> terminate }}
}}
scenario \"it\" for Ahead {{
    expect {expected}
}}
"
    );
    let mut toolboxes = Toolboxes::default();
    toolboxes.add(Source::new("panicking.afp", templates::SOURCE), "panicking");
    afp_dsl::compile(&Source::new("case.afp", text), &toolboxes, &Texts::default())
}

fn run(expected: &str, robot: &dyn Loader) -> Result<Verdict, RunError> {
    let compiled = compiled(expected);
    let [scenario] = compiled.scenarios.as_slice() else { panic!("{}", compiled.render(false)) };
    let setting = Setting::find(scenario, Path::new("case.afp"), robot.kind()).unwrap();
    afp_test::run(scenario, &setting, robot, None)
}

#[test]
fn a_robot_that_panics_fails_its_scenario() {
    let error = run("end", &Broken(robot())).unwrap_err();
    assert_eq!(error.code(), afp_run::EXIT_PLAN_ERROR);
    let said = error.to_string();
    assert!(said.contains("panicked") && said.contains("the mast is missing ("), "{said}");
    assert!(said.contains("engine/panics.rs:"), "{said}");
}

#[test]
fn the_report_has_the_message_of_a_panic() {
    let robot = afp_sim::carbot(templates::register);
    let verdict = run("end by OK", &robot).unwrap();
    let report = verdict.report();
    assert!(report.contains("  panicked: this component is broken ("), "{report}");
    let verdict = run("end by Error", &robot).unwrap();
    assert!(verdict.passed(), "{}", verdict.report());
}
