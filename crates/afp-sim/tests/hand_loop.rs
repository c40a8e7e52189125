//! Wall following by a hand-written loop over the templates: which room and which tuning suit
//! the plan of the paper, without a scheduler in between.

mod hand_loop {
    pub mod plan;
    pub mod svg;
}

use afp_core::{Duration, Instant};
use afp_sim::{Simulation, World};
use hand_loop::plan::{Active, Plan};

const ROOM: &str = include_str!("../../../worlds/wall_following.toml");

/// What a run came to.
#[derive(Debug, Default)]
struct Outcome {
    /// The low step was bumped into so often.
    bumps: usize,
    /// Other collisions.
    collisions: usize,
    /// Mean absolute wall error and its largest value, metres.
    mean: f64,
    worst: f64,
    /// Seconds that count.
    counted: f64,
    /// The elements in order of activation.
    path: String,
    follows: usize,
}

fn run(seed: u64, seconds: u64) -> (Outcome, Vec<(f64, f64)>) {
    let world = World::parse(ROOM).expect("the room is well-formed");
    let mut sim = Simulation::new(&world, seed).expect("the room can be built");
    let mut plan = Plan::start(&mut sim);
    let mut out = Outcome::default();
    let (mut sum, mut n, mut trace) = (0.0, 0usize, Vec::new());
    let mut active = String::new();
    for ms in 1..=seconds * 1000 {
        let now = Instant::ZERO + Duration::from_millis(ms);
        sim.advance_to(now);
        plan.step(&mut sim, now);
        if ms % 20 != 0 {
            continue;
        }
        let truth = sim.truth();
        let pose = truth.pose();
        if std::env::var("DBG").is_ok()
            && let Active::FollowWall { actor, .. } = plan.active()
        {
            println!(
                "{ms} {:.3} {:.3} {:.1} gap {:.3} {:.300?}",
                pose.x,
                pose.y,
                pose.heading.to_degrees(),
                truth.right_side_gap().unwrap(),
                format!("{:?}", sim.snapshot().sonar)
                    + &format!("{actor:?}")
                        .split_once("heard")
                        .map_or(String::new(), |p| p.1.to_owned())
            );
        }
        trace.push((pose.x, pose.y));
        if let Active::FollowWall { since, .. } = plan.active()
            && now.since(*since) >= Duration::from_secs(2)
        {
            let error = (truth.right_side_gap().unwrap() - 0.3).abs();
            sum += error;
            n += 1;
            out.worst = out.worst.max(error);
        }
        if active != plan.name() {
            active = plan.name().to_owned();
            out.follows += usize::from(active == "followWall");
            out.path += &format!(
                "{:.1} {active} ({:.2},{:.2},{:.0}) ",
                ms as f64 / 1000.0,
                pose.x,
                pose.y,
                pose.heading.to_degrees()
            );
        }
    }
    let low = world.obstacles.iter().position(|o| o.name == "low step");
    for collision in sim.truth().collisions() {
        if Some(collision.obstacle) == low { out.bumps += 1 } else { out.collisions += 1 }
    }
    out.mean = sum / n.max(1) as f64;
    out.counted = n as f64 * 0.02;
    (out, trace)
}

#[test]
fn survey() {
    let world = World::parse(ROOM).unwrap();
    let seeds: u64 = std::env::var("SEEDS").map_or(3, |s| s.parse().unwrap());
    let seconds: u64 = std::env::var("SECS").map_or(60, |s| s.parse().unwrap());
    let first: u64 = std::env::var("FIRST").map_or(0, |s| s.parse().unwrap());
    for seed in first..first + seeds {
        let (out, trace) = run(seed, seconds);
        println!(
            "{seed}: bumps {} other {} mean {:.4} worst {:.3} counted {:.1} follows {}",
            out.bumps, out.collisions, out.mean, out.worst, out.counted, out.follows
        );
        if seeds <= 5 {
            println!("   {}", out.path.replace(") ", ")\n   "));
        }
        if seed < 4 {
            std::fs::write(
                format!("/tmp/t-sim/path{seed}.svg"),
                hand_loop::svg::draw(&world, &trace),
            )
            .unwrap();
        }
    }
}
