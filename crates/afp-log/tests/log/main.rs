//! A log is written, read, truncated, recovered.

mod cameras;
mod damaged;
mod lost;
mod recipe;
mod signals;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use afp_core::devices::DeviceRow;
use afp_core::trace::{
    Author, Cause, ComponentId, ComponentKind, ComponentName, Ending, EntryKind, EntryName, Names,
    Outcome, Reaction, Record, Sink, TraceEntryId, Verdict,
};
use afp_core::{Duration, Instant, ValueRef};
use afp_log::robot::{Level, Pose2, Ranging, Shape, Transform};
use afp_log::statistics::statistics;
use afp_log::{
    About, LogError, LogNames, Recorder, SessionLog, WhenFull, doctor, read, recover,
    recovered_name,
};
use afp_session::{Datum, EventAt, EventKind, NamedRecord, Observer};

/// A log of a started run, for a robot with these devices.
fn begun(path: &Path, devices: &'static [DeviceRow]) -> SessionLog {
    let (about, names) = (About::default(), Box::new(Names1));
    let recorder = Recorder::create(path, &about, names, WhenFull::Wait).unwrap();
    let mut log = SessionLog::new(recorder, devices, vec![], true);
    let record = &Record::StopRequested;
    log.on_record(&NamedRecord { at: at(0), record, names: &Names1, line: "0 stop" });
    log
}

/// A plan of one actor with one supervisor and two entries.
struct Names1;

/// The first state or event of a template.
const FIRST: Outcome = Outcome::Declared(0);

impl Names for Names1 {
    fn components(&self) -> u32 {
        3
    }

    fn component(&self, id: ComponentId) -> ComponentName<'_> {
        let (path, kind, template) = match id.0 {
            0 => ("Walk", ComponentKind::Plan, "Walk"),
            1 => ("go", ComponentKind::Actor, "Forward"),
            2 => ("go.touch", ComponentKind::Supervisor, "CheckTouchSensor"),
            _ => return ComponentName::NONE,
        };
        ComponentName { path, kind, template }
    }

    fn outcome(&self, id: ComponentId, outcome: Outcome) -> &str {
        match (id.0, outcome.number()) {
            (1, 0) => "ForwardSuccessful",
            (2, 0) => "TouchSensorPressed",
            _ => "",
        }
    }

    fn target(&self, id: ComponentId, outcome: Outcome) -> &str {
        match (id.0, outcome.number()) {
            (1, 0) => "terminate",
            (2, 0) => "go",
            _ => "",
        }
    }

    fn reaction(&self, element: ComponentId, n: u16) -> Option<Reaction<'_>> {
        let (supervisor, outcome) = (ComponentId(2), FIRST);
        let here = (element.0, n) == (1, 0);
        here.then_some(Reaction { supervisor, outcome, target: "terminate" })
    }

    fn input(&self, id: ComponentId, port: u16) -> &str {
        if (id.0, port) == (1, 0) { "distance" } else { "" }
    }

    fn entries(&self) -> u32 {
        2
    }

    fn entry(&self, id: TraceEntryId) -> EntryName<'_> {
        match id.0 {
            0 => {
                EntryName { path: "far", kind: EntryKind::In, ty: "length", unit: "m", range: None }
            }
            1 => {
                EntryName { path: "side", kind: EntryKind::Var, ty: "Side", unit: "", range: None }
            }
            _ => EntryName::NONE,
        }
    }

    fn choice(&self, id: TraceEntryId, value: u16) -> &str {
        match (id.0, value) {
            (1, 0) => "left",
            (1, 1) => "right",
            _ => "",
        }
    }
}

fn about() -> About {
    let facts = [("plan", "Walk"), ("seed", "7")];
    About {
        facts: facts.map(|(key, value)| (key.to_owned(), value.to_owned())).to_vec(),
        attachments: vec![("walk.afp".into(), "text/plain", "plan Walk {}".into())],
    }
}

fn at(millis: u64) -> Instant {
    Instant::from_nanos(millis * 1_000_000)
}

