//! The robot, which has no devices and no world.

use std::convert::Infallible;

use afp::core::Platform;
use afp::core::devices::{ControlId, DeviceRow, Devices, FaultId};
use afp::load::{ActorSlot, Args, BadValue, Outputs, See, SupervisorSlot};
use afp::{Environment, Events, Fault, Instant, StillClock};
use afp_session::{NoWorld, Robot, Samples, Simulated};

/// The robot of all stand-ins.
#[derive(Clone, Debug, Default)]
pub struct StandIn {
    now: Instant,
}

/// No devices.
pub struct Nothing;

impl Devices for Nothing {
    const TABLE: &'static [DeviceRow] = &[];
    type Control = ();
    type Fault = ();

    fn control(_: ControlId) -> Option<()> {
        None
    }

    fn fault(_: FaultId, _: Option<f64>) -> Option<()> {
        None
    }
}

impl Environment for StandIn {
    fn stop(&mut self, _: Instant) {}

    fn emergency_stop(&mut self) {}
}

impl Platform for StandIn {
    type Clock = StillClock;

    fn clock(&self) -> StillClock {
        StillClock
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn advance(&mut self, to: Instant) {
        self.now = self.now.max(to);
    }
}

impl Robot for StandIn {
    type Devices = Nothing;

    fn sample(&self, _: &mut Samples<'_, '_>) {}
}

impl Simulated for StandIn {
    type World = NoWorld;
    type Error = Infallible;

    fn new(_: &NoWorld, _: u64) -> Result<StandIn, Infallible> {
        Ok(StandIn::default())
    }
}

/// A stand-in for a component.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part;

impl ActorSlot<StandIn> for Part {
    fn start(
        &mut self,
        _: &dyn Args,
        _: See<'_>,
        _: &mut StandIn,
        _: Instant,
    ) -> Result<(), BadValue> {
        Ok(())
    }

    fn poll(
        &mut self,
        _: &dyn Args,
        _: &mut dyn Outputs,
        _: &mut StandIn,
        _: Instant,
    ) -> Result<Option<u16>, BadValue> {
        Ok(None)
    }

    fn interrupt(&mut self, _: &mut StandIn, _: Instant) -> Result<(), Fault> {
        Ok(())
    }

    fn clear(&mut self) {}
}

impl SupervisorSlot<StandIn> for Part {
    fn start(
        &mut self,
        _: &dyn Args,
        _: See<'_>,
        _: &mut StandIn,
        _: Instant,
    ) -> Result<(), BadValue> {
        Ok(())
    }

    fn poll(
        &mut self,
        _: &dyn Args,
        _: Events,
        _: &mut dyn Outputs,
        _: &mut StandIn,
        _: Instant,
    ) -> Result<Option<u16>, BadValue> {
        Ok(None)
    }

    fn clear(&mut self) {}
}
