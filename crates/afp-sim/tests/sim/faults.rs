//! The effects of injected faults, and their end.

use crate::{among, at, drive, the_box, wait};
use afp_carbot::devices::{
    Battery, Button, Buttons, Camera, ColorSensor, InfraredSensor, Invalid, Odometry,
    RotatingTelemetry, Rotator, TouchSensor, Ultrasonic,
};
use afp_core::quantity::{Angle, Speed};
use afp_core::{Clock, Duration, Environment, Instant};
use afp_sim::{Defect, Fault, Simulation};

const SECOND: Duration = Duration::from_secs(1);

fn break_now(sim: &mut Simulation, fault: Fault) {
    sim.inject(fault, sim.now(), SECOND);
}

fn wall_ahead() -> Simulation {
    among(&the_box([1.2, 0.0], [0.2, 6.0], 2.0))
}

#[test]
fn a_lost_sensor_is_silent_from_its_start_to_before_its_end() {
    let mut sim = wall_ahead();
    let lost = Fault::Ultrasonic(Defect::Lost);
    sim.inject(lost, at(503), Duration::from_millis(100));
    sim.advance_to(Instant::from_nanos(502_999_999));
    assert!(sim.echo().value.is_ok());
    sim.advance_to(at(503));
    assert_eq!(sim.echo().value, Err(Invalid::NoAnswer));
    sim.advance_to(Instant::from_nanos(602_999_999));
    assert_eq!(sim.echo().value, Err(Invalid::NoAnswer));
    sim.advance_to(at(603));
    assert!(sim.echo().value.is_ok());
}

/// The possible faults of each sensor.
const SENSORS: [fn(Defect) -> Fault; 9] = [
    Fault::Ultrasonic,
    Fault::Rotator,
    Fault::Odometry,
    Fault::Touch,
    Fault::Buttons,
    Fault::Infrared,
    Fault::Color,
    Fault::Camera,
    Fault::Battery,
];

#[test]
fn every_sensor_can_be_lost_or_return_no_number() {
    for (defect, expected) in
        [(Defect::Lost, Invalid::NoAnswer), (Defect::NotANumber, Invalid::NotFinite)]
    {
        let mut sim = wall_ahead();
        wait(&mut sim, 200);
        for broken in SENSORS {
            break_now(&mut sim, broken(defect));
        }
        let said = [
            sim.echo().value.err(),
            sim.bearing().value.err(),
            sim.motion().value.err(),
            sim.touched().value.err(),
            sim.pressed(Button::Escape).value.err(),
            sim.glow().value.err(),
            sim.color().value.err(),
            sim.frame().value.err(),
            sim.charge().value.err(),
        ];
        assert_eq!(said, [Some(expected); 9]);
        wait(&mut sim, 1000);
        assert!(sim.echo().value.is_ok() && sim.motion().value.is_ok());
    }
}

#[test]
fn a_frozen_sensor_repeats_its_value_as_a_new_reading() {
    let mut sim = among("");
    drive(&mut sim, 0.2, 0.0, 500);
    let before = sim.motion();
    break_now(&mut sim, Fault::Odometry(Defect::Frozen));
    drive(&mut sim, 0.2, 0.0, 500);
    let frozen = sim.motion();
    assert_eq!(frozen.value, before.value);
    assert!(frozen.time > before.time);
    drive(&mut sim, 0.2, 0.0, 600);
    assert!(sim.motion().value.unwrap().x.si() > before.value.unwrap().x.si() + 0.15);
}

#[test]
fn a_delayed_sensor_returns_old_readings_with_their_times() {
    let mut sim = among("");
    drive(&mut sim, 0.2, 0.0, 1000);
    let begin = sim.motion();
    let delay = Duration::from_millis(100);
    sim.inject(Fault::Odometry(Defect::Delayed(delay)), sim.now(), Duration::MAX);
    drive(&mut sim, 0.2, 0.0, 90);
    assert_eq!(sim.motion(), begin, "nothing newer arrives");
    drive(&mut sim, 0.2, 0.0, 500);
    assert_eq!(sim.now().since(sim.motion().time), delay);
    let behind = sim.snapshot().odometry.x.si() - sim.motion().value.unwrap().x.si();
    assert!((behind - 0.02).abs() < 0.002, "{behind}");
}

