//! The robot's signals for display: values as text, and the cones of range sensors.

use afp_core::devices::{DeviceRow, SignalId, SignalRow, SignalType, signals};
use afp_session::{Datum, Pose2, SampleRef};

use crate::plotted::{Plotted, plotted};

#[derive(Clone, Debug, PartialEq)]
pub struct Sensed {
    /// Its device and name: `touch.touched`.
    pub signal: String,
    /// Its value with a unit.
    pub text: String,
    /// Its value as a number.
    pub plotted: Option<Plotted>,
    /// The view of a range sensor.
    pub cone: Option<Cone>,
}

/// A range sensor's view, in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    pub pose: Pose2,
    /// Half the opening angle, in radians.
    pub half_angle: f64,
    /// The distance in metres; `None` without an echo.
    pub range: Option<f64>,
}

impl Sensed {
    pub fn value(device: &DeviceRow, row: &SignalRow, value: &Datum) -> Sensed {
        let unit = row.ty.unit();
        let sensed = Sensed::new(device, row, value.in_unit(unit).to_string(), None);
        Sensed { plotted: plotted(value, unit), ..sensed }
    }

    /// The value of a range sensor.
    pub fn range(device: &DeviceRow, row: &SignalRow, cone: Cone) -> Sensed {
        let heard = cone.range.map(Datum::Float);
        let text = heard.as_ref().map(|range| range.in_unit("m").to_string());
        let text = text.unwrap_or_else(|| "no echo".to_owned());
        let plotted = heard.and_then(|range| plotted(&range, "m"));
        Sensed { plotted, ..Sensed::new(device, row, text, Some(cone)) }
    }

    fn new(device: &DeviceRow, row: &SignalRow, text: String, cone: Option<Cone>) -> Sensed {
        let signal = format!("{}.{}", device.name, row.name);
        Sensed { signal, text, plotted: None, cone }
    }
}

/// Passes the present sample of a signal on, if there is one.
type Read<'r> = dyn Fn(SignalId, &mut dyn FnMut(SampleRef<'_>)) + 'r;

/// Reads all signals that a plan may use, in device order and without pictures; `robot` is its
/// pose.
pub(crate) fn all(
    devices: &'static [DeviceRow],
    read: &Read<'_>,
    robot: Option<Pose2>,
) -> Vec<Sensed> {
    let mut all = Vec::new();
    for (signal, device, row) in signals(devices).filter(|(.., row)| !row.truth) {
        let mut take = |sample: SampleRef<'_>| {
            let heard = match (sample, sample.value()) {
                (SampleRef::Range(heard), _) => heard,
                (_, Some(value)) => return all.push(Sensed::value(device, row, &value)),
                (_, None) => return,
            };
            let pose = robot.map_or(heard.pose, |robot| robot.beyond(heard.pose));
            let cone = Cone { pose, half_angle: heard.half_angle, range: heard.range };
            all.push(Sensed::range(device, row, cone));
        };
        match row.ty {
            SignalType::Pose | SignalType::Image | SignalType::Outline => {}
            _ => read(signal, &mut take),
        }
    }
    all
}
