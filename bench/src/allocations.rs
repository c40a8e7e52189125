//! Counts the allocations of a step.

use afp_core::StillClock;
use afp_core::trace::NoTrace;
use afp_counting::{Counting, allocations};
use mimalloc::MiMalloc;

use crate::clocks::Ring;
use crate::plans::{loaded_step, loaded_transition, step::Step, transition::Transition};
use crate::report::{Report, Row};
use crate::steps::steps;

const STEPS: u64 = 1_000_000;

/// The command line's allocator with a counter.
#[global_allocator]
static ALLOCATOR: Counting<MiMalloc> = Counting(MiMalloc);

/// Counts allocations in a million steps, once without events and once with a transition in every
/// step.
pub fn run(_: u32, report: &mut Report) {
    count(report, "generated, step", steps(Step::new(), NoTrace, StillClock));
    count(report, "generated, transition", steps(Transition::new(), Ring::new(), StillClock));
    count(report, "interpreted, step", steps(loaded_step(), NoTrace, StillClock));
    count(report, "interpreted, transition", steps(loaded_transition(), Ring::new(), StillClock));
}

fn count(report: &mut Report, name: &str, mut steps: impl FnMut(u64)) {
    let before = allocations();
    steps(STEPS);
    let count = allocations() - before;
    let row = Row::new(format!("allocations in 10^6 steps/{name}"), count as f64, "");
    report.add(row.limit("= 0", count == 0));
}
