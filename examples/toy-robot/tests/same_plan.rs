//! The Carbot's plan on another target system.

use afp::trace::{NoTrace, Observe, Record};
use afp::{Ending, Instant, NamedPlan, Platform, Scheduler, Wake, trace::Names};
use toy_robot::Toy;

afp::plan!("../../plans/wall_following.afp");
afp::plan!("tests/beside_a_wall.afp");

fn seconds(seconds: f64) -> Instant {
    Instant::from_nanos((seconds * 1e9) as u64)
}

#[test]
fn the_toy_follows_the_walls_of_its_room() {
    let plan = WallFollowing::new();
    let names = plan.names();
    let mut follows = Vec::new();
    let mut watch = Observe(|at: Instant, record: &Record<'_>| match record {
        Record::Started { component } if names.component(*component).path == "followWall" => {
            follows.push(at);
        }
        _ => {}
    });
    let (mut toy, mut plan) = (Toy::new(), Scheduler::new(plan));
    let mut gaps = Vec::new();
    for hundredth in 1..=12_000 {
        let to = seconds(f64::from(hundredth) / 100.0);
        let wake = plan.run_until(&mut toy, &mut watch, to);
        assert!(matches!(wake, Ok(Wake::At(_))), "{wake:?}");
        gaps.push((to, toy.right_gap()));
    }
    assert!(follows.len() >= 6, "it goes round: {follows:?}");
    let settled = |from: Instant| {
        let within = move |at: &Instant| (3.0..5.0).contains(&(at.since(from).as_secs_f64()));
        gaps.iter().filter(move |(at, _)| *at >= from && within(at)).map(|(_, gap)| *gap)
    };
    for gap in follows.iter().flat_map(|from| settled(*from)) {
        assert!((gap - 0.3).abs() < 0.02, "{gap} m from the wall");
    }
}

#[test]
fn the_escape_button_ends_the_plan_and_stops_the_toy() {
    let (mut toy, mut plan) = (Toy::new(), Scheduler::new(WallFollowing::new()));
    let mut drive = |toy: &mut Toy, to| plan.run_until(toy, &mut NoTrace, to).expect("it starts");
    assert!(matches!(drive(&mut toy, seconds(3.0)), Wake::At(_)));
    toy.escape = true;
    assert_eq!(drive(&mut toy, seconds(4.0)), Wake::Ended(Ending::Interrupted));
    let there = toy.position;
    toy.advance(seconds(5.0));
    assert_eq!(toy.position, there);
}

#[test]
fn a_constant_distance_is_not_a_frozen_sensor() {
    let (mut toy, mut plan) = (Toy::new(), Scheduler::new(BesideAWall::new()));
    let wake = plan.run_until(&mut toy, &mut NoTrace, seconds(20.0));
    assert!(matches!(wake, Ok(Wake::Ended(Ending::Ok))), "{wake:?}");
}
