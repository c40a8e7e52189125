//! How often plans reach their goal in rooms made up; `AFP_GOALS` says from which seed on the rooms are taken and in how
//! many, as in `AFP_GOALS=5000..100`.

use std::f64::consts::FRAC_PI_4;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::{env, thread};

use afp_core::trace::Ending;
use afp_core::{Duration, Instant};
use afp_sim::{Pose, World};
use afp_worlds::{Case, plan, run};

/// Rooms unless told otherwise: the first seed and how many.
const ROOMS: (u64, usize) = (1000, 12);

fn rooms() -> (u64, usize) {
    let Ok(text) = env::var("AFP_GOALS") else { return ROOMS };
    let parts = text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    parts.unwrap_or_else(|| panic!("AFP_GOALS={text}: not FIRST..COUNT"))
}

/// Drives the plan for so long in the first rooms that are `fit`; the seeds of those where it does not end as OK.
fn misses(name: &str, seconds: u64, fit: impl Fn(&World) -> bool) -> Vec<u64> {
    let (first, count) = rooms();
    let seeds: Vec<u64> = (first..).filter(|seed| fit(&World::random(*seed))).take(count).collect();
    let (next, missed) = (AtomicUsize::new(0), Mutex::new((Vec::new(), Duration::ZERO)));
    let work = || {
        while let Some(seed) = seeds.get(next.fetch_add(1, Ordering::Relaxed)) {
            let until = Instant::ZERO + Duration::from_secs(seconds);
            let quiet = Case::quiet(plan(name), World::random(*seed), *seed);
            let outcome = run(&Case { until, ..quiet });
            let mut missed = missed.lock().unwrap_or_else(PoisonError::into_inner);
            if outcome.ending != Some(Ending::Ok) {
                println!("{name} in random:{seed}: {:?}", outcome.ending);
                missed.0.push(*seed);
            }
            missed.1 = missed.1.max(outcome.pushing);
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    let (mut missed, longest) = missed.into_inner().unwrap_or_else(PoisonError::into_inner);
    missed.sort_unstable();
    let last = seeds.last().copied().unwrap_or(first);
    println!(
        "{name}: {} of {count} reach their goal, rooms {first}..={last}",
        count - missed.len()
    );
    println!("  pushed for {longest} at most; missed in {missed:?}");
    missed
}

/// Whether the goal is missed in one of so many rooms at most.
fn is_rare(missed: &[u64], of: usize) -> bool {
    missed.len() * of <= rooms().1
}

/// Whether the robot's pose is in the room, and not inside of anything.
fn is_free(world: &World, pose: Pose) -> bool {
    let corners = world.obstacles.iter().flat_map(|obstacle| obstacle.outline.corners());
    let size = corners.fold([0.0_f64; 2], |size, at| [size[0].max(at[0]), size[1].max(at[1])]);
    let inside = [pose.x, pose.y].iter().zip(size).all(|(at, size)| (0.3..size - 0.4).contains(at));
    inside && world.obstacle_at(pose).is_none()
}

/// The directions in steps of an eighth of a turn.
fn headings() -> impl Iterator<Item = f64> {
    (0..8).map(|eighth| f64::from(eighth) * FRAC_PI_4)
}

/// Whether the place two metres ahead of the robot's start is in the room, and free for the robot in any direction.
fn goal_is_free(world: &World) -> bool {
    let Pose { x, y, heading } = world.start;
    let [x, y] = [x + 2.0 * heading.cos(), y + 2.0 * heading.sin()];
    headings().all(|heading| is_free(world, Pose { x, y, heading }))
}

/// Whether the robot has a place from which the beacon is as bright as wanted: half a metre before its sensor.
fn beacon_can_be_reached(world: &World) -> bool {
    /// From the turning centre to the beacon, metres.
    const FAR: f64 = 0.6;
    let [x, y] = world.lights[0].position;
    headings().any(|heading| {
        let [x, y] = [x - FAR * heading.cos(), y - FAR * heading.sin()];
        is_free(world, Pose { x, y, heading })
    })
}

#[test]
fn what_stands_in_the_way_is_rounded() {
    let missed = misses("avoid_obstacle", 300, goal_is_free);
    assert!(is_rare(&missed, 6), "{missed:?}");
}

#[test]
fn the_beacon_is_found_within_a_minute() {
    let missed = misses("find_infrared", 60, beacon_can_be_reached);
    // Behind furniture it takes longer than a minute.
    assert!(is_rare(&missed, 3), "{missed:?}");
}
