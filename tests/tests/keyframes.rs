//! A copy of a running plan continues like the plan, and the two are independent.

use afp::load::{ActorSlot, LoadedPlan, Registry, See};
use afp_core::rt::{Args, BadValue, Outputs};
use afp_core::trace::{Line, Record, Sink};
use afp_core::{Fault, Instant, NamedPlan, PlanState, Scheduler, Wake};
use afp_tests::case::Case;
use afp_tests::interpret::{graph, load};
use afp_tests::platform::{CostClock, Log, Platform};
use afp_tests::script::Script;

const CASE: &str = r#"// script
//   at 60 ms: g First
//   at 100 ms: a Done
//   at 150 ms: deep Done = 4
//   until 300 ms
use testing

plan P {
    start a
    var polls = 0
    var words: string = "none"
    var map: Map
    supervise g: Watch(name = "g", count => polls) { First -> make  Second -> a  Third -> a }
    actor a: Work(name = "a", label = "seen " + polls, count => polls, text => words) {
        Done -> make
        Other -> a
    }
    computation make: MakeMap(id = polls, map => map) { Done -> inside }
    subplan inside: Inner(map = map, result => polls) { OK -> a  Interrupted -> a }
}

plan Inner {
    start deep
    in map: Map
    out result: int
    actor deep: Work(name = "deep", result => result) {
        supervise near: Glance(name = "near") { Seen -> terminate }
        Done -> read
        Other -> deep
    }
    computation read: ReadMap(map = map) { Done -> terminate }
}
"#;

struct Lines(<LoadedPlan<Platform> as NamedPlan>::Names, Log);

impl Sink for Lines {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.1.note(Line { at, record, names: &self.0 }.to_string());
    }
}

/// A plan on its own platform.
struct Run {
    scheduler: Scheduler<LoadedPlan<Platform>>,
    platform: Platform,
    clock: CostClock,
    sink: Lines,
    wake: Wake,
}

impl Run {
    fn on(scheduler: Scheduler<LoadedPlan<Platform>>, script: &Script, wake: Wake) -> Self {
        let (log, clock) = (Log::default(), CostClock::default());
        let platform = Platform::new(script.clone(), log.clone(), clock.clone());
        let sink = Lines(scheduler.plan().names(), log);
        Run { scheduler, platform, clock, sink, wake }
    }

    /// A copy with a log of its own.
    fn copied(&self) -> Self {
        let (log, clock) = (Log::default(), CostClock::default());
        let scheduler = self.scheduler.try_clone().expect("all components can be copied");
        let platform = self.platform.copied(log.clone(), clock.clone());
        let sink = Lines(scheduler.plan().names(), log);
        Run { scheduler, platform, clock, sink, wake: self.wake }
    }

    fn until(&mut self, end: u64) -> Vec<String> {
        let before = self.sink.1.lines().len();
        while let Wake::At(at) = self.wake
            && at <= Instant::from_nanos(end * 1_000_000)
        {
            let on = (&mut self.platform, &mut self.sink, &self.clock);
            self.wake = self.scheduler.step(on, at);
        }
        self.sink.1.lines()[before..].to_vec()
    }
}

#[test]
fn a_copy_during_a_run_continues_like_its_original() {
    let case = Case::parse(CASE).expect("the script can be read");
    let graph = graph("keyframes", &case.plan).unwrap_or_else(|errors| panic!("{errors}"));
    for at in [0, 10, 55, 60, 100, 110, 145, 150, 160] {
        let mut run = Run::on(Scheduler::new(load(&graph)), &case.script, Wake::At(Instant::ZERO));
        let on = (&mut run.platform, &mut run.sink, &run.clock);
        run.wake = run.scheduler.start(on, Instant::ZERO).expect("nothing is missing");
        run.until(at);
        let mut copy = run.copied();
        let (first, second) = (run.until(300), copy.until(300));
        assert!(first.len() > 10, "{first:#?}");
        assert_eq!(first, second, "copied at {at} ms");
    }
}

/// An actor in another language.
struct Foreign;

impl ActorSlot<Platform> for Foreign {
    fn start(
        &mut self,
        _: &dyn Args,
        _: See<'_>,
        _: &mut Platform,
        _: Instant,
    ) -> Result<(), BadValue> {
        Ok(())
    }

    fn poll(
        &mut self,
        _: &dyn Args,
        _: &mut dyn Outputs,
        _: &mut Platform,
        _: Instant,
    ) -> Result<Option<u16>, BadValue> {
        Ok(None)
    }

    fn interrupt(&mut self, _: &mut Platform, _: Instant) -> Result<(), Fault> {
        Ok(())
    }

    fn clear(&mut self) {}
}

#[test]
fn a_plan_with_a_component_that_cannot_be_copied_gives_none() {
    let case = Case::parse(CASE).expect("the script can be read");
    let graph = graph("keyframes", &case.plan).unwrap_or_else(|errors| panic!("{errors}"));
    let mut registry: Registry<Platform> = Registry::new();
    afp_tests::templates::register(&mut registry);
    registry.add_actor("testing", "Work", || Box::new(Foreign));
    let plan = LoadedPlan::new(&graph, &registry).expect("all components are registered");
    assert!(plan.try_clone().is_none());
    assert!(Scheduler::new(plan).try_clone().is_none());
}

#[test]
fn rows_and_releases_can_be_sent_to_another_thread() {
    fn sent<T: Send>() {}
    fn parts<P: PlanState>() {
        sent::<P::Tables>();
        sent::<P::Slots>();
    }
    parts::<LoadedPlan<Platform>>();
}