fn run(log: &mut Recorder) {
    let (go, touch) = (ComponentId(1), ComponentId(2));
    log.started(at(0));
    let (author, entry) = (Author::Component(ComponentId(0)), TraceEntryId(0));
    let (old, new) = (ValueRef::Unset, ValueRef::Float(0.3));
    log.record(at(0), &Record::Committed { author, entry, old, new });
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let (id, frame, color) = ("box".into(), "world", [0.5, 0.5, 0.5, 1.0]);
    log.scene(at(0), vec![Shape { id, frame, outline: square, height: 0.4, color }]);
    log.record(at(0), &Record::Started { component: go });
    for n in 1..=2000 {
        let now = at(n);
        log.record(now, &Record::Polled { supervisor: touch, verdict: Verdict::Clear });
        let pose = Pose2 { x: n as f64 * 0.001, y: 0.5, heading: 0.25 };
        if n % 50 == 0 {
            log.pose(now, "world", pose);
            let frames = ["odom", "base", "sonar"];
            log.transforms(
                now,
                &frames.map(|child| Transform { parent: "world", child, pose, height: 0.1 }),
            );
            let range = (n % 100 == 0).then_some(1.5);
            let pose = Pose2::default();
            let ranging = Ranging { time: now, frame: "sonar", pose, half_angle: 0.13, range };
            log.ranging(now, "ultrasonic", ranging, 0.1);
        }
    }
    let (lateness, cause) = (Duration::from_millis(3), Cause::LongPoll);
    log.record(at(2001), &Record::Missed { supervisor: touch, lateness, cause, skipped: 2 });
    log.record(
        at(2001),
        &Record::Event { supervisor: touch, event: FIRST, element: ComponentId(1) },
    );
    log.record(at(2001), &Record::Interrupted { element: go });
    let author = Author::Component(touch);
    let old = ValueRef::Unset;
    let (entry, new) = (TraceEntryId(1), ValueRef::Choice(1));
    log.record(at(2001), &Record::Committed { author, entry, old, new });
    log.record(at(2001), &Record::Started { component: go });
    log.record(at(3001), &Record::Finished { element: go, state: FIRST });
    log.record(at(3001), &Record::Ended { plan: ComponentId(0), ending: Ending::Ok });
    log.text(at(3001), Level::Info, "afp", "done");
}

fn create(path: &Path) -> Recorder {
    Recorder::create(path, &about(), Box::new(Names1), WhenFull::Wait).unwrap()
}

fn written(dir: &Path) -> PathBuf {
    let path = dir.join("a.mcap");
    let mut log = create(&path);
    run(&mut log);
    let written = log.finish().unwrap();
    assert_eq!((written.path.as_path(), written.lost), (path.as_path(), 0));
    assert!(!dir.join("a.mcap.part").exists());
    path
}

#[test]
fn a_written_log_is_read_back() {
    let dir = tempfile::tempdir().unwrap();
    let path = written(dir.path());
    let log = read(&path).unwrap();
    assert_eq!(log.cut_short, None);
    assert_eq!(log.facts["seed"], "7");
    assert_eq!(log.attachments["walk.afp"], "plan Walk {}");
    assert_eq!(log.span, Some((at(0), at(3001))));
    assert_eq!(log.topics["/tf"].schema, "foxglove.FrameTransforms");
    assert_eq!(log.topics["/robot/ultrasonic"].messages, 40);
    assert_eq!(log.names.target(ComponentId(1), FIRST), "terminate");
    assert_eq!(log.names.target_at(ComponentId(2), FIRST, ComponentId(1)), "terminate");
    assert_eq!(log.names.target_at(ComponentId(2), FIRST, ComponentId(3)), "go");
    assert_eq!(log.events.len(), 2009);
    let event = &log.events[2003];
    let EventKind::Event(EventAt { event: taken, element, on }) = &event.kind else { panic!() };
    assert_eq!(
        (&*event.component.path, &*taken.name, &*taken.target),
        ("go.touch", "TouchSensorPressed", "terminate")
    );
    assert_eq!((&*element.path, *on), ("go", true));
    let (time, pose) = log.poses[39];
    assert_eq!(time, at(2000));
    assert!((pose.x - 2.0).abs() < 1e-9 && (pose.heading - 0.25).abs() < 1e-9);
    assert_eq!(log.configurations.len(), 3);
    let values = [("far", Datum::Float(0.3)), ("side", Datum::Choice("Side.right".to_owned()))];
    assert_eq!(log.configurations[2].entries, values.map(|(name, it)| (name.to_owned(), it)));
    assert_eq!(doctor(&path).unwrap(), [""; 0]);
}

