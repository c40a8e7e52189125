//! The values of the robot's signals in a finished run, at any time.

use afp_core::Instant;
use afp_core::devices::{DeviceRow, SignalRow, SignalType, signals};
use afp_debug::{Cone, Sensed};
use afp_log::{Heard, LogData};
use afp_session::{Datum, Pose2};

/// The values of a signal, by time.
enum Said {
    Values(Vec<(Instant, Datum)>),
    Ranges(Vec<Heard>),
}

/// The signals of a robot in a log.
pub struct Senses(Vec<(&'static DeviceRow, &'static SignalRow, Said)>);

impl Senses {
    /// Takes the values of the signals that a plan can read from a log.
    pub fn take(log: &mut LogData, devices: &'static [DeviceRow]) -> Self {
        let all = signals(devices).filter(|(.., row)| !row.truth).filter_map(|(_, device, row)| {
            let said = match row.ty {
                SignalType::Range => Said::Ranges({
                    let of_it = |heard: &mut Heard| *heard.device == *device.name;
                    log.rangings.extract_if(.., of_it).collect()
                }),
                _ => Said::Values(log.samples.remove(&format!("{}/{}", device.name, row.name))?),
            };
            Some((device, row, said))
        });
        Senses(all.collect())
    }

    /// The values at a time, for a robot at this position.
    pub fn at(&self, at: Instant, robot: Option<Pose2>) -> Vec<Sensed> {
        let one = |(device, row, said): &(&DeviceRow, &SignalRow, Said)| match said {
            Said::Values(all) => {
                let later = all.partition_point(|(when, _)| *when <= at);
                let (_, value) = all.get(later.checked_sub(1)?)?;
                (*value != Datum::Unset).then(|| Sensed::value(device, row, value))
            }
            Said::Ranges(all) => {
                let later = all.partition_point(|heard| heard.at <= at);
                let &Heard { pose, half_angle, range, .. } = all.get(later.checked_sub(1)?)?;
                let pose = robot.map_or(pose, |robot| robot.beyond(pose));
                Some(Sensed::range(device, row, Cone { pose, half_angle, range }))
            }
        };
        self.0.iter().filter_map(one).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ECHO: &[SignalRow] = &[row("echo", SignalType::Range)];
    const TONE: &[SignalRow] = &[row("tone", SignalType::Float("Hz"))];

    const fn row(name: &'static str, ty: SignalType) -> SignalRow {
        SignalRow { name, ty, truth: false, help: "" }
    }

    const fn device(name: &'static str, signals: &'static [SignalRow]) -> DeviceRow {
        DeviceRow { name, help: "", controls: &[], faults: &[], signals }
    }

    const fn range(name: &'static str) -> DeviceRow {
        device(name, ECHO)
    }

    static SPEAKER: [DeviceRow; 1] = [device("signals", TONE)];
    static TABLE: [DeviceRow; 2] = [range("front"), range("back")];

    #[test]
    fn each_of_several_range_sensors_has_its_last_reading() {
        let heard = |second: u64, device: &str, range| Heard {
            device: device.into(),
            at: Instant::from_nanos(second * 1_000_000_000),
            pose: Pose2::default(),
            half_angle: 0.1,
            range: Some(range),
        };
        let rangings = vec![heard(1, "front", 1.5), heard(2, "back", 0.5), heard(4, "back", 2.0)];
        let mut log = LogData { rangings, ..LogData::default() };
        let senses = Senses::take(&mut log, &TABLE);
        let said = |second: u64| -> Vec<_> {
            let all = senses.at(Instant::from_nanos(second * 1_000_000_000), None);
            all.into_iter().map(|it| format!("{} {}", it.signal, it.text)).collect()
        };
        assert_eq!(said(0), [""; 0]);
        assert_eq!(said(3), ["front.echo 1.5 m", "back.echo 50 cm"]);
        assert_eq!(said(9), ["front.echo 1.5 m", "back.echo 2 m"]);
    }
    #[test]
    fn a_silent_sensor_has_no_value() {
        let second = |second: u64| Instant::from_nanos(second * 1_000_000_000);
        let said = vec![(second(1), Datum::Float(880.0)), (second(2), Datum::Unset)];
        let samples = [("signals/tone".to_owned(), said)].into();
        let senses = Senses::take(&mut LogData { samples, ..LogData::default() }, &SPEAKER);
        assert_eq!(senses.at(second(1), None).len(), 1);
        assert_eq!(senses.at(second(2), None), []);
    }
}