#[test]
fn the_later_of_two_defects_counts_and_then_the_earlier_again() {
    let mut sim = among("");
    let touch = |defect| Fault::Touch(defect);
    sim.inject(touch(Defect::NotANumber), at(200), Duration::from_millis(100));
    sim.inject(touch(Defect::Lost), at(100), Duration::MAX);
    let mut said = Vec::new();
    for millis in [150, 250, 350] {
        sim.advance_to(at(millis));
        said.push(sim.touched().value.err());
    }
    let expected = [Invalid::NoAnswer, Invalid::NotFinite, Invalid::NoAnswer];
    assert_eq!(said, expected.map(Some));
}

#[test]
fn each_use_of_a_slow_sensor_costs_time() {
    let mut sim = among("");
    let clock = sim.clock();
    let cost = Duration::from_millis(20);
    break_now(&mut sim, Fault::Touch(Defect::Slow(cost)));
    sim.advance_to(at(100));
    assert_eq!(clock.now(at(100)), at(100));
    assert_eq!(sim.motion().value.map(|_| clock.now(at(100))), Ok(at(100)));
    assert_eq!(sim.touched().value, Ok(false));
    assert_eq!(clock.now(at(100)), at(120));
    assert_eq!(sim.touched().value, Ok(false));
    assert_eq!((clock.now(at(100)), clock.free()), (at(140), at(140)));
    assert_eq!(clock.now(at(150)), at(150));
}

#[test]
fn a_stuck_rotator_stays_and_its_telemetry_shows_it() {
    let mut sim = among("");
    break_now(&mut sim, Fault::RotatorStuck);
    sim.point(Angle::from_deg(40.0), at(0));
    wait(&mut sim, 900);
    assert_eq!(sim.bearing().value.unwrap().si(), 0.0);
    wait(&mut sim, 500);
    assert!((sim.bearing().value.unwrap().si().to_degrees() - 40.0).abs() < 0.3);
}

#[test]
fn a_stalled_motor_makes_the_robot_turn_around_its_wheel() {
    for (stalled, sign) in [(Fault::LeftMotorStalled, 1.0), (Fault::RightMotorStalled, -1.0)] {
        let mut sim = among("");
        sim.inject(stalled, at(0), Duration::MAX);
        drive(&mut sim, 0.2, 0.0, 2000);
        let pose = sim.truth().pose();
        assert!(pose.heading * sign > 0.3, "{stalled:?}: {pose:?}");
    }
}

#[test]
fn on_a_slippery_floor_the_wheels_spin_and_the_odometer_counts_it() {
    let way = |grip: Option<f64>| {
        let mut sim = among("");
        if let Some(grip) = grip {
            sim.inject(Fault::WheelsSlip { share: grip }, at(0), Duration::MAX);
        }
        drive(&mut sim, 0.3, 0.0, 1000);
        let believed = sim.motion().value.unwrap().x.si();
        (sim.truth().pose().x, believed)
    };
    let (true_way, believed) = way(None);
    assert!((true_way - believed).abs() < 0.02);
    let (slipped, believed) = way(Some(0.05));
    assert!(slipped < 0.6 * true_way, "{slipped} of {true_way}");
    assert!(believed > slipped + 0.08, "{believed} of {slipped}");
    assert_eq!(way(Some(f64::NAN)).0, way(Some(0.0)).0);
}

#[test]
fn a_dead_controller_stops_the_robot_within_its_dead_man_time() {
    let mut sim = among("");
    drive(&mut sim, 0.2, 0.0, 1000);
    break_now(&mut sim, Fault::ControllerDead);
    assert_eq!(sim.motion().value, Err(Invalid::NoAnswer));
    drive(&mut sim, 0.2, 0.0, 600);
    let before = sim.truth().pose().x;
    drive(&mut sim, 0.2, 0.0, 300);
    assert!((sim.truth().pose().x - before).abs() < 0.002, "it still drives");
    drive(&mut sim, 0.2, 0.0, 1000);
    assert!(sim.truth().pose().x > before + 0.1, "it does not drive again");
}

