//! How much room a robot needs, by its body.

use afp_carbot::devices::Body;

/// A robot keeps so far from things, centimetres; the sum is rounded up: a grid is coarser than a centimetre.
const KEPT: f64 = 1.0;
/// With so much more room, centimetres, it is as good anywhere; and from where it stands it gets out of less so far away.
const COMFORT: f64 = 17.0;
/// More than so much more makes no difference, centimetres.
const ENOUGH: f64 = 32.0;

/// The room that a robot needs, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Room {
    /// It turns in place wherever nothing is within so much of its middle.
    pub(crate) fits: f32,
    /// A piece of its path with so much clearance is as good as any.
    pub(crate) comfort: f32,
    /// Where it stands it may be closer to things, within so much of its middle.
    pub(crate) leaving: f64,
    /// More clearance than this makes no difference.
    pub(crate) most: f32,
}

impl Room {
    /// Of a robot with this body.
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

    /// A body so long and wide, metres, that turns about its middle.
    pub(crate) fn body(length: f64, width: f64) -> Body {
        let [half_length, half_width] = [length, width].map(|side| Length::from_si(side / 2.0));
        Body { front: half_length, rear: half_length, half_width }
    }

    pub(crate) fn carbot() -> Body {
        body(0.4, 0.35)
    }

    #[test]
    fn a_robot_needs_the_room_that_its_corners_reach() {
        let carbots = Room { fits: 0.28, comfort: 0.45, leaving: 0.45, most: 0.6 };
        assert_eq!(Room::of(&carbot()), carbots);
        assert_eq!(Room::of(&body(1.2, 0.9)).fits, 0.76);
        let tail = Body { rear: Length::from_si(0.4), ..carbot() };
        assert_eq!(Room::of(&tail).fits, 0.45);
    }
}
