//! The space that a robot needs, from its body.

use afp_carbot::devices::Body;

/// The robot's distance from obstacles, in centimetres. The sum is rounded up: a grid is coarser
/// than a centimetre.
const KEPT: f64 = 1.0;
/// The additional space that makes all places equal, in centimetres. A robot with less space at its
/// start leaves through such places within this distance.
const COMFORT: f64 = 17.0;
/// The additional space beyond which more makes no difference, in centimetres.
const ENOUGH: f64 = 32.0;

/// The space that a robot needs, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Room {
    /// The robot can turn in place if no obstacle is within this distance of its middle.
    pub(crate) fits: f32,
    /// Clearance beyond which all pieces of a path are equal.
    pub(crate) comfort: f32,
    /// The distance from its start within which it may be closer to obstacles.
    pub(crate) leaving: f64,
    /// More clearance than this makes no difference.
    pub(crate) most: f32,
}

impl Room {
    pub(crate) fn of(body: &Body) -> Self {
        let fits = libm::ceil(100.0 * body.radius().si() + KEPT);
        let metres = |centimetres: f64| centimetres / 100.0;
        let leaving = metres(fits + COMFORT);
        let [fits, comfort, most] =
            [fits, fits + COMFORT, fits + ENOUGH].map(|it| metres(it) as f32);
        Room { fits, comfort, leaving, most }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use afp_core::quantity::Length;

    /// A body of this length and width, in metres, that turns about its middle.
    pub(crate) fn body(length: f64, width: f64) -> Body {
        let [half_length, half_width] = [length, width].map(|side| Length::from_si(side / 2.0));
        Body { front: half_length, rear: half_length, half_width }
    }

    pub(crate) fn carbot() -> Body {
        body(0.4, 0.35)
    }

    #[test]
    fn a_robot_needs_the_space_of_its_corners() {
        let carbots = Room { fits: 0.28, comfort: 0.45, leaving: 0.45, most: 0.6 };
        assert_eq!(Room::of(&carbot()), carbots);
        assert_eq!(Room::of(&body(1.2, 0.9)).fits, 0.76);
        let tail = Body { rear: Length::from_si(0.4), ..carbot() };
        assert_eq!(Room::of(&tail).fits, 0.45);
    }
}
