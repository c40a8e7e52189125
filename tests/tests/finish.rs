//! Outcomes set by a test: the report is staged first, then the actor is interrupted, once.

use afp::load::{Injection, LoadedPlan};
use afp_core::trace::{ComponentId, Ending, Line, Outcome, Record, Sink};
use afp_core::{Instant, NamedPlan, Scheduler, Text, Value, Wake};
use afp_tests::case::Case;
use afp_tests::interpret::{graph, load};
use afp_tests::platform::{CostClock, Log, Platform, SCRIPTED};

const PLAN: &str = r#"use testing

plan P {
    start a
    var size: int = 0
    actor a: Work(name = "a", text => size) {
        Done -> a
        Other -> b
        Error -> c
    }
    actor b: Task(name = "b") { Done -> b }
    actor c: Task(name = "c") { Done -> c }
}
"#;

struct Lines(<LoadedPlan<Platform> as NamedPlan>::Names, Log);

impl Sink for Lines {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.1.note(Line { at, record, names: &self.0 }.to_string());
    }
}

/// Makes `a` report `Other` with a string at 10 ms, and returns the lines.
fn finished(text: &str, script: &str) -> (Vec<String>, Wake) {
    let graph = graph("finish", PLAN).unwrap_or_else(|errors| panic!("{errors}"));
    let case = format!("// script\n//   {script}\n{PLAN}");
    let script = Case::parse(&case).expect("the script can be read").script;
    let (log, clock) = (Log::default(), CostClock::default());
    let plan = load(&graph);
    let mut sink = Lines(plan.names(), log.clone());
    let mut platform = Platform::new(script, log.clone(), clock.clone());
    let mut scheduler = Scheduler::new(plan);
    scheduler.start((&mut platform, &mut sink, &clock), Instant::ZERO).expect("it can start");
    let (before, active) = (log.lines().len(), scheduler.active());
    let text = Value::Text(Text::try_from(text).expect("it is short"));
    let injection = Injection {
        component: ComponentId(1),
        outcome: Outcome::Declared(1),
        outputs: vec![(3, text)],
    };
    scheduler.plan_under_test().inject(active, &injection).expect("it is active");
    let now = Instant::from_nanos(10_000_000);
    let wake = scheduler.step((&mut platform, &mut sink, &clock), now);
    (log.lines()[before..].to_vec(), wake)
}

#[test]
fn an_actor_made_to_finish_is_interrupted_once_and_commits() {
    let (lines, _) = finished("7", "until 10 ms");
    let expected = [
        "0.010000 a is made to report Other",
        "0.010000 [interrupt a]",
        "0.010000 a finished Other -> b",
        "0.010000 a commits size: 0 -> 7",
        "0.010000 b reads name = \"b\"",
        "0.010000 b started",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn a_value_that_does_not_fit_is_refused_and_the_actor_interrupted_once() {
    let (lines, _) = finished("abc", "until 10 ms");
    let expected = [
        "0.010000 a is made to report Other",
        "0.010000 a fault conversion: a text does not read as the value it should become -> c",
        "0.010000 [interrupt a]",
        "0.010000 a interrupted",
        "0.010000 c reads name = \"c\"",
        "0.010000 c started",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn an_actor_that_cannot_be_interrupted_ends_the_run() {
    let (lines, wake) = finished("7", "always: a interrupt fault");
    let expected = [
        "0.010000 a is made to report Other",
        "0.010000 [interrupt a]",
        "0.010000 a fault scripted: as the script says -> c",
        "[emergency stop]",
        "0.010000 P fault scripted: as the script says",
        "0.010000 P ended Error(scripted)",
    ];
    assert_eq!(lines, expected);
    assert_eq!(wake, Wake::Ended(Ending::Error(SCRIPTED)));
}
