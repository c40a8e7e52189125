//! The plan of the paper drives the robot through its room: room, robot and tuning fit the plan.

use afp::load::{LoadedPlan, Registry};
use afp_core::rt::NamedPlan;
use afp_core::trace::{ComponentKind, Names, Record, Sink};
use afp_core::{Duration, Instant, Scheduler, StillClock, Wake};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_sim::{Simulation, World};
use afp_syntax::source::Source;

const ROOM: &str = include_str!("../../../worlds/wall_following.toml");
const PLAN: &str = include_str!("../../../plans/wall_following.afp");

struct Actors<N> {
    names: N,
    started: Vec<(Instant, String)>,
}

impl<N: Names> Sink for Actors<N> {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        if let Record::Started { component } = *record {
            let name = self.names.component(component);
            if name.kind == ComponentKind::Actor {
                self.started.push((at, name.path.to_owned()));
            }
        }
    }
}

#[derive(Debug, Default)]
struct Outcome {
    /// The actors in the order of their activations.
    path: Vec<String>,
    /// Bumps into the low step, and other collisions.
    bumps: usize,
    others: usize,
    /// Mean and maximum absolute wall error, in metres, and the number of counted seconds. The
    /// seconds of `followWall` with a wall next to it count, except for the first two of each
    /// activation.
    error: f64,
    worst: f64,
    counted: f64,
}

fn load() -> LoadedPlan<Simulation> {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("wall_following.afp", PLAN), &toolboxes, &Texts::default());
    let messages = compiled.render(false);
    let graph = compiled.graph.expect(&messages);
    let mut registry = Registry::new();
    afp_std::templates::register(&mut registry);
    afp_carbot::templates::register(&mut registry);
    LoadedPlan::new(&graph, &registry).expect("every template has its component")
}

fn run(seed: u64) -> Outcome {
    let world = World::parse(ROOM).expect("the room is well-formed");
    let mut sim = Simulation::new(&world, seed).expect("the room can be built");
    let plan = load();
    let mut sink = Actors { names: plan.names(), started: Vec::new() };
    let mut scheduler = Scheduler::new(plan);
    let start = scheduler.start((&mut sim, &mut sink, &StillClock), Instant::ZERO);
    let mut wake = start.expect("the plan starts");
    let mut out = Outcome::default();
    for tick in 1..=3000 {
        let look = Instant::ZERO + Duration::from_millis(20 * tick);
        while let Wake::At(due) = wake
            && due <= look
        {
            sim.advance_to(due);
            wake = scheduler.step((&mut sim, &mut sink, &StillClock), due);
        }
        sim.advance_to(look);
        let (since, actor) = sink.started.last().expect("something was started");
        if actor == "followWall" && look.since(*since) >= Duration::from_secs(2) {
            let Some(gap) = sim.truth().right_side_wall() else { continue };
            out.error += (gap - 0.3).abs();
            out.worst = out.worst.max((gap - 0.3).abs());
            out.counted += 0.02;
        }
    }
    let step = world.obstacles.iter().position(|obstacle| obstacle.name == "low step");
    let collisions = sim.truth().collisions();
    out.bumps = collisions.iter().filter(|c| Some(c.obstacle) == step).count();
    out.others = collisions.len() - out.bumps;
    out.error *= 0.02 / out.counted;
    out.path = sink.started.into_iter().map(|(_, name)| name).collect();
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
    for seed in 0..20 {
        let out = run(seed);
        let path: Vec<&str> = out.path.iter().map(String::as_str).collect();
        assert!(path.starts_with(&expected), "seed {seed}: {out:?}");
        assert_eq!((out.bumps, out.others), (1, 0), "seed {seed}: {out:?}");
        assert!(out.error < 0.015 && out.worst < 0.04, "seed {seed}: {out:?}");
        assert!(out.counted > 18.0, "seed {seed}: {out:?}");
    }
}
