//! Random places for a robot.

use super::World;
use crate::noise::Source;
use crate::truth::Pose;

/// The maximum number of tried places.
const TRIES: u32 = 1000;

impl World {
    /// A random free pose from a seed, with the obstacles at their start and at least this distance
    /// from the robot's start, in metres. `None` if a thousand tries find no pose, for example in a
    /// world without obstacles.
    pub fn free_pose(&self, seed: u64, apart: f64) -> Option<Pose> {
        let corners = self.obstacles.iter().flat_map(|obstacle| obstacle.outline.corners());
        let (low, high) =
            corners.fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(low, high), at| {
                ([0, 1].map(|i| at[i].min(low[i])), [0, 1].map(|i| at[i].max(high[i])))
            });
        if !low.iter().chain(&high).all(|edge| edge.is_finite()) {
            return None;
        }
        let mut noise = Source::Places.of(seed);
        (0..TRIES).find_map(|_| {
            let [x, y] = [0, 1].map(|i| low[i] + (high[i] - low[i]) * noise.uniform());
            let heading = core::f64::consts::TAU * (noise.uniform() - 0.5);
            let pose = Pose { x, y, heading };
            let far = libm::hypot(x - self.start.x, y - self.start.y) >= apart;
            (far && !self.is_beyond([x, y]) && self.obstacle_at(pose).is_none()).then_some(pose)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_random_place_is_free_far_enough_and_reproducible() {
        for seed in 0..20 {
            let room = World::random(seed);
            let pose = room.free_pose(seed, 1.0).expect("a room has such a place");
            assert_eq!(room.obstacle_at(pose), None);
            assert!(libm::hypot(pose.x - room.start.x, pose.y - room.start.y) >= 1.0);
            assert_eq!(room.free_pose(seed, 1.0), Some(pose));
            assert_ne!(room.free_pose(seed + 1, 1.0), Some(pose));
        }
        let nowhere = "version = 1\nname = \"nowhere\"\n[robot]\npose_m_deg = [0, 0, 0]\n";
        assert_eq!(World::parse(nowhere).unwrap().free_pose(0, 0.0), None);
        assert_eq!(World::random(1).free_pose(0, 100.0), None);
    }
}
