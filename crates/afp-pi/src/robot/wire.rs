//! The line to the controller of the profile `carbot`, with frames of [`afp_wire`].

use std::io;

use afp_core::Instant;
use afp_drive::{Command, LONGEST, Report, Setup, VERSION};
use afp_platform::{LastResort, RealTime};

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

    fn open(port: &str, setup: &Setup) -> io::Result<Self> {
        Ok(WireLine { link: Link::open(port, BAUD, VERSION)?, setup: *setup })
    }

    fn begin(&mut self) {
        self.link.hello();
        self.link.send(&Command::Setup(self.setup));
        self.link.send(&Command::Start);
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
