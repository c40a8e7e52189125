//! The robot's place, in double precision.

use rapier2d::math::Pose as Isometry;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    at: [f64; 2],
    /// Cosine and sine of the heading.
    ahead: [f64; 2],
}

impl Place {
    pub(crate) fn new(position: &Isometry) -> Self {
        let (at, turn) = (position.translation, position.rotation);
        Place {
            at: [f64::from(at.x), f64::from(at.y)],
            ahead: [f64::from(turn.re), f64::from(turn.im)],
        }
    }

    /// The place at this distance ahead and to the left.
    pub(crate) fn beyond(&self, ahead: f64, left: f64) -> [f64; 2] {
        let [x, y] = self.turned([ahead, left]);
        [self.at[0] + x, self.at[1] + y]
    }

    /// A direction of the robot's frame, in the world's frame.
    pub(crate) fn turned(&self, [ahead, left]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = self.ahead;
        [ahead * cos - left * sin, ahead * sin + left * cos]
    }

    /// A direction of the world's frame, in the robot's frame.
    pub(crate) fn towards(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = self.ahead;
        [x * cos + y * sin, y * cos - x * sin]
    }

    /// The position, and the direction as cosine and sine.
    pub(crate) fn parts(&self) -> ([f64; 2], [f64; 2]) {
        (self.at, self.ahead)
    }
}
