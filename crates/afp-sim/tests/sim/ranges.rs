//! The range sensor against the geometry of its surroundings; docs/simulator.md has the numbers.
//!
//! The expected range is that of the nearest place within the cone that returns sound to the
//! sensor. The cone consists of nine rays, so the echo comes from up to half a gap of rays next to
//! the nearest place, or a whole gap inside of an edge. Each test computes this additional
//! distance; the remaining tolerance is [`NOISE`].

use crate::{among_with, at, the_box, wait};
use afp_carbot::devices::{Rotator, Ultrasonic};
use afp_core::quantity::Angle;
use std::f64::consts::TAU;

/// Half the cone, and the gap between two of its rays, in degrees.
const HALF: f64 = 15.0;
const GAP: f64 = 30.0 / 8.0;
/// The tolerance of a mean over 20 robots, as a share. Each robot's speed of sound is off by 0.3 %,
/// which makes 0.07 % for all. The rest is four times the deviation of the mean.
const NOISE: f64 = 0.003;
/// The sensor's distance ahead of the robot's middle, in metres.
const FORWARD: f64 = 0.1;

/// The mean of the ranges with the sensor pointed in a direction, and the share of heard pings.
///
/// Robots differ in their assumed speed of sound, so the mean is over many robots.
fn listen(world: &str, degrees: f64) -> (f64, f64) {
    let (mut sum, mut heard) = (0.0, 0.0);
    for seed in 0..20 {
        let mut sim = among_with(world, seed);
        sim.point(Angle::from_deg(degrees), at(0));
        wait(&mut sim, 1000);
        for _ in 0..40 {
            wait(&mut sim, 50);
            if let Some(range) = sim.echo().value.ok().and_then(|echo| echo.distance) {
                (sum, heard) = (sum + range.si(), heard + 1.0);
            }
        }
    }
    (sum / f64::max(heard, 1.0), heard / 800.0)
}

/// Asserts that at least half of the pings are heard, and that the mean is between the range of the
/// nearest place and the worst range of the rays.
fn expect(what: &str, world: &str, degrees: f64, nearest: f64, worst: f64) {
    let (mean, share) = listen(world, degrees);
    println!(
        "{what}, {degrees} deg: {mean:.4} m, computed {nearest:.4} to {worst:.4}, {:+.2} %, {:.0} % heard",
        (mean / nearest - 1.0) * 100.0,
        share * 100.0
    );
    assert!(share > 0.5, "{what}: {share} heard");
    assert!((nearest * (1.0 - NOISE)..worst * (1.0 + NOISE)).contains(&mean), "{what}: {mean}");
}

fn expect_silence(world: &str, degrees: f64) {
    assert_eq!(listen(world, degrees).1, 0.0);
}

fn cos(degrees: f64) -> f64 {
    degrees.to_radians().cos()
}

fn sin(degrees: f64) -> f64 {
    degrees.to_radians().sin()
}

/// The range of a plane at this distance, with its normal this number of degrees off the cone's
/// axis: of the nearest place within the cone, and with the gap between the rays. There is a ray at
/// the cone's edge.
fn plane(distance: f64, slant: f64) -> (f64, f64) {
    let beyond = (slant.abs() - HALF).max(0.0);
    let off = if beyond > 0.0 { beyond } else { GAP / 2.0 };
    (distance / cos(beyond), distance / cos(off))
}

#[test]
fn a_distance_beyond_the_range_is_silence() {
    let wall = the_box([FORWARD + 3.99 + 0.1, 0.0], [0.2, 20.0], 2.0);
    let mut heard = [0, 0];
    for seed in 0..20 {
        let mut sim = among_with(&wall, seed);
        wait(&mut sim, 1000);
        for _ in 0..40 {
            wait(&mut sim, 50);
            let echo = sim.echo().value.expect("it listens, whatever it hears");
            heard[usize::from(echo.distance.is_some())] += 1;
        }
    }
    assert!(heard.iter().all(|count| *count > 100), "silence and echoes: {heard:?}");
}

#[test]
fn a_wall_is_as_far_as_its_normal_is_long() {
    for (distance, bearing) in [(0.3, 0.0), (1.0, 0.0), (1.0, 12.0), (2.0, -10.0), (3.5, 0.0)] {
        let wall = the_box([FORWARD + distance + 0.1, 0.0], [0.2, 20.0], 2.0);
        let (nearest, worst) = plane(distance, bearing);
        expect(&format!("wall at {distance} m"), &wall, bearing, nearest, worst);
    }
}

