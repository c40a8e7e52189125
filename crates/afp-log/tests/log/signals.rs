use afp_core::Instant;
use afp_core::devices::{DeviceRow, SignalId, SignalRow, SignalType};
use afp_log::{SessionLog, read};
use afp_session::{Datum, Observer, SampleRef};

use super::{at, begun};

const SAYS: [SignalRow; 1] =
    [SignalRow { name: "tone", ty: SignalType::Float("Hz"), truth: false, help: "" }];
const DEVICES: [DeviceRow; 1] =
    [DeviceRow { name: "signals", help: "", controls: &[], faults: &[], signals: &SAYS }];

/// The samples of an instant, in a session's order.
fn sample(log: &mut SessionLog, at: Instant, tone: Option<f64>) {
    if let Some(tone) = tone {
        log.on_sample(at, SignalId(0), SampleRef::Float(tone));
    }
    log.after_samples(at);
}

#[test]
fn a_silent_signal_is_logged() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let mut log = begun(&path, &DEVICES);
    let tones = [None, Some(880.0), Some(880.0), None, None, Some(880.0)];
    tones.iter().zip(0..).for_each(|(tone, turn)| sample(&mut log, at(turn * 20), *tone));
    drop(log);
    let said = read(&dir.path().join("a.mcap.part")).unwrap().samples;
    let tone = Datum::Float(880.0);
    let expected = [(at(20), tone.clone()), (at(60), Datum::Unset), (at(100), tone)];
    assert_eq!(said["signals/tone"], expected);
}