#[test]
fn statistics_count_misses_interruptions_and_coverage() {
    let dir = tempfile::tempdir().unwrap();
    let found = statistics(&read(&written(dir.path())).unwrap());
    let (_, touch) = &found.supervisors[0];
    assert_eq!((touch.polls, touch.events(), touch.long_polls, touch.skipped), (2000, 1, 1, 2));
    assert_eq!(touch.worst_lateness, Duration::from_millis(3));
    let (_, go) = &found.elements[0];
    assert_eq!((go.starts, go.interruptions), (2, 1));
    assert_eq!(go.active, Duration::from_millis(3001));
    assert_eq!((found.covered, found.uncovered.len()), (2, 1));
}

#[test]
fn equal_runs_have_equal_messages() {
    let dir = tempfile::tempdir().unwrap();
    let one = read(&written(dir.path())).unwrap();
    let two = read(&written(dir.path())).unwrap();
    assert_eq!(one.events, two.events);
    assert_eq!(one.poses, two.poses);
}

#[test]
fn a_truncated_log_is_read_up_to_its_end() {
    let dir = tempfile::tempdir().unwrap();
    let bytes = fs::read(written(dir.path())).unwrap();
    let part = dir.path().join("b.mcap.part");
    let mut most = 0;
    for cut in (8..bytes.len()).step_by(997) {
        fs::write(&part, &bytes[..cut]).unwrap();
        let log = read(&part).unwrap();
        assert!(log.cut_short.is_some(), "cut at {cut}");
        assert!(!doctor(&part).unwrap().is_empty());
        most = most.max(log.events.len());
    }
    assert_eq!(most, 2009, "a missing summary costs no message");
    let saved = recover(&part, &recovered_name(&part)).unwrap();
    assert!(saved.damage.is_some());
    assert_eq!(saved.path, dir.path().join("b.recovered.mcap"));
    assert_eq!(doctor(&saved.path).unwrap(), [""; 0]);
    assert_eq!(read(&saved.path).unwrap().facts["plan"], "Walk");
}

#[test]
fn a_flipped_byte_is_found() {
    let dir = tempfile::tempdir().unwrap();
    let bytes = fs::read(written(dir.path())).unwrap();
    let bad = dir.path().join("bad.mcap");
    for at in (100..bytes.len() - 40).step_by(1709) {
        let mut bytes = bytes.clone();
        bytes[at] ^= 0x10;
        fs::write(&bad, &bytes).unwrap();
        assert!(!doctor(&bad).unwrap().is_empty(), "byte {at}");
    }
}

#[test]
fn foreign_data_in_a_log_is_found() {
    let dir = tempfile::tempdir().unwrap();
    let sound = fs::read(written(dir.path())).unwrap();
    let bad = dir.path().join("bad.mcap");
    let found = |bytes: &[u8]| {
        fs::write(&bad, bytes).unwrap();
        doctor(&bad).unwrap_or_else(|why| vec![why.to_string()])
    };
    for (rest, told) in [
        (&b"rubbish"[..], "7 extra bytes follow its end"),
        (b"\n", "1 extra bytes"),
        (&sound, "another log follows its end"),
        (mcap::MAGIC, "another log"),
    ] {
        let found = found(&[&sound, rest].concat());
        assert!(found.len() == 1 && found[0].contains(told), "{found:?}");
    }
    assert!(found(&[b"\n", &*sound].concat())[0].contains("is not an MCAP log"));
    let mut state = 1_u64;
    let mut below = |most: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % most
    };
    for _ in 0..300 {
        let mut bytes = sound.clone();
        let (at, length) = (below(sound.len()), 1 + below(200));
        let end = (at + length).min(sound.len());
        match below(5) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => drop(bytes.splice(at..at, sound[at..end].to_vec())),
            3 => bytes[at..end].reverse(),
            _ => bytes.extend_from_slice(&sound[at..end]),
        }
        if bytes != sound {
            assert!(!found(&bytes).is_empty(), "at {at}, {length} bytes");
        }
    }
}