#[test]
fn in_a_corner_the_nearer_wall_counts() {
    // One wall ahead, one on the left; the visible wall in each direction.
    for (ahead, left, bearing) in [
        (1.0, 0.6, 0.0),
        (1.0, 0.6, 90.0),
        (0.8, 0.6, 60.0),
        (0.8, 0.6, 30.0),
        (0.6, 0.6, 45.0),
        (0.5, 0.45, 45.0),
    ] {
        let walls = the_box([FORWARD + ahead + 0.1, 0.0], [0.2, 8.0], 2.0)
            + &the_box([0.0, left + 0.1], [8.0, 0.2], 2.0);
        let (a, b) = (plane(ahead, bearing), plane(left, 90.0 - bearing));
        let (nearest, worst) = (f64::min(a.0, b.0), f64::min(a.1, b.1));
        let what = format!("corner of walls at {ahead} and {left} m");
        expect(&what, &walls, bearing, nearest, worst);
    }
}

/// A post straight ahead, as a polygon of 32 corners on a circle, at this distance from the sensor.
fn post(distance: f64, radius: f64) -> String {
    let middle = FORWARD + distance + radius;
    let corner = |n: u32| {
        let (sin, cos) = (TAU * f64::from(n) / 32.0).sin_cos();
        [middle + radius * cos, radius * sin]
    };
    let corners: Vec<_> = (0..32).map(corner).collect();
    format!("[[polygon]]\npoints_m = {corners:?}\nheight_m = 1.0\n")
}

#[test]
fn a_round_post_is_as_far_as_its_nearest_side() {
    for (distance, radius, bearing) in [
        (0.5, 0.1, 0.0),
        (0.5, 0.1, GAP / 2.0),
        (1.0, 0.15, -8.0),
        (1.5, 0.3, 5.0),
        (2.5, 0.3, 0.0),
    ] {
        // The intersection of a ray with a circle off its middle, and the distance of the polygon's
        // sides inside of the circle.
        let middle = distance + radius;
        let beside = middle * sin(GAP / 2.0);
        let circle = middle * cos(GAP / 2.0) - (radius * radius - beside * beside).sqrt();
        let inside = radius * (1.0 - cos(360.0 / 32.0 / 2.0));
        let what = format!("post of {radius} m at {distance} m");
        expect(&what, &post(distance, radius), bearing, distance, circle + inside / cos(45.0));
    }
}

#[test]
fn a_thin_post_far_away_is_missed_between_two_rays() {
    // Half the gap is 6.5 cm at two metres.
    let thin = post(2.0, 0.03);
    assert!(listen(&thin, 0.0).1 > 0.5);
    expect_silence(&thin, GAP / 2.0);
}

/// A box of 0.4 m by 0.4 m straight ahead, with a corner towards the sensor at this distance.
fn edge_on(distance: f64) -> String {
    let middle = FORWARD + distance + 0.2 * 2.0_f64.sqrt();
    format!("[[box]]\npose_m_deg = [{middle}, 0.0, 45.0]\nsize_m = [0.4, 0.4]\nheight_m = 1.0\n")
}

#[test]
fn an_edge_is_only_heard_from_near() {
    // Both sides slant by 45 deg: 2^-8 of the sound comes back, and 0.02 / r^2 is heard.
    let farthest = (0.5_f64.powi(8) / 0.02).sqrt();
    for (distance, bearing) in [(0.25, 0.5), (0.3, GAP / 2.0), (0.35, -0.5)] {
        assert!(distance < farthest);
        // The law of sines: a ray half a gap off the edge hits a side at 45 deg less that.
        let worst = distance * sin(45.0) / sin(45.0 - GAP / 2.0);
        expect(&format!("edge at {distance} m"), &edge_on(distance), bearing, distance, worst);
    }
    for distance in [farthest + 0.01, 1.0] {
        expect_silence(&edge_on(distance), 0.5);
    }
}

#[test]
fn the_nearest_place_counts_for_a_box_in_a_part_of_the_cone() {
    for (distance, from) in [(1.0, -8.0), (1.0, 3.0), (0.6, 9.0), (1.5, 1.0)] {
        // Its front begins this number of degrees left of the axis; a wall is 1.5 m behind it.
        let edge = distance * sin(from) / cos(from);
        let middle = [FORWARD + distance + 0.2, edge + 0.5];
        let wall = the_box([FORWARD + distance + 1.6, 0.0], [0.2, 20.0], 2.0);
        let world = the_box(middle, [0.4, 1.0], 1.0) + &wall;
        let covered = f64::max(from, 0.0);
        let off = if from < 0.0 { GAP / 2.0 } else { from + GAP };
        let what = format!("box at {distance} m from {from} deg on");
        expect(&what, &world, 0.0, distance / cos(covered), distance / cos(off));
    }
}

#[test]
fn obstacles_outside_of_the_cone_are_not_heard() {
    let distance = 1.0;
    let edge = distance * sin(HALF + 0.5) / cos(HALF + 0.5);
    let middle = [FORWARD + distance + 0.2, edge + 0.5];
    expect_silence(&the_box(middle, [0.4, 1.0], 1.0), 0.0);
}
