//! What logs and pictures show of an instant.

use super::Simulation;
use crate::truth::Pose;
use afp_carbot::devices::{Frame, Motion};
use afp_core::Instant;

/// The robot at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snapshot {
    /// The instant.
    pub time: Instant,
    /// The true pose.
    pub pose: Pose,
    /// What the odometry believes, against the start.
    pub odometry: Motion,
    /// Where the rotator points against the heading, radians.
    pub rotator: f64,
    /// The latest echo; none before the first.
    pub sonar: Option<Sonar>,
    /// Whether the bumper is pressed.
    pub touched: bool,
}

/// A completed ping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sonar {
    /// When it was sent.
    pub time: Instant,
    /// Where the sensor pointed against the heading, radians.
    pub bearing: f64,
    /// The distance heard, metres; none for silence.
    pub distance: Option<f64>,
}

impl Simulation {
    /// The latest picture of the camera, whatever its line makes of it, and when it was taken; `None`
    /// before the first. It is drawn when it is first looked at.
    pub fn view(&self) -> Option<(Instant, Frame<'_>)> {
        let exposure = self.sensors.exposure.value.as_ref().ok()?;
        Some((self.sensors.exposure.time, exposure.frame()))
    }

    /// What logs and pictures show of this instant.
    pub fn snapshot(&self) -> Snapshot {
        let sonar = self.sensors.echo.value.ok().map(|echo| Sonar {
            time: self.sensors.echo.time,
            bearing: echo.bearing.si(),
            distance: echo.distance.map(|distance| distance.si()),
        });
        Snapshot {
            time: self.now,
            pose: self.truth().pose(),
            odometry: self.sensors.odometer.motion(),
            rotator: self.sensors.rotator.position(),
            sonar,
            touched: self.is_touched(),
        }
    }
}
