//! The robot's body in the engine and in worlds: a shape with a mass.

use crate::truth::Pose;
use rapier2d::parry::shape::SharedShape;

/// Half the length of the Carbot's body, metres; the turning centre is its middle.
pub const HALF_LENGTH: f64 = 0.20;
/// Half its width, metres.
pub const HALF_WIDTH: f64 = 0.175;
/// Its mass, kilograms.
pub(crate) const MASS: f64 = 4.7;
/// The number of corners of a circle in pictures.
const CORNERS: u32 = 32;

/// The measures in which robots made of parts differ from the Carbot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// Half the length and half the width of the body, in metres.
    pub half: [f64; 2],
    /// The driven wheels' distance ahead of the turning centre and to its sides, in metres. Wheels
    /// ahead of it steer.
    pub wheels: [f64; 2],
    /// The radius of the narrowest curve, in metres; 0 for a robot that turns in place.
    pub narrowest: f64,
    /// The top speed of a wheel's rim, in metres a second.
    pub fastest: f64,
    /// The distance from the turning centre ahead to the range sensor, in metres.
    pub sonar: f64,
    /// Whether the wheels have encoders. Otherwise the odometry counts the commands.
    pub encoders: bool,
}

impl Measures {
    /// The Carbot's measures.
    pub const CARBOT: Measures = Measures {
        half: [HALF_LENGTH, HALF_WIDTH],
        wheels: [0.13, 0.14],
        narrowest: 0.0,
        fastest: 0.31,
        sonar: 0.10,
        encoders: true,
    };

    /// The chassis. Only its outline differs from the Carbot's.
    pub(crate) fn chassis(&self) -> Chassis {
        Chassis { shape: Footprint::Box(self.half), ..Chassis::CARBOT }
    }
}

/// A robot's body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chassis {
    /// The outline from above.
    pub shape: Footprint,
    /// Kilograms, spread evenly.
    pub mass: f64,
    /// The height, in metres, for logs.
    pub height: f64,
    /// The range sensor does not detect obstacles lower than this, in metres.
    pub ranging_height: f64,
}

/// The shape of a body, seen from above, relative to its turning centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Footprint {
    /// A rectangle: half its length and half its width, metres.
    Box([f64; 2]),
    /// A circle of this radius, metres.
    Round(f64),
}

impl Chassis {
    /// The Carbot's chassis.
    pub const CARBOT: Chassis = Chassis {
        shape: Footprint::Box([HALF_LENGTH, HALF_WIDTH]),
        mass: MASS,
        height: 0.22,
        ranging_height: 0.15,
    };

    /// Whether the range sensor detects an obstacle of this height, in metres.
    pub fn hears(&self, height: f64) -> bool {
        height >= self.ranging_height
    }

    /// Inertia about the turning centre, kilogram square metres.
    pub fn inertia(&self) -> f64 {
        match self.shape {
            Footprint::Box([length, width]) => self.mass * (length * length + width * width) / 3.0,
            Footprint::Round(radius) => self.mass * radius * radius / 2.0,
        }
    }

    /// Its outline at a pose, in metres, counter-clockwise. A circle becomes a polygon.
    pub fn outline(&self, at: Pose) -> Vec<[f64; 2]> {
        let (sin, cos) = libm::sincos(at.heading);
        let placed = |[x, y]: [f64; 2]| [at.x + x * cos - y * sin, at.y + x * sin + y * cos];
        match self.shape {
            Footprint::Box([x, y]) => [[x, y], [-x, y], [-x, -y], [x, -y]].map(placed).to_vec(),
            Footprint::Round(radius) => {
                let turn = core::f64::consts::TAU / f64::from(CORNERS);
                let corner = |n| libm::sincos(f64::from(n) * turn);
                let corners = (0..CORNERS).map(corner);
                corners.map(|(sin, cos)| placed([radius * cos, radius * sin])).collect()
            }
        }
    }

    /// The shape in the engine.
    pub(crate) fn shared(&self) -> SharedShape {
        match self.shape {
            Footprint::Box([x, y]) => SharedShape::cuboid(x as f32, y as f32),
            Footprint::Round(radius) => SharedShape::ball(radius as f32),
        }
    }
}
