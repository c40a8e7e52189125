//! A panic of a component ends the run in `Error`: the robot is stopped and the log complete.

use afp_carbot::devices::Navigator;
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Actor, Fault, Instant, Poll};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_run::options::RunOptions;
use afp_run::{EXIT_PLAN_ERROR, Extras, Program, run};
use afp_session::{AnyWorld, EndingKind, EventKind, Loader, simulated};
use afp_sim::Simulation;
use afp_syntax::source::Source;
use clap::{Args, Command, FromArgMatches};

mod templates {
    afp_macros::toolbox!("tests/panicking.afp", robot: super::Navigator);
}

#[derive(Clone)]
struct Panics {
    since: Instant,
}

impl<E: Navigator + ?Sized> Actor<templates::Panics, E> for Panics {
    fn start(_: templates::panics::Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Panics { since: now })
    }

    fn poll(
        &mut self,
        _: templates::panics::Live,
        env: &mut E,
        now: Instant,
    ) -> Result<Poll<templates::panics::State>, Fault> {
        assert!(now.since(self.since).as_secs_f64() < 1.0, "this component is broken");
        env.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0), now);
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }
}

const PLAN: &str = "use panicking
plan Breaks {
    start go
    actor go: Panics() { Never -> terminate }
}";

fn options(arguments: &[&str]) -> RunOptions {
    let command = RunOptions::augment_args(Command::new("test").no_binary_name(true));
    RunOptions::from_arg_matches(&command.get_matches_from(arguments)).unwrap()
}

#[test]
fn a_panic_stops_the_robot_and_ends_the_run() {
    let mut toolboxes = Toolboxes::default();
    toolboxes.add(Source::new("panicking.afp", templates::SOURCE), "panicking");
    let compiled = compile(&Source::new("breaks.afp", PLAN), &toolboxes, &Texts::default());
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let robot = simulated::<Simulation, _>(templates::register);
    let make = |world: &dyn AnyWorld, seed: u64, measures: &[&str]| {
        robot.session(graph, world, seed, measures)
    };
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("a.mcap");
    let program = Program {
        name: "Breaks",
        file: "breaks.afp",
        texts: &[("breaks.afp", PLAN)],
        toolboxes: &[],
        project: "",
        hardware: &[],
    };
    let log_name = log.to_str().unwrap();
    let options = options(&["--json", "--svg", "none", "--log", log_name]);
    assert_eq!(
        run(&program, robot.kind(), Box::new(make), &options, Extras::default()).unwrap(),
        EXIT_PLAN_ERROR
    );
    let log = afp_log::read(&log).unwrap();
    assert_eq!(log.cut_short, None);
    let last = log.events.last().unwrap();
    let EventKind::Ended { ending: EndingKind::Error, fault } = &last.kind else { panic!() };
    assert_eq!(fault.code, "panic");
    let end = last.at.as_secs_f64();
    assert!((0.99..1.02).contains(&end), "{end}");
}
