//! Runs on several threads: equal outcomes, isolated panics, cancelled sweeps.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use afp::load::Registry;
use afp_carbot::devices::Navigator;
use afp_core::{Actor, Duration, Fault, Instant, Poll};
use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_run::RunError;
use afp_session::AnySession;
use afp_sim::Simulation;
use afp_sweep::{Ending, Engine, Outcome, Row, Setting, Sweep, WorldChoice, axis, seeds};
use afp_syntax::source::Source;

mod templates {
    afp_macros::toolbox!("../afp-run/tests/panicking.afp", robot: super::Navigator);
}

#[derive(Clone)]
struct Panics(Instant);

impl<E: Navigator + ?Sized> Actor<templates::Panics, E> for Panics {
    fn start(_: templates::panics::Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Panics(now))
    }

    fn poll(
        &mut self,
        _: templates::panics::Live,
        _: &mut E,
        now: Instant,
    ) -> Result<Poll<templates::panics::State>, Fault> {
        assert!(now.since(self.0).as_secs_f64() < 1.0, "this component is broken");
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }
}

const PLAN: &str = "use panicking
use carbot
plan Either {
    in way: length = 5 m
    start ahead
    actor ahead: Forward(distance = way) { ForwardSuccessful -> broken }
    actor broken: Panics() { Never -> terminate }
}";

fn compiled() -> Compiled {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    toolboxes.add(Source::new("panicking.afp", templates::SOURCE), "panicking");
    let compiled =
        afp_dsl::compile(&Source::new("either.afp", PLAN), &toolboxes, &Texts::default());
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    compiled
}

fn sweep() -> Sweep {
    Sweep {
        caveat: None,
        presses: Vec::new(),
        failures: Vec::new(),
        plan: "either.afp".to_owned(),
        worlds: vec![WorldChoice::Named("random:4".to_owned())],
        worlds_by_seed: false,
        axes: vec![axis("way=5cm,5m").unwrap()],
        seeds: seeds("0..6").unwrap(),
        until: Duration::from_secs(4),
    }
}

fn register(registry: &mut Registry<Simulation>) {
    templates::register(registry);
}

/// Runs everything with a test's function and returns the outcomes by number.
fn run(
    jobs: usize,
    stop: &AtomicBool,
    before: impl Fn(&Row<'_>) + Sync,
    mut each: impl FnMut(&Outcome) -> bool,
) -> Vec<Outcome> {
    let (compiled, mut sweep) = (compiled(), sweep());
    let graph = compiled.graph.as_ref().unwrap();
    let robot = afp_sim::carbot(register);
    let setting = Setting::new(&mut sweep, graph, Path::new("either.afp"), &robot).unwrap();
    let maker = |row: &Row<'_>| -> Result<Box<dyn AnySession>, RunError> {
        before(row);
        setting.make(row)
    };
    let runs: Vec<u64> = (0..sweep.len()).collect();
    let mut outcomes = Vec::new();
    Engine { sweep: &sweep, maker: &maker, jobs, stop, watch: None }.run(&runs, |mut outcome| {
        outcome.took_s = 0.0;
        let go_on = each(&outcome);
        outcomes.push(outcome);
        go_on
    });
    outcomes.sort_by_key(|outcome| outcome.run);
    outcomes
}

#[test]
fn a_panicking_component_ends_only_its_run() {
    let stop = AtomicBool::new(false);
    let outcomes = run(2, &stop, |_| {}, |_| true);
    assert_eq!(outcomes.len(), 12);
    for outcome in &outcomes[..6] {
        assert_eq!((outcome.ending, &*outcome.place), (Ending::Error, "broken"), "{outcome:?}");
        assert!(outcome.why.starts_with("panic: this component is broken ("), "{}", outcome.why);
    }
    for outcome in &outcomes[6..] {
        assert_eq!((outcome.ending, &*outcome.place), (Ending::TimeLimit, "ahead"));
        assert_eq!((outcome.time_s, outcome.trace.len()), (4.0, 16));
    }
    assert_eq!(run(5, &stop, |_| {}, |_| true), outcomes);
}

#[test]
fn a_panic_outside_of_the_plan_is_an_outcome_too() {
    let stop = AtomicBool::new(false);
    let outcomes = run(2, &stop, |row| assert_ne!(row.run, 7, "no seven"), |_| true);
    assert_eq!(outcomes.len(), 12);
    assert_eq!(outcomes[7].ending, Ending::Panicked);
    assert!(outcomes[7].why.contains("no seven"), "{}", outcomes[7].why);
    assert_eq!(outcomes[8].ending, Ending::TimeLimit);
}

#[test]
fn a_sweep_is_cancelled_from_both_ends() {
    let stop = AtomicBool::new(false);
    let some = run(1, &stop, |_| {}, |outcome| outcome.run < 2);
    assert_eq!(some.iter().map(|outcome| outcome.run).collect::<Vec<_>>(), [0, 1, 2]);
    let off = |row: &Row<'_>| stop.store(row.run == 3, Ordering::Relaxed);
    let some = run(1, &stop, off, |_| true);
    assert_eq!(some.len(), 3, "the run that was going on leaves no outcome");
}
