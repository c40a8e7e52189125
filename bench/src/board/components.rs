//! The components of the toolbox `board`.

use afp_core::{Actor, Duration, Events, Fault, Instant, Poll, Resumable, Supervisor};

use super::{Board, speed, templates};
use templates::{check_battery, check_button, check_range, check_touch, drive, hop};

#[derive(Clone)]
pub struct Drive {
    goal: f64,
    gain: f64,
}

/// Acts for one poll.
#[derive(Clone)]
pub struct Hop {
    next: i64,
}

#[derive(Clone)]
pub struct CheckButton;

/// Watches the bumper.
#[derive(Clone)]
pub struct CheckTouch;

/// Watches the distance ahead.
#[derive(Clone)]
pub struct CheckRange;

#[derive(Clone)]
pub struct CheckBattery {
    low: f64,
}

impl Actor<templates::Drive, Board> for Drive {
    fn start(inputs: drive::Inputs, board: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(Drive { goal: board.odometer + inputs.distance.si(), gain: inputs.gain.si() })
    }

    #[inline]
    fn poll(
        &mut self,
        _: drive::Live,
        board: &mut Board,
        _: Instant,
    ) -> Result<Poll<drive::State>, Fault> {
        let left = self.goal - board.odometer;
        if left <= 0.0 {
            board.command = 0.0;
            return Ok(Poll::Ready(drive::State::Arrived));
        }
        board.command = speed(left, self.gain);
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, board: &mut Board, _: Instant) -> Result<(), Fault> {
        board.command = 0.0;
        Ok(())
    }
}

impl Resumable<templates::Drive, Board> for Drive {
    fn suspend(&mut self, board: &mut Board, _: Instant) -> Result<(), Fault> {
        board.command = 0.0;
        Ok(())
    }

    fn resume(&mut self, _: &mut Board, _: Instant, _: Duration) -> Result<(), Fault> {
        Ok(())
    }
}

impl Actor<templates::Hop, Board> for Hop {
    #[inline]
    fn start(inputs: hop::Inputs, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(Hop { next: inputs.value.wrapping_add(1) })
    }

    #[inline]
    fn poll(
        &mut self,
        _: hop::Live,
        board: &mut Board,
        _: Instant,
    ) -> Result<Poll<hop::State>, Fault> {
        board.command = 0.0;
        Ok(Poll::Ready(hop::State::Done { next: self.next }))
    }

    fn interrupt(&mut self, board: &mut Board, _: Instant) -> Result<(), Fault> {
        board.command = 0.0;
        Ok(())
    }
}

impl Supervisor<templates::CheckButton, Board> for CheckButton {
    #[inline]
    fn start(_: check_button::Inputs, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(CheckButton)
    }

    #[inline]
    fn poll(
        &mut self,
        _: check_button::Live,
        _: Events,
        board: &mut Board,
        _: Instant,
    ) -> Result<Option<check_button::Event>, Fault> {
        Ok((board.buttons & 1 != 0).then_some(check_button::Event::Pressed))
    }
}

impl Supervisor<templates::CheckTouch, Board> for CheckTouch {
    #[inline]
    fn start(_: check_touch::Inputs, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(CheckTouch)
    }

    #[inline]
    fn poll(
        &mut self,
        _: check_touch::Live,
        _: Events,
        board: &mut Board,
        _: Instant,
    ) -> Result<Option<check_touch::Event>, Fault> {
        Ok(board.touched.then_some(check_touch::Event::Touched))
    }
}

impl Supervisor<templates::CheckRange, Board> for CheckRange {
    #[inline]
    fn start(_: check_range::Inputs, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(CheckRange)
    }

    #[inline]
    fn poll(
        &mut self,
        live: check_range::Live,
        _: Events,
        board: &mut Board,
        _: Instant,
    ) -> Result<Option<check_range::Event>, Fault> {
        Ok((board.range < live.limit.si()).then_some(check_range::Event::TooNear))
    }
}

impl Supervisor<templates::CheckBattery, Board> for CheckBattery {
    #[inline]
    fn start(inputs: check_battery::Inputs, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(CheckBattery { low: inputs.low.si() })
    }

    #[inline]
    fn poll(
        &mut self,
        _: check_battery::Live,
        _: Events,
        board: &mut Board,
        _: Instant,
    ) -> Result<Option<check_battery::Event>, Fault> {
        Ok((board.battery < self.low).then_some(check_battery::Event::Low))
    }
}
