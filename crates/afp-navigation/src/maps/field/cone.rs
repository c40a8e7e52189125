//! A cone of sound as rays, and its echo.
//!
//! A wall mirrors sound (Kuc and Siegel, *Physically based simulation model for acoustic sensor
//! robot navigation*, 1987). Sound at a slant is reflected away, and more of it with distance. The
//! nearest place of the cone that returns sound is heard.

use super::{DIRECTIONS, STEP};
use crate::maps::map::Face;
use afp_carbot::devices::Beam;
use nalgebra::Vector2;

/// The maximum slant of an audible wall nearby, and its decrease per metre for a sensor with this
/// range, in radians. The decrease is smaller for longer ranges.
const SLANT: f64 = 0.72;
const SLANT_LOST: f64 = 0.09;
const HEARS: f64 = 4.0;
/// A ray at the cone's edge is fainter: its maximum slant is smaller by this.
const SLANT_LOST_AT_EDGE: f64 = 0.1;

#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    /// Rays to either side of its axis, a direction apart.
    pub(super) side: usize,
    /// Length of the rays, metres.
    pub(super) range: f64,
    /// The decrease of the maximum slant per metre, in radians.
    slant_lost: f64,
}

#[derive(Clone, Copy, Debug)]
struct Met {
    range: f64,
    /// Cosine of the slant.
    cos: f64,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Heard {
    pub(super) range: f64,
    /// The ray of the echo, counted from the right edge of the cone.
    pub(super) ray: u16,
}

impl Cone {
    /// The cone of a sensor on a map without anything farther than `farthest`, in metres.
    pub(super) fn new(beam: &Beam, farthest: f64) -> Self {
        let side = libm::round(beam.opening.si() / 2.0 / STEP) as usize;
        let most = beam.max.si();
        Cone {
            side: side.min(DIRECTIONS / 2 - 1),
            range: most.min(farthest),
            slant_lost: SLANT_LOST * (HEARS / most),
        }
    }

    /// The echoes of a sensor at a place, by direction.
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
        // Slant by ray: several directions hear each ray.
        let met = met.map(|met| met.map(|Met { range, cos }| (range, libm::acos(cos.min(1.0)))));
        std::array::from_fn(|direction| self.listen(&met, direction))
    }

    /// The nearest audible ray.
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

/// Adds a face to the rays that hit it and have no nearer hit.
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
    // The face is the smaller of the two arcs between the corners.
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
