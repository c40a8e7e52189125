//! Templates with late readings.

use crate::{among_with, at, drive};
use afp_carbot::devices::Navigator;
use afp_carbot::templates::{approach_infrared, check_infrared, turn_to_infrared};
use afp_carbot::{ApproachInfrared, CheckInfrared, TurnToInfrared, templates};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Actor, ActorTemplate, Duration, Events, Fault, Poll, Supervisor};
use afp_sim::{Defect, Simulation};

/// A robot at the origin, a beacon, and an infrared sensor with this delay in milliseconds.
fn late(beacon: [f64; 2], millis: u64, seed: u64) -> Simulation {
    let mut sim = among_with(&format!("[[infrared]]\nposition_m = {beacon:?}\n"), seed);
    let delayed = Defect::Delayed(Duration::from_millis(millis));
    sim.inject(afp_sim::Fault::Infrared(delayed), at(0), Duration::MAX);
    sim
}

/// Runs an actor for at most a minute, polled every 10 ms.
fn run<'a, T: ActorTemplate, A: Actor<T, Simulation>>(
    sim: &mut Simulation,
    inputs: T::Inputs<'_>,
    live: impl Fn() -> T::Live<'a>,
) -> Result<Option<T::State>, Fault> {
    let mut actor = A::start(inputs, sim, sim.now())?;
    for _ in 0..6000 {
        sim.advance_to(sim.now() + Duration::from_millis(10));
        let now = sim.now();
        if let Poll::Ready(state) = actor.poll(live(), sim, now)? {
            return Ok(Some(state));
        }
    }
    sim.halt(sim.now());
    Ok(None)
}

#[test]
fn a_robot_faces_light_with_late_readings() {
    type Template = templates::TurnToInfrared;
    for millis in [0, 100, 300, 450] {
        let (mut worst, mut squares) = (0.0_f64, 0.0);
        for (seed, towards) in (0..36).map(|n| (n, Angle::from_deg(10.0 * n as f64).si())) {
            let mut sim = late([2.0 * towards.cos(), 2.0 * towards.sin()], millis, seed);
            let speed = AngularSpeed::from_deg(45.0);
            let inputs = turn_to_infrared::Inputs { tolerance: Angle::from_deg(5.0), speed };
            let state =
                run::<Template, TurnToInfrared>(&mut sim, inputs, || turn_to_infrared::Live {});
            let facing = matches!(state, Ok(Some(turn_to_infrared::State::FacingInfrared)));
            assert!(facing, "{millis} ms late, {towards} rad: {state:?}");
            let off = (sim.truth().pose().heading - towards).to_degrees();
            let off = (off + 540.0).rem_euclid(360.0) - 180.0;
            worst = worst.max(off.abs());
            squares += off * off / 36.0;
        }
        println!("{millis} ms late: off by {:.1} deg, {worst:.1} deg at most", squares.sqrt());
        assert!(worst < 6.0 && squares.sqrt() < 2.0, "{millis} ms: {worst}, {}", squares.sqrt());
    }
}

#[test]
fn a_robot_reaches_light_with_late_readings() {
    type Template = templates::ApproachInfrared;
    for millis in [0, 100, 300, 450] {
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for (seed, towards) in (0..11).map(|n| (n, Angle::from_deg(10.0 * n as f64 - 50.0).si())) {
            let beacon = [2.0 * towards.cos(), 2.0 * towards.sin()];
            let mut sim = late(beacon, millis, seed);
            let inputs = approach_infrared::Inputs { strength: 4.0, speed: Speed::from_si(0.2) };
            let state =
                run::<Template, ApproachInfrared>(&mut sim, inputs, || approach_infrared::Live {});
            let there = matches!(state, Ok(Some(approach_infrared::State::InfraredReached)));
            assert!(there, "{millis} ms late, {towards} rad: {state:?}");
            let pose = sim.truth().pose();
            let eye = [pose.x + 0.18 * pose.heading.cos(), pose.y + 0.18 * pose.heading.sin()];
            let far = f64::hypot(beacon[0] - eye[0], beacon[1] - eye[1]);
            (least, most) = (least.min(far), most.max(far));
        }
        println!("{millis} ms late: stops {least:.3} to {most:.3} m from the beacon");
        assert!(least > 0.48 && most < 0.53, "{millis} ms: {least} to {most}");
    }
}

#[test]
fn a_late_bearing_is_relative_to_the_present_heading() {
    type Template = templates::CheckInfrared;
    for millis in [0, 300] {
        let mut sim = late([2.0, 0.0], millis, 1);
        let (inputs, wanted) = (check_infrared::Inputs {}, Events::from_bits(1));
        let mut watch: CheckInfrared =
            Supervisor::<Template, Simulation>::start(inputs, &mut sim, at(0)).unwrap();
        let (mut seen, mut squares) = (0.0, 0.0);
        for n in 0..100 {
            // Left and right, so that the light stays in view.
            drive(&mut sim, 0.0, if n % 40 < 20 { 0.8 } else { -0.8 }, 50);
            let (live, now) = (check_infrared::Live { strength: 0.05 }, sim.now());
            let event =
                Supervisor::<Template, Simulation>::poll(&mut watch, live, wanted, &mut sim, now);
            let Ok(Some(check_infrared::Event::InfraredSeen { bearing })) = event else { continue };
            let pose = sim.truth().pose();
            let eye = [pose.x + 0.18 * pose.heading.cos(), pose.y + 0.18 * pose.heading.sin()];
            let expected = f64::atan2(-eye[1], 2.0 - eye[0]) - pose.heading;
            let off = (bearing.si() - expected).to_degrees();
            (seen, squares) = (seen + 1.0, squares + ((off + 540.0) % 360.0 - 180.0).powi(2));
        }
        let off = f64::sqrt(squares / seen);
        println!("{millis} ms late: seen {seen} times, off by {off:.1} deg");
        // The sensor's own noise is 3 deg.
        assert!(seen > 60.0 && off < 4.0, "{millis} ms late: {seen}, {off}");
    }
}
