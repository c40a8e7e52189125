//! The robot finds itself on its map.

use crate::wanderer::Wanderer;
use afp_carbot::devices::{
    Aim, Localisation, Navigator, Odometry, PathPlanner, TouchSensor, Trip, Ultrasonic,
};
use afp_core::quantity::Length;
use afp_core::{Duration, Instant, Poll};
use afp_navigation::maps::{EchoField, Filter, LocateJob, Locator, Planner, SearchJob};
use afp_platform::VirtualWorker;
use afp_sim::parts::Chassis;
use afp_sim::{Pose, Simulation, World};

/// The errors while it wanders: metres and degrees, ten times a second.
fn wander(robot: &mut Wanderer, seconds: u64) -> Vec<[f64; 2]> {
    let mut errors = Vec::new();
    for tick in 0..seconds * 100 {
        robot.tick();
        let error = robot.robot.localisation_error().filter(|_| tick % 10 == 0);
        errors.extend(error.map(|[off, turned]| [off, turned.to_degrees()]));
    }
    errors
}

fn p95(errors: &[[f64; 2]], of: usize) -> f64 {
    let mut all: Vec<_> = errors.iter().map(|error| error[of]).collect();
    all.sort_by(f64::total_cmp);
    all[all.len() * 95 / 100]
}

/// `AFP_ROOMS` additional rooms, from number 1000 on; the numbers in the book are from a hundred
/// rooms.
fn rooms(few: u64) -> std::ops::Range<u64> {
    match std::env::var("AFP_ROOMS").ok().and_then(|text| text.parse::<u64>().ok()) {
        Some(many) => 1000..1000 + many,
        None => 0..few,
    }
}

#[test]
fn a_wandering_robot_knows_its_place() {
    let mut errors = Vec::new();
    for seed in rooms(4) {
        let mut robot = Wanderer::new(&World::random(seed), seed);
        errors.extend(wander(&mut robot, 40));
    }
    let (off, turned) = (p95(&errors, 0), p95(&errors, 1));
    println!("95 % within {:.1} cm and {turned:.1} deg", off * 100.0);
    assert!(off < 0.1 && turned < 5.0, "{off} m, {turned} deg");
}

#[test]
fn a_carried_robot_finds_its_position_again() {
    let (mut slow, mut times) = (Vec::new(), Vec::new());
    for seed in rooms(12) {
        let world = World::random(seed);
        let mut robot = Wanderer::new(&world, seed);
        wander(&mut robot, 5);
        let place = robot.free_place(&world);
        robot.robot.carry_to(place);
        let errors = wander(&mut robot, 40);
        // The place is known for a full second, so that it is not an accident.
        let known = errors.windows(10).position(|second| second.iter().all(|[off, _]| *off < 0.15));
        times.extend(known.map(|at| at as f64 / 10.0));
        if known.is_none_or(|at| at > 300) {
            slow.push(seed);
        }
    }
    times.sort_by(f64::total_cmp);
    println!("found again after {times:?} s; not within 30 s: {slow:?}");
    assert!(slow.len() * 10 <= times.len(), "not within 30 s: {slow:?}");
}

/// The belief of a simulation's filter equals the belief of a filter with only map, start and
/// readings. The simulation passes no other ground truth to it.
#[test]
fn the_belief_uses_only_map_and_readings() {
    let world = World::random(5);
    let mut robot = Wanderer::new(&world, 5);
    let beam = robot.robot.beam();
    let filter = Filter::new(
        EchoField::new(world.audible_map(&Chassis::CARBOT), &beam),
        &beam,
        world.start,
        5,
    );
    let mut alone = Locator::new(VirtualWorker::new([LocateJob::new(filter)]), world.start);
    for tick in 1..=1500_u64 {
        robot.tick();
        let (now, motion) = (robot.robot.now(), robot.robot.motion());
        // Echoes that arrived before a ping are handled before the next ping.
        if tick.is_multiple_of(5) {
            alone.on_echo(robot.robot.echo(), motion, now);
        }
        let (its, ours) = (robot.robot.belief(now).unwrap(), alone.belief(motion, now).unwrap());
        assert_eq!(its, ours, "{now}");
    }
}

