//! A program with a plan that it knows only by name: values in, callbacks out.

use std::cell::RefCell;

use afp::Callbacks;
use afp_core::{Instant, Scheduler};
use afp_tests::case::Case;
use afp_tests::interpret::{graph, load};
use afp_tests::platform::{CostClock, Log, Platform};

const PLAN: &str = r#"use testing

plan P {
    start a
    in way: length = 1 m
    in count: int = 1
    in share: float = 1
    in on: bool = true
    in side: Side = Side.left
    in word: string = "w"
    out took: duration = 1 s
    out toward: Side = Side.left
    actor a: Task(name = "a") {
        supervise s: Glance(name = "s") every 10 ms { Seen -> b }
        Done  -> b
        Error -> b
    }
    actor b: Task(name = "b") { Done -> terminate }
}
"#;

#[test]
fn an_invalid_string_is_answered_with_valid_ones() {
    let graph = graph("outside", PLAN).unwrap_or_else(|errors| panic!("{errors}"));
    let mut scheduler = Scheduler::new(load(&graph));
    for (entry, text, why) in [
        ("way", "80 kg", "write a number and a unit that fits"),
        ("way", "80", "write a number and a unit that fits"),
        ("count", "3.5", "write a whole number"),
        ("share", "1 m", "write a number, such as '0.5'"),
        ("on", "1", "write 'true' or 'false'"),
        ("side", "Side.up", "write one of the values that its enum declares"),
        ("took", "2 s", "only 'in' and 'var' entries can be written from outside"),
        ("took", "nonsense", "only 'in' and 'var' entries can be written from outside"),
        ("toward", "left", "only 'in' and 'var' entries can be written from outside"),
        ("nothing", "1", "the plan has no such entry"),
    ] {
        let said = scheduler.set_named(entry, text).map_err(|why| why.to_string());
        assert!(said.as_ref().is_err_and(|said| said.contains(why)), "{entry}: {said:?}");
    }
    let long = scheduler.set_named("word", &"w".repeat(65)).unwrap_err().to_string();
    assert_eq!(long, "a text is longer than 64 bytes; write a shorter string");
    for (entry, text) in
        [("way", "80 cm"), ("side", "right"), ("side", "Side.right"), ("word", "x y")]
    {
        assert_eq!(scheduler.set_named(entry, text), Ok(()), "{entry}");
    }
}

/// A sub-plan whose actor fails when it is interrupted, and one whose actor fails at once.
const FAILING: &str = r#"// script
//   at 10 ms: a fault
//   from 20 ms to 60 ms: s Seen
//   until 100 ms
use testing

plan P {
    start first
    subplan first: Inner { OK -> second  Error -> second }
    actor second: Task(name = "second") {
        supervise s: Glance(name = "s") every 10 ms { Seen -> terminate }
        Done -> terminate
    }
}

plan Inner {
    start a
    actor a: Task(name = "a") { Done -> terminate }
}
"#;

#[test]
fn every_component_reports_its_faults_and_a_supervisor_its_misses() {
    let graph = graph("failing", FAILING).unwrap_or_else(|errors| panic!("{errors}"));
    let script = Case::parse(FAILING).expect("the script can be read").script;
    let (log, clock) = (Log::default(), CostClock::default());
    let mut scheduler = Scheduler::new(load(&graph));
    let told = RefCell::new(Vec::new());
    let tell = |what: &'static str| {
        let told = &told;
        move |at: Instant| told.borrow_mut().push(format!("{at} {what}"))
    };
    let plan = scheduler.plan();
    let unknown = Callbacks::new(plan).on("first.a", "Nothing", tell("never")).unwrap_err();
    let all = "'first.a' has no state or event 'Nothing'; there are: Done, Error";
    assert_eq!(unknown.to_string(), all);
    assert!(Callbacks::new(plan).on("second", "DeadlineMissed", tell("never")).is_err());
    let mut calls = Callbacks::new(plan)
        .on("first.a", "Error", tell("a failed"))
        .and_then(|calls| calls.on("first", "Error", tell("first failed")))
        .and_then(|calls| calls.on("second.s", "DeadlineMissed", tell("s was late")))
        .and_then(|calls| calls.on("second.s", "Seen", tell("s saw")))
        .unwrap_or_else(|why| panic!("{why}"));
    let mut platform = Platform::new(script, log, clock.clone());
    scheduler.start((&mut platform, &mut calls, &clock), Instant::ZERO).expect("it can start");
    for at in [10_000_000, 45_000_000] {
        scheduler.step((&mut platform, &mut calls, &clock), Instant::from_nanos(at));
    }
    drop(calls);
    let expected =
        ["0.010000 a failed", "0.010000 first failed", "0.045000 s was late", "0.045000 s saw"];
    assert_eq!(told.into_inner(), expected);
}
