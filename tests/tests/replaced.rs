//! A plan that replaces another takes its values over.

use std::cell::RefCell;

use afp::Callbacks;
use afp_core::trace::NoTrace;
use afp_core::{Instant, Scheduler};
use afp_tests::case::Case;
use afp_tests::interpret::{graph, load};
use afp_tests::platform::{CostClock, Log, Platform};

/// Its object is as many commits old as the first one that `NEW` makes.
const OLD: &str = r#"use testing

plan P {
    start make
    var map: Map
    computation make: MakeMap(id = 40, map => map) { Done -> then }
    computation then: MakeMap(id = 41, map => map) { Done -> stay }
    actor stay: Task(name = "stay") { Done -> terminate }
}
"#;

/// Makes its first object while it watches the carried one.
const NEW: &str = r#"// script
//   at 30 ms: again Seen
//   until 50 ms
use std
use testing

plan P {
    start stay
    var map: Map
    actor stay: Task(name = "stay") {
        supervise again: Glance(name = "again") { Seen -> make }
        supervise other: Changed(value = map) { Changed -> terminate }
        Done -> terminate
    }
    computation make: MakeMap(id = 42, map => map) { Done -> resume }
}
"#;

#[test]
fn a_new_object_differs_from_the_carried_one() {
    let [old, new] =
        [OLD, NEW].map(|text| graph("replaced", text).unwrap_or_else(|errors| panic!("{errors}")));
    let script = Case::parse(NEW).expect("the script can be read").script;
    let (clock, told) = (CostClock::default(), RefCell::new(Vec::new()));
    let mut platform = Platform::new(script, Log::default(), clock.clone());
    let mut scheduler = Scheduler::new(load(&old));
    let at = |millis: u64| Instant::from_nanos(millis * 1_000_000);
    scheduler.start((&mut platform, &mut NoTrace, &clock), at(0)).expect("it can start");
    let mut next = load(&new);
    assert_eq!(next.carry(scheduler.plan()), ["map"]);
    let mut calls = Callbacks::new(&next)
        .on("stay.other", "Changed", |at| told.borrow_mut().push(at))
        .unwrap_or_else(|why| panic!("{why}"));
    scheduler.replace(next, (&mut platform, &mut calls, &clock), at(0)).expect("it can start");
    for millis in [10, 20, 30, 40] {
        scheduler.step((&mut platform, &mut calls, &clock), at(millis));
    }
    drop(calls);
    assert_eq!(told.into_inner(), [at(30)]);
}
