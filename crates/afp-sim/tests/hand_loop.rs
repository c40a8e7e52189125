//! Wall following by a hand-written loop over the templates: shows that room, robot and tuning
//! suit the plan of the paper, with no scheduler in between.

mod hand_loop {
    pub mod plan;
}

use afp_core::{Duration, Instant};
use afp_sim::{Simulation, World};
use hand_loop::plan::{Active, Plan};

/// What a run came to.
#[derive(Debug, Default)]
struct Outcome {
    /// The active elements in their order.
    path: Vec<&'static str>,
    /// Bumps into the low step, and other collisions.
    bumps: usize,
    others: usize,
    /// Mean absolute wall error, metres, and how many seconds count.
    error: f64,
    counted: f64,
}

/// Runs a minute; the wall error counts from 2 s after the beginning of each `followWall`.
fn run(seed: u64) -> Outcome {
    let text = include_str!("../../../worlds/wall_following.toml");
    let world = World::parse(text).expect("the room is well-formed");
    let mut sim = Simulation::new(&world, seed).expect("the room can be built");
    let mut plan = Plan::start(&mut sim);
    let mut out = Outcome::default();
    for ms in 1..=60_000 {
        let now = Instant::ZERO + Duration::from_millis(ms);
        sim.advance_to(now);
        plan.step(&mut sim, now);
        if out.path.last() != Some(&plan.name()) {
            out.path.push(plan.name());
        }
        if let Active::FollowWall { since, .. } = plan.active()
            && ms % 20 == 0
            && now.since(*since) >= Duration::from_secs(2)
        {
            let gap = sim.truth().right_side_gap().expect("the room has walls");
            out.error += (gap - 0.3).abs();
            out.counted += 0.02;
        }
    }
    let step = world.obstacles.iter().position(|obstacle| obstacle.name == "low step");
    let collisions = sim.truth().collisions();
    out.bumps = collisions.iter().filter(|c| Some(c.obstacle) == step).count();
    out.others = collisions.len() - out.bumps;
    out.error *= 0.02 / out.counted;
    out
}

#[test]
fn the_robot_bumps_once_finds_the_wall_and_comes_back_to_it_at_the_outer_corner() {
    let expected = [
        "searchFirstWall",
        "backupCollision",
        "findWallAngle",
        "turnAfterWallLost",
        "searchFirstWall",
        "findWallAngle",
        "parallelToWall",
        "followWall",
        "findWallAngle",
        "parallelToWall",
        "followWall",
        "turnAfterWallLost",
        "searchFirstWall",
        "findWallAngle",
        "parallelToWall",
        "followWall",
    ];
    for seed in 0..10 {
        let out = run(seed);
        assert!(out.path.starts_with(&expected), "seed {seed}: {out:?}");
        assert_eq!((out.bumps, out.others), (1, 0), "seed {seed}: {out:?}");
        assert!(out.error < 0.015, "seed {seed}: {out:?}");
        assert!(out.counted > 18.0, "seed {seed}: {out:?}");
    }
}