/// The paths of a simulation equal the paths of a planner with only map, start and readings.
#[test]
fn paths_use_only_map_and_readings() {
    let world = World::random(5);
    let mut robot = Wanderer::new(&world, 5);
    let (beam, body) = (robot.robot.beam(), robot.robot.body());
    let field = || EchoField::new(world.audible_map(&Chassis::CARBOT), &beam);
    let filter = Filter::new(field(), &beam, world.start, 5);
    let mut locator = Locator::new(VirtualWorker::new([LocateJob::new(filter)]), world.start);
    let mut alone: Planner<VirtualWorker<SearchJob>> =
        Planner::new(field(), &body, beam.forward, VirtualWorker::new);
    let metres = |place: [f64; 2]| (Length::from_si(place[0]), Length::from_si(place[1]));
    let there = metres([world.start.x, world.start.y]);
    // Both get readings from the first search on.
    let to = Aim::Place { at: there, near: Length::from_si(0.3) };
    let trip = |from| Trip { from, to };
    let search =
        |robot: &mut Wanderer, alone: &mut Planner<VirtualWorker<SearchJob>>, from, now| {
            let its = robot.robot.search(&trip(from), now).unwrap();
            its.zip(alone.search(&trip(from), now).unwrap())
        };
    let mut under_way = search(&mut robot, &mut alone, there, Instant::ZERO);
    let mut ways = 0;
    for tick in 1..=3000_u64 {
        robot.tick();
        let (now, motion) = (robot.robot.now(), robot.robot.motion());
        let belief = robot.robot.belief(now).unwrap().value.unwrap();
        if tick.is_multiple_of(5) {
            let echo = robot.robot.echo();
            locator.on_echo(echo, motion, now);
            let fresh =
                echo.value.ok().filter(|_| now.since(echo.time) <= Duration::from_millis(50));
            if let Some((echo, place)) = fresh.zip(locator.belief_at(echo.time)) {
                alone.on_echo(&echo, &place, now);
            }
            if robot.robot.touched().value == Ok(true) {
                alone.on_bump(&locator.latest(motion).value.unwrap(), now);
            }
        }
        if let Some((its, ours)) = under_way.take_if(|_| tick % 100 == 10) {
            let its = robot.robot.found(its, now).unwrap();
            let ours = alone.found(ours, now).unwrap();
            let (Poll::Ready(its), Poll::Ready(ours)) = (its, ours) else { panic!("{now}") };
            assert_eq!(its, ours, "{now}");
            ways += u32::from(its.is_some());
        }
        if tick % 100 == 0 {
            under_way = search(&mut robot, &mut alone, (belief.x, belief.y), now);
        }
    }
    assert!(ways > 10, "{ways} ways");
}

#[test]
fn without_odometry_there_is_no_belief() {
    let mut robot = Simulation::new(&World::random(5), 5).unwrap();
    let lost = afp_carbot::table::named("odometry", "lost", None).unwrap();
    robot.inject(lost, Instant::ZERO + Duration::from_secs(1), Duration::MAX);
    robot.belief(Instant::ZERO).unwrap();
    robot.advance_to(Instant::ZERO + Duration::from_millis(900));
    assert!(robot.belief(robot.now()).unwrap().value.is_ok());
    robot.advance_to(Instant::ZERO + Duration::from_millis(1100));
    assert!(robot.belief(robot.now()).unwrap().value.is_err());
}

#[test]
fn a_carried_robot_is_at_its_new_place() {
    let mut robot = Simulation::new(&World::random(5), 5).unwrap();
    let place = Pose { x: 1.0, y: 1.5, heading: 0.5 };
    robot.carry_to(place);
    let there = robot.truth().pose();
    assert!((there.x - 1.0).hypot(there.y - 1.5) < 1e-6 && (there.heading - 0.5).abs() < 1e-6);
    assert_eq!(robot.localisation_error(), None, "nobody has asked");
}
