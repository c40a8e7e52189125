//! Traces that a correct scheduler never makes are detected.

use afp::load::PlanNames;
use afp_core::trace::{Author, ComponentId, Record, TraceEntryId};
use afp_core::{Instant, Value, ValueRef};
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::scenario::Scenario;
use afp_syntax::source::Source;

use super::Watch;
use super::signals::Signals;

const PLAN: &str = r#"
use carbot
plan Ahead {
    var gone: length = 0 m
    var back: length = 0 m
    start go
    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }
    actor go: Forward(distance = gone, driven => gone) { ForwardSuccessful -> home }
    actor home: Forward(distance = back, driven => back) { ForwardSuccessful -> terminate }
}
scenario "it" for Ahead {
    expect commit by go once
    expect commit of gone 2 times
    expect interrupt of go once
    never commit by home
    never interrupt of home
}
"#;

const GO: ComponentId = ComponentId(1);
const GONE: TraceEntryId = TraceEntryId(0);
const BACK: TraceEntryId = TraceEntryId(1);

fn scenario() -> Scenario {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let mut compiled =
        afp_dsl::compile(&Source::new("case.afp", PLAN), &toolboxes, &Texts::default());
    assert_eq!(compiled.scenarios.len(), 1, "{}", compiled.render(false));
    compiled.scenarios.remove(0)
}

fn commit(entry: TraceEntryId, author: u32) -> Record<'static> {
    let author = Author::Component(ComponentId(author));
    Record::Committed { author, entry, old: ValueRef::Unset, new: ValueRef::Float(1.0) }
}

/// The broken lines of a trace, with their reasons.
fn broken(records: &[Record<'static>]) -> Vec<String> {
    let scenario = scenario();
    let names = PlanNames::new(&scenario.graph);
    let mut watch = Watch::new(&scenario, &names, Signals::default());
    records.iter().for_each(|record| watch.on_record(Instant::from_nanos(5), record, &names));
    let broken = watch.finish(Instant::from_nanos(9));
    broken.into_iter().map(|broken| format!("{}: {}", broken.text, broken.why)).collect()
}

/// The initial values, a commit of two entries, and an interruption.
fn sound() -> Vec<Record<'static>> {
    vec![
        commit(GONE, 0),
        commit(BACK, 0),
        Record::Started { component: GO },
        Record::Interrupted { element: GO },
        commit(GONE, 1),
        commit(BACK, 1),
    ]
}

#[test]
fn a_valid_trace_passes() {
    assert_eq!(broken(&sound()), [""; 0]);
}

#[test]
fn a_second_commit_and_a_second_interruption_are_reported() {
    let mut twice = sound();
    twice.extend([commit(GONE, 1), commit(BACK, 1)]);
    assert_eq!(
        broken(&twice),
        [
            "expect commit by go once: it happened 2 times, at 0.000 s, 0.000 s",
            "expect commit of gone 2 times: it happened 3 times, at 0.000 s, 0.000 s, 0.000 s",
        ]
    );
    let mut twice = sound();
    twice.insert(3, Record::Interrupted { element: GO });
    assert_eq!(
        broken(&twice),
        ["expect interrupt of go once: it happened 2 times, at 0.000 s, 0.000 s"]
    );
    let mut none = sound();
    none.remove(3);
    assert_eq!(broken(&none), ["expect interrupt of go once: it did not happen"]);
}

#[test]
fn a_commit_by_the_wrong_component_is_noticed() {
    let mut foreign = sound();
    foreign.push(commit(BACK, 2));
    assert_eq!(broken(&foreign), ["never commit by home: it held"]);
}

#[test]
fn an_entry_that_changes_without_a_commit_is_noticed() {
    let scenario = scenario();
    let names = PlanNames::new(&scenario.graph);
    let mut watch = Watch::new(&scenario, &names, Signals::default());
    sound().iter().for_each(|record| watch.on_record(Instant::ZERO, record, &names));
    let (one, two) = (Value::Float(1.0), Value::Float(2.0));
    assert!(watch.differs([one.as_deref(), one.as_deref()].into_iter()).is_none());
    let found = watch.differs([one.as_deref(), two.as_deref()].into_iter());
    assert_eq!(found.map(|(index, ..)| index), Some(1));
}
