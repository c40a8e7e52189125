//! The world of cameras and light sensors: upright solids on a painted floor.

use crate::world::{Look, Mobility, Obstacle, Patch, Rgb, World};
use std::sync::Arc;

#[derive(Clone, Debug)]
pub(crate) struct Scene {
    fixed: Arc<[Solid]>,
    moving: Vec<Solid>,
    floor: Arc<Floor>,
}

/// A convex solid with upright sides.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    /// Corners in the solid's frame, counter-clockwise, in metres.
    local: Arc<[[f64; 2]]>,
    /// Corners in the world's frame.
    corners: Vec<[f64; 2]>,
    centre: [f64; 2],
    radius: f64,
    pub(crate) height: f64,
    pub(crate) look: Look,
}

/// The crossing of a ray and a solid; distances in lengths of the ray's direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// Where the ray enters and leaves; the first distance is negative if the ray begins inside.
    pub(crate) enter: f64,
    pub(crate) leave: f64,
    /// The distance along the side to the entry, in metres.
    pub(crate) along: f64,
    /// The side's normal, of length 1.
    pub(crate) normal: [f64; 2],
}

#[derive(Debug)]
struct Floor {
    look: Look,
    patches: Vec<Patch>,
}

impl Scene {
    pub(crate) fn new(world: &World) -> Self {
        let (fixed, moving): (Vec<_>, Vec<_>) =
            world.obstacles.iter().partition(|obstacle| obstacle.mobility == Mobility::Fixed);
        Scene {
            fixed: fixed.into_iter().map(Solid::new).collect(),
            moving: moving.into_iter().map(Solid::new).collect(),
            floor: Arc::new(Floor { look: world.floor, patches: world.patches.clone() }),
        }
    }

    /// Moves the `n`-th movable solid: its place and its direction as cosine and sine, relative to
    /// its place in the world's file.
    pub(crate) fn place(&mut self, n: usize, at: [f64; 2], direction: [f64; 2]) {
        if let Some(solid) = self.moving.get_mut(n) {
            solid.place(at, direction);
        }
    }

    /// Adds a movable solid after all others.
    pub(crate) fn add(&mut self, obstacle: &Obstacle) {
        self.moving.push(Solid::new(obstacle));
    }

    /// Every solid that a ray meets, with the crossing; fixed solids first.
    pub(crate) fn cross(
        &self,
        origin: [f64; 2],
        direction: [f64; 2],
    ) -> impl Iterator<Item = (&Solid, Crossing)> {
        self.solids().filter_map(move |solid| Some((solid, solid.cross(origin, direction)?)))
    }

    pub(crate) fn solids(&self) -> impl Iterator<Item = &Solid> {
        self.fixed.iter().chain(&self.moving)
    }

    /// A place on the `n`-th solid, in the same scene at another time.
    pub(crate) fn carried(&self, later: &Scene, n: usize, at: [f64; 2]) -> Option<[f64; 2]> {
        let ([from, along], [to, along_to]) = (self.solid(n)?.frame(), later.solid(n)?.frame());
        let off = [at[0] - from[0], at[1] - from[1]];
        let (a, b) = (dot(along, off), along[0] * off[1] - along[1] * off[0]);
        Some([to[0] + a * along_to[0] - b * along_to[1], to[1] + a * along_to[1] + b * along_to[0]])
    }

    fn solid(&self, n: usize) -> Option<&Solid> {
        self.solids().nth(n)
    }

    /// Whether a solid is between two places, each with a height.
    pub(crate) fn between(&self, (a, low): ([f64; 2], f64), (b, high): ([f64; 2], f64)) -> bool {
        let direction = [b[0] - a[0], b[1] - a[1]];
        self.cross(a, direction).any(|(solid, crossing)| {
            let (enter, leave) = (crossing.enter.max(0.0), crossing.leave.min(1.0));
            let height = |share: f64| low + (high - low) * share;
            enter < leave && height(enter).min(height(leave)) < solid.height
        })
    }

    pub(crate) fn floor(&self, at: [f64; 2]) -> Rgb {
        let patches = self.floor.patches.iter().rev();
        let mut over = patches.filter(|patch| contains(&patch.corners, at));
        over.next().map_or_else(|| self.floor.look.at(at[0], at[1]), |patch| patch.color)
    }
}

impl Solid {
    fn new(obstacle: &Obstacle) -> Self {
        let local: Arc<[_]> = obstacle.outline.corners().into();
        let mut solid = Solid {
            corners: Vec::with_capacity(local.len()),
            local,
            centre: [0.0, 0.0],
            radius: 0.0,
            height: obstacle.height,
            look: obstacle.look,
        };
        solid.place([0.0, 0.0], [1.0, 0.0]);
        solid
    }

    fn place(&mut self, [x, y]: [f64; 2], [cos, sin]: [f64; 2]) {
        let placed = self.local.iter().map(|[a, b]| [x + a * cos - b * sin, y + a * sin + b * cos]);
        self.corners.clear();
        self.corners.extend(placed);
        let sum = self.corners.iter().fold([0.0, 0.0], |sum, c| [sum[0] + c[0], sum[1] + c[1]]);
        self.centre = sum.map(|sum| sum / self.corners.len() as f64);
        let far = |c: &[f64; 2]| libm::hypot(c[0] - self.centre[0], c[1] - self.centre[1]);
        self.radius = self.corners.iter().map(far).fold(0.0, f64::max);
    }

