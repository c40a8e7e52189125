//! The state of an instant in logs and pictures.

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
    /// The odometry, relative to the start.
    pub odometry: Motion,
    /// The rotator's angle relative to the heading, in radians.
    pub rotator: f64,
    /// The latest echo; `None` before the first.
    pub sonar: Option<Sonar>,
    /// Whether the bumper is pressed.
    pub touched: bool,
}

/// A completed ping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sonar {
    /// The time of the ping.
    pub time: Instant,
    /// The sensor's bearing relative to the heading, in radians.
    pub bearing: f64,
    /// The measured distance, in metres; `None` for silence.
    pub distance: Option<f64>,
}

impl Simulation {
    /// The camera's latest picture, before its line, and its time; `None` before the first picture.
    /// It is rendered on first use.
    pub fn view(&self) -> Option<(Instant, Frame<'_>)> {
        let exposure = self.sensors.exposure.value.as_ref().ok()?;
        Some((self.sensors.exposure.time, exposure.frame()))
    }

    /// The state of this instant for logs and pictures.
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
