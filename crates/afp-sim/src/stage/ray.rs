//! Rays from the robot, and their hits.

use super::{HIGH, ROBOT, Stage};
use rapier2d::geometry::{InteractionGroups, InteractionTestMode};
use rapier2d::math::Vector;
use rapier2d::prelude::{QueryFilter, QueryPipeline, Ray};

/// The hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// The distance, in metres.
    pub range: f64,
    /// The cosine of the angle between the ray and the surface's normal.
    pub cos: f64,
    /// The index in [`Stage::obstacles`].
    pub obstacle: usize,
}

pub(crate) struct Rays<'a> {
    queries: QueryPipeline<'a>,
    stage: &'a Stage,
    origin: Vector,
    /// The heading as cosine and sine.
    ahead: (f64, f64),
}

impl Stage {
    /// The hit of a ray that begins `forward` of the body's middle, at a bearing against the
    /// heading in radians. Hits are within `most` metres, and obstacles lower than
    /// [`Chassis::ranging_height`] are ignored.
    ///
    /// [`Chassis::ranging_height`]: crate::parts::Chassis::ranging_height
    pub fn ray(&self, forward: f64, bearing: f64, most: f64) -> Option<Met> {
        let rays = self.rays(forward);
        rays.cast(rays.along(bearing), most)
    }

    pub(crate) fn rays(&self, forward: f64) -> Rays<'_> {
        let (at, turn) = (self.position().translation, self.position().rotation);
        let heard = InteractionGroups::new(ROBOT, HIGH, InteractionTestMode::And);
        Rays {
            queries: self.physics.query_pipeline_with_filter(QueryFilter::new().groups(heard)),
            stage: self,
            origin: at + Vector::new(turn.re, turn.im) * forward as f32,
            ahead: (f64::from(turn.re), f64::from(turn.im)),
        }
    }
}

impl Rays<'_> {
    /// A bearing against the heading as a direction of the world.
    pub(crate) fn along(&self, bearing: f64) -> (f64, f64) {
        let (sin, cos) = libm::sincos(bearing);
        let (re, im) = self.ahead;
        (re * cos - im * sin, im * cos + re * sin)
    }

    pub(crate) fn cast(&self, (x, y): (f64, f64), most: f64) -> Option<Met> {
        let direction = Vector::new(x as f32, y as f32);
        let ray = Ray::new(self.origin, direction);
        let (of, hit) = self.queries.cast_ray_and_get_normal(&ray, most as f32, true)?;
        let cos = f64::from(-hit.normal.dot(direction));
        let obstacle = self.stage.physics.colliders[of].user_data as usize;
        Some(Met { range: f64::from(hit.time_of_impact), cos, obstacle })
    }

    /// The share of the sound that an obstacle returns.
    pub(crate) fn echo(&self, obstacle: usize) -> f64 {
        self.stage.obstacles.get(obstacle).map_or(1.0, |it| it.echo)
    }
}