#[test]
fn an_abandoned_log_keeps_its_part_name() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let mut log = create(&path);
    run(&mut log);
    drop(log);
    assert!(!path.exists());
    let part = dir.path().join("a.mcap.part");
    assert_eq!(read(&part).unwrap().cut_short, None);
}

#[test]
fn unwritable_and_unreadable_files_are_reported() {
    let dir = tempfile::tempdir().unwrap();
    let nowhere = dir.path().join("no/such/folder/a.mcap");
    let failed =
        Recorder::create(&nowhere, &about(), Box::new(LogNames::default()), WhenFull::Drop);
    let said = failed.err().unwrap().to_string();
    assert!(said.starts_with("cannot write the log '") && said.contains("a.mcap'"), "{said}");
    let text = dir.path().join("text");
    fs::write(&text, "no log").unwrap();
    assert!(matches!(read(&text), Err(LogError::NotALog { .. })));
    assert!(matches!(read(&nowhere), Err(LogError::Open { .. })));
}

#[test]
fn a_full_queue_is_counted_and_reported() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let mut log = Recorder::create(&path, &about(), Box::new(Names1), WhenFull::Drop).unwrap();
    let record = Record::Polled { supervisor: ComponentId(2), verdict: Verdict::Clear };
    for n in 0..200_000 {
        log.record(at(n), &record);
    }
    let lost = log.lost();
    assert!(lost > 0, "the writer cannot be faster than this loop");
    assert_eq!(log.finish().unwrap().lost, lost);
    let log = read(&path).unwrap();
    assert_eq!(log.lost(), lost);
    let kept = log.events.iter().filter(|event| matches!(event.kind, EventKind::Polled(_))).count();
    assert_eq!(kept as u64 + lost, 200_000);
    assert!(doctor(&path).unwrap()[0].contains("were lost"));
}

#[test]
fn a_log_can_be_recovered_under_the_name_from_its_run() {
    let dir = tempfile::tempdir().unwrap();
    let path = written(dir.path());
    let part = dir.path().join("a.mcap.part");
    let bytes = fs::read(&path).unwrap();
    fs::write(&part, &bytes[..bytes.len() / 2]).unwrap();
    let saved = recover(&part, &path).unwrap();
    assert!(saved.messages > 0 && saved.damage.is_some());
    assert_eq!(doctor(&path).unwrap(), [""; 0]);
    assert_eq!(fs::read(&part).unwrap(), &bytes[..bytes.len() / 2], "the old one is kept");
}

#[test]
fn a_second_log_of_a_name_is_refused_during_writing() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let mut one = create(&path);
    let two = Recorder::create(&path, &about(), Box::new(Names1), WhenFull::Wait);
    let why = two.err().unwrap().to_string();
    assert!(why.contains("another program is writing it"), "{why}");
    run(&mut one);
    assert_eq!(one.finish().unwrap().path, path);
    assert_eq!(read(&path).unwrap().events.len(), 2009);
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
}

#[test]
#[cfg(unix)]
fn a_log_goes_through_a_pipe() {
    let dir = tempfile::tempdir().unwrap();
    let [pipe, copy] = ["pipe", "copy.mcap"].map(|name| dir.path().join(name));
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for make in [
        |pipe: &Path, _: &Path| {
            let mut log = create(pipe);
            run(&mut log);
            assert!(log.finish().unwrap().bytes > 1000);
        },
        |pipe: &Path, copy: &Path| {
            let saved = recover(copy, pipe).unwrap();
            assert_eq!(saved.damage, None);
        },
    ] {
        let reader = thread::spawn({
            let pipe = pipe.clone();
            move || fs::read(pipe).unwrap()
        });
        make(&pipe, &copy);
        fs::write(&copy, reader.join().unwrap()).unwrap();
        assert_eq!(doctor(&copy).unwrap(), [""; 0]);
        assert_eq!(read(&copy).unwrap().events.len(), 2009);
    }
}

#[test]
fn a_log_without_a_description_of_its_run_is_valid() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("bare.mcap");
    let names = Box::new(Names1);
    let log = Recorder::create(&path, &About::default(), names, WhenFull::Wait).unwrap();
    log.finish().unwrap();
    assert_eq!(doctor(&path).unwrap(), [""; 0]);
}
