//! A plan that uses another file: one type for each plan, one enum for both.

use afp_core::trace::NoTrace;
use afp_core::{Environment, Instant, Scheduler, StillClock, Wake};

afp_macros::plan!("tests/files/main.afp");

struct Nowhere;

impl Environment for Nowhere {
    fn stop(&mut self, _: Instant) {}
    fn emergency_stop(&mut self) {}
}

#[test]
fn a_plan_uses_plans_and_enums_of_another_file() {
    let mut scheduler = Scheduler::new(Pauses::new());
    let mut wake =
        scheduler.start((&mut Nowhere, &mut NoTrace, &StillClock), Instant::ZERO).unwrap();
    let mut last = Instant::ZERO;
    while let Wake::At(now) = wake {
        last = now;
        wake = scheduler.step((&mut Nowhere, &mut NoTrace, &StillClock), now);
    }
    assert_eq!(last, Instant::from_nanos(40_000_000));
    let _: Option<pauses::pause::Pause> = None;
    assert_eq!(scheduler.plan().mood(), Some(pauses::enums::Mood::Calm));
}
