//! What the robot's signals said in a run that is over, at any time of it.

use afp_core::Instant;
use afp_core::devices::{DeviceRow, SignalRow, SignalType, signals};
use afp_debug::{Cone, Sensed};
use afp_log::{Heard, LogData};
use afp_session::{Datum, Pose2};

/// What a signal said, by time.
enum Said {
    Values(Vec<(Instant, Datum)>),
    Ranges(Vec<Heard>),
}

/// What a log tells of the signals of a robot.
pub struct Senses(Vec<(&'static DeviceRow, &'static SignalRow, Said)>);

impl Senses {
    /// Takes what a log has of the signals that a plan may know.
    pub fn take(log: &mut LogData, devices: &'static [DeviceRow]) -> Self {
        let all = signals(devices).filter(|(.., row)| !row.truth).filter_map(|(_, device, row)| {
            let said = match row.ty {
                // A log does not say which of several range sensors heard something: they are all the first one.
                SignalType::Range => Said::Ranges(std::mem::take(&mut log.rangings)),
                _ => Said::Values(log.samples.remove(&format!("{}/{}", device.name, row.name))?),
            };
            Some((device, row, said))
        });
        Senses(all.collect())
    }

    /// What they said at a time, when the robot stood somewhere.
    pub fn at(&self, at: Instant, robot: Option<Pose2>) -> Vec<Sensed> {
        let one = |(device, row, said): &(&DeviceRow, &SignalRow, Said)| match said {
            Said::Values(all) => {
                let later = all.partition_point(|(when, _)| *when <= at);
                let (_, value) = all.get(later.checked_sub(1)?)?;
                Some(Sensed::value(device, row, value))
            }
            Said::Ranges(all) => {
                let later = all.partition_point(|heard| heard.at <= at);
                let Heard { pose, half_angle, range, .. } = *all.get(later.checked_sub(1)?)?;
                let pose = robot.map_or(pose, |robot| robot.beyond(pose));
                Some(Sensed::range(device, row, Cone { pose, half_angle, range }))
            }
        };
        self.0.iter().filter_map(one).collect()
    }
}
