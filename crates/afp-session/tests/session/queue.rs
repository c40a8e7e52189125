//! Observers behind a queue receive the same as without it, and learn of losses.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use afp_core::trace::{Outcome, Record, TraceHash};
use afp_core::{Duration, Instant, Value};
use afp_session::{
    AnySession, NamedRecord, Observer, Open, QueueReader, QueueWriter, Request, Sampling, Session,
    queue,
};

use super::support::{Toy, plan};
use super::{FRONT, Loaded, Notes, PLAN, at, component, session};

fn notes() -> Notes {
    let sampling = Some(Sampling::Every(Duration::from_millis(7)));
    Notes { sampling, clear_polls: Some(0), ..Notes::default() }
}

fn queue_for(
    session: &dyn AnySession,
    to: &mut (dyn Observer + Send),
) -> (QueueWriter, QueueReader) {
    queue(session.owned_names(), session.devices(), &[to])
}

/// The toy, pressed after a while, with a request that fails.
fn pressed() -> Loaded {
    let mut session = session();
    session.set_rest(Duration::from_secs(1));
    session.at(at(305), Request::Press(FRONT, true)).unwrap();
    let early = Request::Inject(component(&session, "rest"), Outcome::Declared(0), Vec::new());
    session.at(at(50), early).unwrap();
    session
}

#[test]
fn a_queue_gives_observers_the_same_run() {
    let (mut here, mut there) = (notes(), notes());
    let mut whole = pressed();
    whole.run(at(3000), &mut Open, &mut [&mut here]).unwrap();

    let mut session = pressed();
    let (mut writer, mut reader) = queue_for(&session, &mut there);
    for millis in (100..=3000).step_by(100) {
        session.run(at(millis), &mut Open, &mut [&mut writer]).unwrap();
        assert!(reader.read(&mut [&mut there]));
    }
    assert_eq!(session.trace(), TraceHash::default(), "the reader makes it");
    drop(writer);
    assert!(!reader.read(&mut [&mut there]));
    assert_eq!(reader.finish(), (whole.trace(), 0));
    assert_eq!(there.lines, here.lines);
    assert_eq!(there.samples, here.samples);
    assert_eq!((there.clear_polls, &there.refused), (here.clear_polls, &here.refused));
    assert_eq!(here.refused.len(), 1, "'rest' does not run yet");
}

/// Counts rounds in an entry, with more records than a queue has room for.
const ROUNDS: &str = "use std
plan Rounds {
    var round: int = 0
    start rest
    actor rest: Wait(duration = 10 ms) { Elapsed -> count }
    computation count: Count(value = round, limit = 1000000, next => round) {
        Again -> rest
        Done -> terminate
    }
}";

/// Keeps the data that a log needs after a loss.
#[derive(Default)]
struct Kept {
    records: u64,
    /// The time of the last loss, the total number of lost records, and the value of the entry.
    lost: Option<(Instant, u64, Value)>,
}

impl Observer for Kept {
    fn on_record(&mut self, _: &NamedRecord<'_>) {
        self.records += 1;
    }

    fn on_loss(&mut self, at: Instant, count: u64, entries: &[Value]) {
        let before = self.lost.take().map_or(0, |(_, count, _)| count);
        self.lost = Some((at, before + count, entries[0].clone()));
    }
}

/// Counts all records.
#[derive(Default)]
struct Count(u64, Option<Value>);

impl Observer for Count {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        self.0 += 1;
        if let Record::Committed { new, .. } = *named.record {
            self.1 = new.to_value().ok();
        }
    }
}

#[test]
fn a_full_queue_does_not_block_and_reports_losses_and_current_values() {
    let mut kept = Kept::default();
    let mut session = Session::loaded(plan(ROUNDS), Toy::new());
    let (mut writer, mut reader) = queue_for(&session, &mut kept);
    let woken: Arc<AtomicU64> = Arc::default();
    let counted = woken.clone();
    writer.set_wake(Box::new(move || {
        counted.fetch_add(1, Ordering::Relaxed);
    }));
    let mut all = Count::default();
    let mut drive = |writer: &mut QueueWriter, until| {
        session.run(at(until), &mut Open, &mut [writer, &mut all]).unwrap();
        (all.0, all.1.clone().unwrap())
    };
    // The queue is not read.
    drive(&mut writer, 60_000);
    assert!(woken.load(Ordering::Relaxed) <= 60 * 20 + 1, "{woken:?}");
    reader.read(&mut [&mut kept]);
    let read = kept.records;
    assert!((1000..20_000).contains(&read) && kept.lost.is_none(), "{read}");
    // The first record with room reports the loss.
    let (made, _) = drive(&mut writer, 60_100);
    reader.read(&mut [&mut kept]);
    let (when, lost, value) = kept.lost.clone().unwrap();
    assert_eq!(kept.records + lost, made);
    assert!(when > at(60_000) && when <= at(60_010), "{when:?}");
    assert!(matches!(value, Value::Int(round) if round > 5000), "{value:?}");
    // A loss at the very end is reported too.
    let (made, last) = drive(&mut writer, 200_000);
    drop(writer);
    assert!(!reader.read(&mut [&mut kept]));
    let (_, lost, value) = kept.lost.clone().unwrap();
    assert_eq!((kept.records + lost, value), (made, last));
    assert_eq!(reader.finish().1, lost);
}

#[test]
fn the_session_of_a_real_robot_makes_the_trace_without_a_queue() {
    let mut session = Session::on_hardware(plan(PLAN), Toy::new());
    let mut whole = super::session();
    session.run(at(500), &mut Open, &mut []).unwrap();
    whole.run(at(500), &mut Open, &mut []).unwrap();
    assert_eq!(session.trace(), whole.trace());
}
