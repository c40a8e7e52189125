//! A log after a period in which its writer was too slow.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration as Span;

use afp_core::devices::{DeviceRow, SignalId, SignalRow, SignalType};
use afp_core::trace::{Author, ComponentId, Record, Sink, TraceEntryId, Verdict};
use afp_core::{Instant, ValueRef};
use afp_log::{LogData, LogError, Messages, Recorder, SessionLog, read_any};
use afp_session::{Datum, EventKind, NamedRecord, Observer, SampleRef, Shape};
use mcap::records::{MessageHeader, Metadata};

use super::{Names1, at};

const SAYS: [SignalRow; 2] = [
    SignalRow { name: "left", ty: SignalType::Bool, truth: false, help: "" },
    SignalRow { name: "outline", ty: SignalType::Outline, truth: false, help: "" },
];
const DEVICES: [DeviceRow; 1] =
    [DeviceRow { name: "bumper", help: "", controls: &[], faults: &[], signals: &SAYS }];
const LEFT: SignalId = SignalId(0);
const OUTLINE: SignalId = SignalId(1);

/// A disk that stalls while a lock is held.
struct Disk {
    writer: mcap::Writer<BufWriter<File>>,
    free: Arc<Mutex<()>>,
    written: Arc<AtomicUsize>,
}

impl Disk {
    fn new(path: &Path) -> Box<Disk> {
        let writer = mcap::Writer::new(BufWriter::new(File::create(path).unwrap())).unwrap();
        Box::new(Disk { writer, free: Arc::default(), written: Arc::default() })
    }
}

impl Messages for Disk {
    fn open(&mut self, topic: &str, schema: &str, set: &[u8]) -> Result<u16, LogError> {
        let schema = self.writer.add_schema(schema, "protobuf", set)?;
        Ok(self.writer.add_channel(schema, topic, "protobuf", &BTreeMap::new())?)
    }

    fn send(&mut self, id: u16, sequence: u32, at: Instant, data: &[u8]) -> Result<(), LogError> {
        let _free = self.free.lock().unwrap();
        let (log_time, publish_time) = (at.as_nanos(), at.as_nanos());
        let header = MessageHeader { channel_id: id, sequence, log_time, publish_time };
        self.written.fetch_add(1, Ordering::Relaxed);
        Ok(self.writer.write_to_known_channel(&header, data)?)
    }

    fn came(&mut self, facts: Vec<(String, String)>) -> Result<(), LogError> {
        let metadata = facts.into_iter().collect();
        Ok(self.writer.write_metadata(&Metadata { name: "afp.end".into(), metadata })?)
    }

    fn flush(&mut self) -> Result<(), LogError> {
        Ok(())
    }

    fn finish(mut self: Box<Self>, _: bool) -> Result<(PathBuf, u64), LogError> {
        self.writer.finish()?;
        Ok((PathBuf::new(), 0))
    }
}

const CLEAR: Record<'_> = Record::Polled { supervisor: ComponentId(2), verdict: Verdict::Clear };

/// More items than the queue's capacity.
const MANY: usize = 20_000;

fn commit() -> Record<'static> {
    let (author, old, new) =
        (Author::Component(ComponentId(0)), ValueRef::Unset, ValueRef::Float(0.3));
    Record::Committed { author, entry: TraceEntryId(0), old, new }
}

fn shape(x: f64) -> Shape {
    let (id, frame, color) = ("box".into(), "world", [0.5, 0.5, 0.5, 1.0]);
    Shape { id, frame, outline: vec![[x, 0.0], [x, 1.0], [0.0, 1.0]], height: 0.4, color }
}

fn lost(log: &LogData) -> u64 {
    log.lost()
}

#[test]
fn lost_state_is_written_again() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let disk = Disk::new(&path);
    let (free, written) = (disk.free.clone(), disk.written.clone());
    let scene = vec![shape(1.0)];
    let recorder = Recorder::stream(disk, Box::new(Names1)).unwrap();
    let mut log = SessionLog::new(recorder, &DEVICES, scene, false);
    let record = |log: &mut SessionLog, now, record: &Record<'_>| {
        log.on_record(&NamedRecord { at: at(now), record, names: &Names1, line: "0 it" });
    };
    let sample = |log: &mut SessionLog, now, left, x| {
        log.on_sample(at(now), LEFT, SampleRef::Bool(left));
        log.on_sample(at(now), OUTLINE, SampleRef::Outline(&shape(x)));
        log.after_samples(at(now));
    };
    sample(&mut log, 0, false, 1.0);
    let stalled = free.lock().unwrap();
    (0..MANY).for_each(|_| record(&mut log, 1, &CLEAR));
    record(&mut log, 20, &commit());
    sample(&mut log, 20, true, 2.0);
    drop(stalled);
    while written.load(Ordering::Relaxed) < 8192 {
        thread::sleep(Span::from_millis(1));
    }
    // Nothing has changed since.
    sample(&mut log, 40, true, 2.0);
    drop(log);
    let log = read_any(&path).unwrap();
    assert!(lost(&log) > 0);
    assert!(
        log.events.iter().all(|event| !matches!(event.kind, EventKind::Committed { .. })),
        "it got lost"
    );
    let last = log.configurations.last().unwrap();
    assert_eq!((last.at, &last.entries[0].1), (at(40), &Datum::Float(0.3)));
    let said = [(at(0), Datum::Bool(false)), (at(40), Datum::Bool(true))];
    assert_eq!(log.samples["bumper/left"], said);
    assert_eq!(log.things.get("box").unwrap()[0], [2.0, 0.0]);
}

#[test]
fn the_result_of_a_run_is_not_lost() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let disk = Disk::new(&path);
    let free = disk.free.clone();
    let mut log = Recorder::stream(disk, Box::new(Names1)).unwrap();
    let stalled = free.lock().unwrap();
    (0..MANY).for_each(|_| log.record(at(1), &CLEAR));
    log.record(at(2), &commit());
    drop(stalled);
    log.wait_when_full();
    log.end(at(3), vec![("trace".to_owned(), "12ab".to_owned())]);
    let written = log.finish().unwrap();
    let log = read_any(&path).unwrap();
    assert_eq!((log.end["trace"].as_str(), lost(&log)), ("12ab", written.lost));
    assert_eq!(log.configurations.last().unwrap().entries[0].1, Datum::Float(0.3));
}
