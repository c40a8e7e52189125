//! Parts for simulations of other robots, in the same worlds and engine.
//!
//! | part | meaning |
//! |---|---|
//! | [`Stage`] | a world and the robot's body in the engine: pushes, steps every [`STEP`], rays and contacts |
//! | [`Chassis`] | the body: a rectangle or a circle with a mass |
//! | [`TwoWheels`] | two driven wheels on one axis: limited motors, slip, counters |
//! | [`Footing`] | other contacts with the floor: friction of all contacts together |
//! | [`RangeSensor`] | a range sensor with a cone of sound, noise, and lost echoes |
//! | [`Switch`] | a bouncing contact, for a bumper |
//! | [`WorldOf`] | world files for a robot with such a body and its own tables ([`OwnTables`]) |
//!
//! The line from a sensor to the plan with its faults, seeded noise and the clock of virtual time
//! are in [`afp_platform`]. All results are the same on every machine.

pub use crate::chassis::{Chassis, Footprint};
pub use crate::devices::bumper::Switch;
pub use crate::devices::sonar::{RangeModel, RangeSensor};
pub use crate::stage::{Collision, Met, STEP, Stage, Touch};
pub use crate::vehicle::{Demand, Footing, Motor, Push, Twist, TwoWheels, WheelModel};
pub use crate::world::{Body, NoTables, Obstacle, OwnTables, World, WorldOf};
