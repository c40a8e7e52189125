//! The camera: pictures of the scene at the camera's own rate, rendered only on demand.

mod render;
mod track;

use crate::scene::Scene;
use crate::vehicle::Place;
use afp_carbot::devices::{Frame, Lens};
use afp_core::Duration;
use afp_core::quantity::{Angle, Length};
use afp_navigation::flow::{FlowJob, FlowSensor, LucasKanade};
use afp_platform::VirtualWorker;
use std::sync::OnceLock;

pub(crate) use track::track;

/// The interval between pictures.
pub(crate) const PERIOD: Duration = Duration::from_millis(50);
/// The camera's position ahead of the turning centre and above the floor, in metres.
pub(crate) const FORWARD: f64 = 0.18;
pub(crate) const HEIGHT: f64 = 0.20;
/// The horizontal field of view, in radians.
const OPENING: f64 = 70.0 / 180.0 * core::f64::consts::PI;
const COLUMNS: usize = 160;
const ROWS: usize = 120;

pub(crate) fn lens() -> Lens {
    Lens {
        forward: Length::from_si(FORWARD),
        height: Length::from_si(HEIGHT),
        opening: Angle::from_si(OPENING),
        columns: COLUMNS,
        rows: ROWS,
    }
}

/// The flow sensor for the camera's pictures, in virtual time.
pub(crate) fn flow_sensor() -> FlowSensor<LucasKanade, VirtualWorker<FlowJob<LucasKanade>>> {
    let job = FlowJob::new(COLUMNS, ROWS, LucasKanade::new(COLUMNS, ROWS));
    FlowSensor::new(COLUMNS, ROWS, VirtualWorker::new([job]))
}

/// A picture; it is rendered on first use.
#[derive(Debug)]
pub(crate) struct Exposure {
    scene: Scene,
    robot: Place,
    /// The seed for the noise of only this picture.
    seed: u64,
    number: u64,
    rgb: OnceLock<Vec<u8>>,
}

impl Exposure {
    /// The `number`-th picture, from a robot at this place.
    pub(crate) fn new(scene: Scene, robot: Place, seed: u64, number: u64) -> Self {
        Exposure { scene, robot, seed, number, rgb: OnceLock::new() }
    }

    pub(crate) fn frame(&self) -> Frame<'_> {
        let draw = || render::render(&self.scene, self.robot, self.seed ^ (self.number << 32));
        let rgb = self.rgb.get_or_init(draw);
        Frame { width: COLUMNS, height: ROWS, rgb, number: self.number }
    }
}
