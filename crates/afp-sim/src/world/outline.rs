//! Outlines seen from above.

use crate::truth::Pose;
use rapier2d::math::{Pose as Isometry, Rotation, Vector};
use rapier2d::parry::shape::SharedShape;

/// The outline of an obstacle, seen from above.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A rectangle around its middle, turned by the pose's heading.
    Box {
        /// The pose of its middle.
        pose: Pose,
        /// Half its length and width, in metres.
        half: [f64; 2],
    },
    /// A convex polygon, metres in the world's frame, counter-clockwise.
    Polygon(Vec<[f64; 2]>),
}

impl Outline {
    /// The corners in the world's frame, metres, counter-clockwise.
    pub fn corners(&self) -> Vec<[f64; 2]> {
        match self {
            Outline::Box { pose, half } => rectangle(*pose, *half).to_vec(),
            Outline::Polygon(corners) => corners.clone(),
        }
    }

    /// The outline as parry's shape with its place; `None` for a polygon without an area.
    pub(crate) fn shape(&self) -> Option<(Isometry, SharedShape)> {
        match self {
            Outline::Box { pose, half } => {
                Some((isometry(*pose), SharedShape::cuboid(half[0] as f32, half[1] as f32)))
            }
            Outline::Polygon(corners) => {
                let corners = corners.iter().map(|c| Vector::new(c[0] as f32, c[1] as f32));
                let shape = SharedShape::convex_polyline(corners.collect())?;
                Some((Isometry::identity(), shape))
            }
        }
    }
}

/// The corners of a rectangle, counter-clockwise.
pub(super) fn rectangle(pose: Pose, [x, y]: [f64; 2]) -> [[f64; 2]; 4] {
    let (sin, cos) = libm::sincos(pose.heading);
    [[x, y], [-x, y], [-x, -y], [x, -y]]
        .map(|[x, y]| [pose.x + x * cos - y * sin, pose.y + x * sin + y * cos])
}

/// A pose for rapier; through `libm`, like all trigonometry here.
pub(crate) fn isometry(pose: Pose) -> Isometry {
    let (sin, cos) = libm::sincos(pose.heading);
    Isometry::from_parts(
        Vector::new(pose.x as f32, pose.y as f32),
        Rotation::from_cos_sin_unchecked(cos as f32, sin as f32),
    )
}
