//! The line to the controller of the profile `carbot`, with frames of [`afp_wire`].

use std::io;

use afp_core::Instant;
use afp_drive::{Command, LONGEST, Report, Setup, VERSION};
use afp_platform::{LastResort, RealTime, Settings};

use super::Line;
use crate::link::{Heard, Link};

/// The speed of a serial line in baud; a USB port ignores it.
const BAUD: u32 = 115_200;

/// The line to a controller with the program [`afp_drive`].
#[derive(Debug)]
pub struct WireLine {
    link: Link<LONGEST>,
    setup: Setup,
}

impl Line for WireLine {
    const PROFILE: &'static str = "carbot";

    fn open(settings: &Settings, setup: &Setup) -> io::Result<Self> {
        let port = settings.get(Self::PLACE).unwrap_or_default();
        Ok(WireLine { link: Link::open(port, BAUD, VERSION)?, setup: *setup })
    }

    fn begin(&mut self) {
        begin(&mut self.link, &self.setup);
    }

    fn send(&mut self, command: &Command, _: Instant) {
        self.link.send(command);
    }

    fn discard(&mut self) {
        self.link.discard();
    }

    fn hear(&mut self, time: &RealTime) -> Option<Heard<Report>> {
        self.link.hear(time, Report::is_possible)
    }

    fn last_resort(&self) -> Option<LastResort> {
        self.link.last_resort()
    }

    fn release(&self) {
        self.link.release();
    }
}

/// Connects, and starts the controller.
pub(super) fn begin(link: &mut Link<LONGEST>, setup: &Setup) {
    link.hello();
    link.send(&Command::Setup(*setup));
    link.send(&Command::Start);
}
