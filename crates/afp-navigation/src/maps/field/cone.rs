//! A cone of sound as rays, and what of it comes back.
//!
//! A wall mirrors sound (Kuc and Siegel, *Physically based simulation model for acoustic sensor robot navigation*, 1987):
//! what meets it at a slant goes elsewhere, the sooner the farther away it is. The nearest place of the cone that sends
//! sound back is heard.

use super::{DIRECTIONS, STEP};
use crate::maps::map::Face;
use afp_carbot::devices::Beam;
use nalgebra::Vector2;

/// A wall is heard up to this slant from close by, and up to so much less for each metre by a sensor that hears so many
/// metres far, radians; one that hears farther loses less.
const SLANT: f64 = 0.72;
const SLANT_LOST: f64 = 0.09;
const HEARS: f64 = 4.0;
/// A ray at the cone's edge is fainter: heard up to so much less.
const SLANT_LOST_AT_EDGE: f64 = 0.1;

/// What a sensor listens to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    /// Rays to either side of its axis, a direction apart.
    pub(super) side: usize,
    /// Where they end, metres.
    pub(super) range: f64,
    /// A wall is heard up to so much less slant for each metre, radians.
    slant_lost: f64,
}

/// What a ray meets.
#[derive(Clone, Copy, Debug)]
struct Met {
    range: f64,
    /// Of the slant at which it meets it.
    cos: f64,
}

/// An echo.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heard {
    pub(super) range: f64,
    /// The ray that it comes by, counted from the right edge of the cone.
    pub(super) ray: u16,
}

impl Cone {
    /// Of a sensor, where nothing is farther away than `farthest`, metres.
    pub(super) fn new(beam: &Beam, farthest: f64) -> Self {
        let side = libm::round(beam.opening.si() / 2.0 / STEP) as usize;
        let most = beam.max.si();
        Cone {
            side: side.min(DIRECTIONS / 2 - 1),
            range: most.min(farthest),
            slant_lost: SLANT_LOST * (HEARS / most),
        }
    }

    /// What a sensor at a place hears, direction by direction.
    pub(super) fn echoes(
        self,
        faces: &[Face],
        directions: &[Vector2<f64>],
        from: Vector2<f64>,
    ) -> [Option<Heard>; DIRECTIONS] {
        let mut met = [None; DIRECTIONS];
        for face in faces {
            cast(face, directions, from, self.range, &mut met);
        }
        // Slant by ray: each is heard by several directions.
        let met = met.map(|met| met.map(|Met { range, cos }| (range, libm::acos(cos.min(1.0)))));
        std::array::from_fn(|direction| self.listen(&met, direction))
    }

    /// The nearest ray that is heard.
    fn listen(self, met: &[Option<(f64, f64)>; DIRECTIONS], direction: usize) -> Option<Heard> {
        let side = self.side;
        let rays = (0..=2 * side).filter_map(|ray| {
            let (range, slant) = (*met.get((direction + DIRECTIONS + ray - side) % DIRECTIONS)?)?;
            let edge = ray.abs_diff(side) as f64 / side.max(1) as f64;
            let far = (range - 1.0).max(0.0);
            let heard = SLANT - self.slant_lost * far - SLANT_LOST_AT_EDGE * edge * edge;
            (slant <= heard).then_some(Heard { range, ray: ray as u16 })
        });
        rays.min_by(|a, b| a.range.total_cmp(&b.range))
    }
}

/// Lets a face be met by the rays that reach it, where nothing nearer is.
fn cast(
    face: &Face,
    directions: &[Vector2<f64>],
    from: Vector2<f64>,
    range: f64,
    met: &mut [Option<Met>; DIRECTIONS],
) {
    let off = (from - face.from).dot(&face.normal);
    if off <= 0.0 || off > range {
        return;
    }
    let angle = |corner: Vector2<f64>| {
        let to = corner - from;
        libm::atan2(to.y, to.x) / STEP
    };
    let (one, other) = (angle(face.from), angle(face.to));
    let (least, most) = (one.min(other), one.max(other));
    // Of the two arcs between the corners the face is the smaller one.
    let turns = DIRECTIONS as f64;
    let (first, last) =
        if most - least > turns / 2.0 { (most, least + turns) } else { (least, most) };
    for n in libm::ceil(first) as i64..=libm::floor(last) as i64 {
        let n = n.rem_euclid(DIRECTIONS as i64) as usize;
        let (Some(along), Some(nearest)) = (directions.get(n), met.get_mut(n)) else { continue };
        let cos = -along.dot(&face.normal);
        let far = off / cos;
        if cos > 0.0 && far <= range && nearest.is_none_or(|met| far < met.range) {
            *nearest = Some(Met { range: far, cos });
        }
    }
}