#[test]
fn a_controller_that_hangs_or_restarts_stops_the_robot() {
    for fault in [Fault::ControllerStalled, Fault::ControllerRestarted] {
        let mut sim = among("");
        drive(&mut sim, 0.2, 0.0, 1000);
        break_now(&mut sim, fault);
        assert_eq!(sim.motion().value, Err(Invalid::NoAnswer));
        assert_eq!(sim.touched().value, Err(Invalid::NoAnswer));
        drive(&mut sim, 0.2, 0.0, 300);
        let before = sim.truth().pose().x;
        drive(&mut sim, 0.2, 0.0, 300);
        assert!((sim.truth().pose().x - before).abs() < 0.002, "it still drives");
        // After a restart it obeys only another run.
        drive(&mut sim, 0.2, 0.0, 1000);
        let obeys = sim.truth().pose().x > before + 0.1;
        assert_eq!(obeys, fault == Fault::ControllerStalled);
    }
}

#[test]
fn a_low_battery_is_reported_and_slows_the_robot() {
    let mut sim = among("");
    sim.inject(Fault::BatteryLow { share: 0.04 }, at(0), Duration::MAX);
    drive(&mut sim, 0.3, 0.0, 3000);
    let charge = sim.charge().value.unwrap();
    assert_eq!(charge.left, 0.04);
    assert!(charge.voltage.si() < 6.3, "{charge:?}");
    let speed = sim.motion().value.unwrap().speed;
    assert!(speed < Speed::from_si(0.2) && speed > Speed::from_si(0.05), "{speed:?}");
    sim.inject(Fault::BatteryLow { share: 0.02 }, at(3000), Duration::MAX);
    drive(&mut sim, 0.3, 0.0, 2000);
    assert!(sim.charge().value.unwrap().voltage.si() < 6.0);
    assert!(sim.motion().value.unwrap().stands(), "below 6 V the motors are cut off");
}

#[test]
fn an_emergency_stop_holds_until_it_is_reset() {
    let mut sim = among("");
    drive(&mut sim, 0.2, 0.0, 500);
    sim.emergency_stop();
    assert!(sim.emergency_stopped());
    wait(&mut sim, 300);
    let before = sim.truth().pose();
    sim.point(Angle::from_deg(40.0), sim.now());
    drive(&mut sim, 0.2, 0.3, 1000);
    assert_eq!(sim.truth().pose(), before);
    assert_eq!(sim.bearing().value.unwrap().si(), 0.0);
    sim.reset_emergency_stop();
    drive(&mut sim, 0.2, 0.0, 1000);
    assert!(sim.truth().pose().x > before.x + 0.15);
}

#[test]
fn ended_faults_leave_the_run_of_the_intact_robot() {
    let mut whole = among("");
    let mut mended = among("");
    for broken in SENSORS {
        mended.inject(broken(Defect::Lost), at(103), Duration::from_millis(333));
    }
    for sim in [&mut whole, &mut mended] {
        drive(sim, 0.2, 0.2, 2000);
    }
    assert_eq!(whole.snapshot(), mended.snapshot());
}

#[test]
fn blocked_wheels_stop_and_on_a_slippery_floor_they_spin() {
    // A cupboard of eighty kilograms, ten centimetres ahead of the front.
    let cupboard = "\n[[box]]\nname = \"cupboard\"\npose_m_deg = [0.6, 0.0, 0.0]\nsize_m = [0.6, 0.6]\nheight_m = 1.8\nmass_kg = 80.0\n";
    let mut sim = among(cupboard);
    drive(&mut sim, 0.2, 0.0, 2000);
    let counted = sim.motion().value.expect("the odometry answers");
    assert!(counted.speed.si().abs() < 0.01, "{counted:?}");
    break_now(&mut sim, Fault::WheelsSlip { share: 0.1 });
    drive(&mut sim, 0.2, 0.0, 500);
    let counted = sim.motion().value.expect("the odometry answers");
    assert!(counted.speed.si() > 0.15, "{counted:?}");
}