    /// Its first corner, and the direction from there to the second, of length 1.
    fn frame(&self) -> [[f64; 2]; 2] {
        let [from, to] = [0, 1].map(|n| self.corners.get(n).copied().unwrap_or(self.centre));
        let side = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(side[0], side[1]).max(f64::MIN_POSITIVE);
        [from, side.map(|part| part / length)]
    }

    /// The entry and exit of a ray; `None` if it misses the solid or the solid is behind its start.
    pub(crate) fn cross(&self, origin: [f64; 2], direction: [f64; 2]) -> Option<Crossing> {
        let to = [self.centre[0] - origin[0], self.centre[1] - origin[1]];
        let aside = direction[0] * to[1] - direction[1] * to[0];
        let ahead = direction[0] * to[0] + direction[1] * to[1];
        let reach = self.radius * self.radius * dot(direction, direction);
        if aside * aside > reach || (ahead < 0.0 && ahead * ahead > reach) {
            return None;
        }
        let mut crossing = Crossing {
            enter: f64::NEG_INFINITY,
            leave: f64::INFINITY,
            along: 0.0,
            normal: [0.0; 2],
        };
        for (i, &a) in self.corners.iter().enumerate() {
            let b = self.corners[(i + 1) % self.corners.len()];
            let side = [b[0] - a[0], b[1] - a[1]];
            let outward = [side[1], -side[0]];
            let towards = dot(outward, direction);
            let inside = dot(outward, [a[0] - origin[0], a[1] - origin[1]]);
            let at = inside / towards;
            if towards == 0.0 {
                if inside < 0.0 {
                    return None;
                }
            } else if towards > 0.0 {
                crossing.leave = crossing.leave.min(at);
            } else if at > crossing.enter {
                let length = libm::hypot(side[0], side[1]);
                let met = [0, 1].map(|k| origin[k] + direction[k] * at - a[k]);
                crossing.enter = at;
                crossing.along = dot(met, side) / length;
                crossing.normal = outward.map(|part| part / length);
            }
        }
        (crossing.enter <= crossing.leave && crossing.leave >= 0.0).then_some(crossing)
    }
}

/// Whether a convex polygon with corners in counter-clockwise order contains a place.
fn contains(corners: &[[f64; 2]], at: [f64; 2]) -> bool {
    corners.iter().enumerate().all(|(i, a)| {
        let b = corners[(i + 1) % corners.len()];
        (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]) >= 0.0
    })
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(rest: &str) -> Scene {
        let text = format!("version = 1\n[robot]\npose_m_deg = [0, 0, 0]\n{rest}");
        Scene::new(&World::parse(&text).unwrap())
    }

    const BOX: &str = "[[box]]\npose_m_deg = [2, 0, 0]\nsize_m = [1, 2]\nheight_m = 0.5\n";

    #[test]
    fn a_ray_enters_and_leaves_a_box() {
        let scene = scene(BOX);
        let meet = |origin, direction| scene.cross(origin, direction).next().map(|(_, c)| c);
        let crossing = meet([0.0, 0.5], [0.5, 0.0]).unwrap();
        assert_eq!((crossing.enter, crossing.leave), (3.0, 5.0));
        assert_eq!(crossing.normal, [-1.0, 0.0]);
        assert!((crossing.along - 0.5).abs() < 1e-12, "{crossing:?}");
        assert_eq!(meet([0.0, 1.1], [1.0, 0.0]), None);
        assert_eq!(meet([3.0, 0.0], [1.0, 0.0]), None);
        assert!(meet([2.0, 0.0], [1.0, 0.0]).unwrap().enter < 0.0);
        assert_eq!(meet([0.0, 0.0], [-1.0, 0.0]), None);
    }

    #[test]
    fn a_ray_passes_over_low_solids() {
        let scene = scene(BOX);
        let eye = ([0.0, 0.0], 0.2);
        assert!(scene.between(eye, ([4.0, 0.0], 0.2)));
        assert!(scene.between(eye, ([4.0, 0.0], 0.9)));
        assert!(!scene.between(eye, ([2.6, 0.0], 3.0)));
        assert!(!scene.between(([0.0, 0.0], 0.6), ([4.0, 0.0], 0.6)));
        assert!(!scene.between(eye, ([1.0, 0.0], 0.2)), "the box is beyond");
    }

    #[test]
    fn the_last_patch_is_on_top() {
        let patch = |color: &str, size: f64| {
            format!(
                "[[patch]]\npoints_m = [[0, 0], [{size}, 0], [0, {size}]]\ncolor = \"{color}\"\n"
            )
        };
        let floor = "[floor]\ncolor = \"#0a0a0a\"\n";
        let scene = scene(&format!("{floor}{}{}", patch("#ff0000", 2.0), patch("#00ff00", 1.0)));
        assert_eq!(scene.floor([0.2, 0.2]), [0, 255, 0]);
        assert_eq!(scene.floor([0.9, 0.9]), [255, 0, 0]);
        assert_eq!(scene.floor([-0.1, 0.2]), [10, 10, 10]);
    }
}
