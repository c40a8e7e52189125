//! Parts of which a robot that is no Carbot is simulated, in the same worlds and by the same engine.
//!
//! | part | what it is |
//! |---|---|
//! | [`Stage`] | a world and the robot's body in the engine: it is pushed, stepped every [`STEP`], and says what rays meet and what is touched |
//! | [`Chassis`] | the body: a rectangle or a circle with a mass |
//! | [`TwoWheels`] | two driven wheels on one axis: limited motors, slip, what counters see |
//! | [`Footing`] | whatever else touches the floor: friction of all contacts together |
//! | [`RangeSensor`] | a range sensor with a cone of sound, noise, and echoes that are lost |
//! | [`Switch`] | a contact that bounces, for a bumper |
//! | [`WorldOf`] | world files for a robot with such a body, and with tables of its own ([`OwnTables`]) |
//!
//! The line from a sensor to the plan with its faults, seeded noise and the clock of virtual time are in
//! [`afp_platform`]. What is computed here is the same on every machine.

pub use crate::chassis::{Chassis, Footprint};
pub use crate::devices::bumper::Switch;
pub use crate::devices::sonar::{RangeModel, RangeSensor};
pub use crate::stage::{Collision, Met, STEP, Stage, Touch};
pub use crate::vehicle::{Demand, Footing, Motor, Push, Twist, TwoWheels, WheelModel};
pub use crate::world::{Body, NoTables, Obstacle, OwnTables, World, WorldOf};
