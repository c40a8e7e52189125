//! A robot that looks like a real robot to this test.

use std::convert::Infallible;

use afp_carbot::table::Carbot;
use afp_core::{Environment, Instant, Platform, StillClock};
use afp_session::{Hardware, Robot, Samples, Settings};

pub struct Board;

impl Environment for Board {
    fn stop(&mut self, _: Instant) {}

    fn emergency_stop(&mut self) {}
}

impl Platform for Board {
    type Clock = StillClock;

    fn clock(&self) -> StillClock {
        StillClock
    }

    fn now(&self) -> Instant {
        Instant::ZERO
    }

    fn advance(&mut self, _: Instant) {}
}

impl Robot for Board {
    type Devices = Carbot;

    fn sample(&self, _: &mut Samples<'_, '_>) {}
}

impl Hardware for Board {
    type Error = Infallible;

    fn open(_: &Settings) -> Result<Board, Infallible> {
        Ok(Board)
    }
}
