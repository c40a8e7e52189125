//! The line of a real driver, with a simulated robot at its other end.

use std::io;

use afp_carbot::table::{Control, Fault};
use afp_core::Instant;
use afp_drive::{Command, Report, Setup};
use afp_pi::{Behind, Heard, Line};
use afp_platform::{LastResort, RealTime, Settings};
use afp_session::{Active, Figure, Pose2, Put, Refused, RequestError, Robot, Samples};

use super::plant::Plant;

/// A line to a plant.
pub struct Looped<L> {
    pub line: L,
    pub plant: Plant,
    /// The devices that the real robot does not have.
    pub lacks: Vec<&'static str>,
}

impl<L: Line> Line for Looped<L> {
    const PROFILE: &'static str = L::PROFILE;
    /// The truth is known.
    const LACKS: &'static [&'static str] =
        &["infrared", "color", "camera", "battery", "localisation", "signals"];

    fn open(_: &Settings, _: &Setup) -> io::Result<Self> {
        // It is made with its plant.
        Err(io::Error::other("a simulated robot has no device"))
    }

    fn begin(&mut self) {
        self.line.begin();
    }

    fn send(&mut self, command: &Command, now: Instant) {
        self.line.send(command, now);
    }

    fn discard(&mut self) {
        self.line.discard();
    }

    fn hear(&mut self, time: &RealTime) -> Option<Heard<Report>> {
        self.line.hear(time)
    }

    fn last_resort(&self) -> Option<LastResort> {
        self.line.last_resort()
    }

    fn release(&self) {
        self.line.release();
    }

    fn simulated(&self) -> Option<&dyn Behind> {
        Some(self)
    }
}

impl<L: Line> Behind for Looped<L> {
    fn press(&self, control: Control, held: bool) -> Result<(), Refused> {
        let device = match control {
            Control::ButtonsEscape => "buttons",
            Control::Touch => "touch",
        };
        match self.lacks.contains(&device) {
            true => Err(Refused),
            false => self.plant.with(|robot| robot.press(control, held)),
        }
    }

    fn set_faults(&self, active: &Active<'_, Fault>) -> Result<(), Refused> {
        self.plant.with(|robot| robot.set_faults(active))
    }

    fn put(&self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        self.plant.with(|robot| robot.put(what, at))
    }

    fn check_put(&self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        self.plant.with(|robot| robot.check_put(what, at))
    }

    fn sample(&self, to: &mut Samples<'_, '_>) {
        self.plant.with(|robot| robot.sample_facts(to));
    }

    fn figures(&self) -> Vec<Figure> {
        self.plant.with(|robot| robot.figures())
    }
}
