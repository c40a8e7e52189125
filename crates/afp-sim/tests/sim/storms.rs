//! Random rooms, commands and faults: all values stay finite.

use crate::wait;
use afp_carbot::devices::{
    Battery, Camera, ColorSensor, InfraredSensor, Navigator, Odometry, Rotator, Ultrasonic,
};
use afp_carbot::table::{Carbot, TABLE};
use afp_core::devices::{Devices, faults};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Duration, Environment, Instant};
use afp_sim::{Fault, Simulation, World};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// The number of rooms, and the duration in each, in seconds.
const ROOMS: u64 = 40;
const SECONDS: u64 = 10;

struct Dice(Pcg32);

impl Dice {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.0.next_u32()) / 4_294_967_295.0
    }

    /// Sometimes a command that a program should not send.
    fn command(&mut self, most: f64) -> f64 {
        match self.0.next_u32() % 20 {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => -1e300,
            _ => self.between(-most, most),
        }
    }
}

/// Injects three faults at random instants for random durations.
fn break_things(sim: &mut Simulation, dice: &mut Dice) -> Vec<Fault> {
    let all: Vec<_> = faults(TABLE).filter_map(|(id, ..)| Carbot::fault(id, None)).collect();
    let mut pick = || {
        let fault = all[dice.0.next_u32() as usize % all.len()];
        let at = |seconds: f64| Duration::from_secs_f64(seconds);
        let from = Instant::ZERO + at(dice.between(0.0, SECONDS as f64));
        sim.inject(fault, from, at(dice.between(0.0, 4.0)));
        fault
    };
    (0..3).map(|_| pick()).collect()
}

/// Asserts that every reading is a number or an error.
fn check_readings(sim: &Simulation, place: &str) {
    if let Ok(motion) = sim.motion().value {
        let all = [motion.x.si(), motion.y.si(), motion.heading.si(), motion.speed.si()];
        assert!(all.iter().all(|value| value.is_finite()), "{place}: {motion:?}");
    }
    if let Ok(echo) = sim.echo().value {
        let beam = sim.beam();
        let within = |range: f64| range >= beam.min.si() && range <= beam.max.si();
        assert!(echo.distance.is_none_or(|d| within(d.si())), "{place}: {echo:?}");
    }
    if let Ok(Some(glow)) = sim.glow().value {
        assert!(glow.bearing.si().abs() < 1.3 && glow.strength >= 0.0, "{place}: {glow:?}");
    }
    if let Ok(color) = sim.color().value {
        assert!((0.0..=1.0).contains(&color.reflectance()), "{place}: {color:?}");
    }
    if let Ok(charge) = sim.charge().value {
        assert!(charge.voltage.si() > 4.0 && charge.left >= 0.0, "{place}: {charge:?}");
    }
}

#[test]
fn in_any_room_with_any_faults_everything_stays_finite_and_an_emergency_stop_holds() {
    for seed in 0..ROOMS {
        let mut dice = Dice(Pcg32::new(seed, 1));
        let world = World::random(seed);
        let mut sim = Simulation::new(&world, seed).expect("the room can be built");
        let faults = break_things(&mut sim, &mut dice);
        let place = format!("room {seed} with {faults:?}");
        let reach = world.obstacles.iter().flat_map(|obstacle| obstacle.outline.corners());
        let reach = reach.flatten().fold(0.0, f64::max);
        for _ in 0..SECONDS * 4 {
            let (speed, turn) = (dice.command(0.5), dice.command(2.5));
            sim.point(Angle::from_si(dice.command(3.0)), sim.now());
            for _ in 0..25 {
                let now = sim.now();
                sim.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
                sim.advance_to(now + Duration::from_millis(10));
            }
            let pose = sim.truth().pose();
            let inside = |at: f64| at > 0.0 && at < reach;
            assert!(
                inside(pose.x) && inside(pose.y) && pose.heading.is_finite(),
                "{place}: {pose:?}"
            );
            for mover in sim.movers() {
                let corners = sim.outline(mover);
                let inside = |at: &f64| at.is_finite() && *at > -0.2 && *at < reach + 0.2;
                assert!(corners.as_flattened().iter().all(inside), "{place}: {corners:?}");
            }
            check_readings(&sim, &place);
        }
        let picture = sim.frame().value.map(|frame| frame.rgb.len());
        assert!(picture.is_err() || picture == Ok(160 * 120 * 3), "{place}");
        sim.emergency_stop();
        wait(&mut sim, 1500);
        let stood = sim.truth().pose();
        let now = sim.now();
        sim.drive(Speed::from_si(0.3), AngularSpeed::from_si(1.0), now);
        wait(&mut sim, 100);
        let moved = sim.truth().pose();
        let way = (moved.x - stood.x).hypot(moved.y - stood.y);
        // An obstacle on a path may push the robot.
        let pushed = sim.truth().collisions().iter().any(|touch| touch.end >= now);
        assert!(way < 1e-4 || pushed, "{place}: {way}");
    }
}
