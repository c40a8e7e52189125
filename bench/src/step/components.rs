//! The components of the plan, written against templates as `toolbox!` makes them.

use afp_core::quantity::Length;
use afp_core::rt::Ports;
use afp_core::{
    Actor, ActorTemplate, Events, Fault, Instant, Poll, Supervisor, SupervisorTemplate, ValueRef,
};

use super::board::{Board, speed};

/// Templates.
pub mod templates {
    pub struct CheckButton;
    pub struct CheckTouch;
    pub struct CheckRange;
    pub struct CheckBattery;
    pub struct Drive;
}

macro_rules! ports {
    ($name:ident { $($port:ident: $ty:ty),* }) => {
        #[derive(Clone, Copy)]
        pub struct $name { $(pub $port: $ty),* }
        impl Ports for $name {
            #[inline]
            fn check(&self) -> Result<(), Fault> {
                $(if !f64::from(self.$port).is_finite() { return Err(Fault::ARITHMETIC); })*
                Ok(())
            }
            fn each(&self, see: &mut dyn FnMut(u16, ValueRef<'_>)) {
                let mut _port = 0;
                $(see(_port, ValueRef::Float(f64::from(self.$port))); _port += 1;)*
                let _ = see;
            }
        }
    };
}

ports!(NoPorts {});
ports!(BatteryInputs { low: f64 });
ports!(DriveInputs { distance: f64, gain: f64 });

#[derive(Clone, Copy)]
pub struct RangeLive {
    pub limit: Length,
}

impl Ports for RangeLive {
    #[inline]
    fn check(&self) -> Result<(), Fault> {
        if !self.limit.si().is_finite() {
            return Err(Fault::ARITHMETIC);
        }
        Ok(())
    }
    fn each(&self, see: &mut dyn FnMut(u16, ValueRef<'_>)) {
        see(0, ValueRef::Float(self.limit.si()));
    }
}

#[derive(Clone, Copy)]
pub enum Alarm {
    Raised,
}

#[derive(Clone, Copy)]
pub enum DriveState {
    Arrived { driven: Length },
}

impl SupervisorTemplate for templates::CheckButton {
    type Inputs<'a> = NoPorts;
    type Live<'a> = NoPorts;
    type Event = Alarm;
}
impl SupervisorTemplate for templates::CheckTouch {
    type Inputs<'a> = NoPorts;
    type Live<'a> = NoPorts;
    type Event = Alarm;
}
impl SupervisorTemplate for templates::CheckRange {
    type Inputs<'a> = NoPorts;
    type Live<'a> = RangeLive;
    type Event = Alarm;
}
impl SupervisorTemplate for templates::CheckBattery {
    type Inputs<'a> = BatteryInputs;
    type Live<'a> = NoPorts;
    type Event = Alarm;
}
impl ActorTemplate for templates::Drive {
    type Inputs<'a> = DriveInputs;
    type Live<'a> = NoPorts;
    type State = DriveState;
}

pub struct CheckButton;
pub struct CheckTouch;
pub struct CheckRange;
pub struct CheckBattery {
    low: f64,
}
pub struct Drive {
    goal: f64,
    gain: f64,
}

impl Supervisor<templates::CheckButton, Board> for CheckButton {
    fn start(_: NoPorts, _: Events, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(CheckButton)
    }
    #[inline]
    fn poll(&mut self, _: NoPorts, board: &mut Board, _: Instant) -> Result<Option<Alarm>, Fault> {
        Ok((board.buttons & 1 != 0).then_some(Alarm::Raised))
    }
}

impl Supervisor<templates::CheckTouch, Board> for CheckTouch {
    fn start(_: NoPorts, _: Events, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(CheckTouch)
    }
    #[inline]
    fn poll(&mut self, _: NoPorts, board: &mut Board, _: Instant) -> Result<Option<Alarm>, Fault> {
        Ok(board.touched.then_some(Alarm::Raised))
    }
}

impl Supervisor<templates::CheckRange, Board> for CheckRange {
    fn start(_: NoPorts, _: Events, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(CheckRange)
    }
    #[inline]
    fn poll(
        &mut self,
        live: RangeLive,
        board: &mut Board,
        _: Instant,
    ) -> Result<Option<Alarm>, Fault> {
        Ok((board.range < live.limit.si()).then_some(Alarm::Raised))
    }
}

impl Supervisor<templates::CheckBattery, Board> for CheckBattery {
    fn start(inputs: BatteryInputs, _: Events, _: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(CheckBattery { low: inputs.low })
    }
    #[inline]
    fn poll(&mut self, _: NoPorts, board: &mut Board, _: Instant) -> Result<Option<Alarm>, Fault> {
        Ok((board.battery < self.low).then_some(Alarm::Raised))
    }
}

impl Actor<templates::Drive, Board> for Drive {
    fn start(inputs: DriveInputs, board: &mut Board, _: Instant) -> Result<Self, Fault> {
        Ok(Drive { goal: board.odometer + inputs.distance, gain: inputs.gain })
    }
    #[inline]
    fn poll(
        &mut self,
        _: NoPorts,
        board: &mut Board,
        _: Instant,
    ) -> Result<Poll<DriveState>, Fault> {
        let left = self.goal - board.odometer;
        if left <= 0.0 {
            board.command = 0.0;
            return Ok(Poll::Ready(DriveState::Arrived {
                driven: Length::from_si(board.odometer),
            }));
        }
        board.command = speed(left, self.gain);
        Ok(Poll::Pending)
    }
    fn interrupt(&mut self, board: &mut Board, _: Instant) -> Result<(), Fault> {
        board.command = 0.0;
        Ok(())
    }
}
