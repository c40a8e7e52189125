//! Millions of steps of a plan without an allocation, in both back ends.
//!
//! The test needs its own binary, because it counts in the global allocator.

use afp_core::rt::Plan;
use afp_core::trace::NoTrace;
use afp_core::{ElementId, Instant, Scheduler, StillClock, Wake};
use afp_counting::{Counting, allocations};
use afp_tests::interpret::{graph, load};
use afp_tests::platform::{CostClock, Log, Platform};
use afp_tests::script::Script;

mod plans {
    include!(concat!(env!("OUT_DIR"), "/steps.rs"));
}

/// The handler of the plan.
const REST: ElementId = ElementId(5);

/// Steps between repetitions of [`TIMES`], one a millisecond.
const ROUND: u64 = 1_000_000;

/// The behaviour of components: start and end in milliseconds, and a line. It has no faults that
/// end the run, and no stops.
const TIMES: &[(u64, u64, &str)] = &[
    (10_000, 45_000, "button Seen"),
    (10_000, 20_000, "rest Done"),
    (20_000, 30_000, "rest Other"),
    (30_000, 49_000, "rest Done"),
    (420_000, 590_000, "button Seen"),
    (430_000, 599_000, "rest Done"),
    (50_000, 200_000, "near Seen"),
    (150_000, 300_000, "drive Done"),
    (300_000, 500_000, "drive Other"),
    (100_000, 250_000, "work Done = 2"),
    (250_000, 320_000, "work Other"),
    (320_000, 400_000, "work Done = 4"),
    (400_000, 450_000, "touch Seen"),
    (450_000, 900_000, "work Other = 5"),
    (600_000, 650_000, "work fault"),
    (700_000, 750_000, "drive start fault"),
    (800_000, 850_000, "global First"),
];

/// The number of steps: a million, or `AFP_STEPS`.
fn steps() -> u64 {
    let steps = std::env::var("AFP_STEPS").map(|text| text.parse().expect("AFP_STEPS is a number"));
    steps.unwrap_or(ROUND)
}

fn script(steps: u64) -> Script {
    let rounds = (0..steps.div_ceil(ROUND)).map(|round| round * ROUND);
    let lines = rounds.flat_map(|start| {
        let line = move |(from, to, what): &(u64, u64, &str)| {
            format!("from {} ms to {} ms: {what}", start + from, start + to)
        };
        TIMES.iter().map(line)
    });
    let lines: Vec<String> = std::iter::once("show nothing".to_owned()).chain(lines).collect();
    lines.join("\n").parse().expect("a script that can be read")
}

#[global_allocator]
static ALLOCATOR: Counting = Counting::SYSTEM;

/// Steps a plan each millisecond; returns the number of allocations, of changes of the outermost
/// plan's active element, and of handlers that ended.
fn run<P: Plan<Platform>>(plan: P) -> (u64, u64, u64) {
    let steps = steps();
    let mut platform = Platform::new(script(steps), Log::default(), CostClock::default());
    let mut scheduler = Scheduler::new(plan);
    let started = scheduler.start((&mut platform, &mut NoTrace, &StillClock), Instant::ZERO);
    assert!(matches!(started, Ok(Wake::At(_))));
    let (before, mut changes, mut handlers) = (allocations(), 0, 0);
    for step in 1..=steps {
        let active = scheduler.active();
        let now = Instant::from_nanos(step * 1_000_000);
        let wake = scheduler.step((&mut platform, &mut NoTrace, &StillClock), now);
        assert!(matches!(wake, Wake::At(_)), "it ended at {now}");
        let changed = scheduler.active() != active;
        changes += u64::from(changed);
        handlers += u64::from(changed && active == Some(REST));
    }
    (allocations() - before, changes, handlers)
}

#[test]
fn neither_back_end_allocates_after_the_start() {
    let text = include_str!("../plans/steps.afp");
    let graph = graph("steps", text).unwrap_or_else(|errors| panic!("{errors}"));
    let interpreted = run(load(&graph));
    let generated = run(plans::steps::new());
    assert_eq!(interpreted, generated);
    assert_eq!(generated.0, 0);
    assert!(generated.1 > steps() / 1000, "only {} transitions", generated.1);
    assert!(generated.2 > steps() / 10_000, "only {} handlers", generated.2);
}
