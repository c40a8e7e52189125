//! Pictures of cameras.

use std::fs;

use afp_core::Instant;
use afp_core::devices::{DeviceRow, SignalId, SignalRow, SignalType};
use afp_log::{SessionLog, read};
use afp_session::{Image, Observer, SampleRef};

use super::{at, begun};

const SEES: [SignalRow; 1] =
    [SignalRow { name: "picture", ty: SignalType::Image, truth: false, help: "" }];

const fn camera(name: &'static str) -> DeviceRow {
    DeviceRow { name, help: "", controls: &[], faults: &[], signals: &SEES }
}

const DEVICES: [DeviceRow; 2] = [camera("left"), camera("right")];

/// The samples of an instant, in a session's order.
fn sample(log: &mut SessionLog, at: Instant) {
    for signal in [SignalId(0), SignalId(1)] {
        if log.wants(at, signal) {
            let image = Image { time: at, frame: "camera", width: 1, height: 1, rgb: &[1, 2, 3] };
            log.on_sample(at, signal, SampleRef::Image(image));
        }
    }
    log.after_samples(at);
}

#[test]
fn each_of_two_cameras_is_logged_twice_a_second() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let mut log = begun(&path, &DEVICES);
    for turn in 0..50 {
        sample(&mut log, at(turn * 20));
    }
    drop(log);
    // An unfinished log keeps its part name.
    let part = fs::read_dir(dir.path()).unwrap().next().unwrap().unwrap().path();
    let topics = read(&part).unwrap().topics;
    for topic in ["/robot/left", "/robot/right"] {
        assert_eq!(topics.get(topic).map(|topic| topic.messages), Some(2), "{topics:?}");
    }
}
