//! Measures of a robot from drives that a person measures with a tape.
//!
//! The wheels count ways that are wrong by a factor each. A drive whose counts say "straight" is
//! therefore an arc of a circle, and its end gives both factors. Turns on the spot give the track.
//!
//! A car without encoders counts its commands. Its drive gives the speed and the steering angle at
//! which it drives straight ahead, and circles give the wheelbase.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// A drive: the counted distance, and the distance on the tape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Straight {
    /// The way by the counts, in metres.
    pub counted: f64,
    /// The change of the heading by the counts, in radians.
    pub turned: f64,
    /// The end by the tape, in metres: ahead of the start, and to the left of its line.
    pub end: [f64; 2],
}

/// Turns on the spot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spin {
    /// The angle by the counts, in radians.
    pub counted: f64,
    /// The angle that a person has seen, in radians.
    pub seen: f64,
}

/// The errors of a robot's measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The driven distance over the counted distance.
    pub scale: f64,
    /// The distance between the wheels, in metres.
    pub track: f64,
    /// The right wheel's diameter over the left wheel's.
    pub trim: f64,
}

/// The errors of the measures of a car without encoders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundCar {
    /// The driven distance over the commanded distance.
    pub scale: f64,
    /// The distance between the axes, in metres.
    pub wheelbase: f64,
    /// The angle of the front wheels at which it drives straight ahead, in radians to the left.
    pub straight: f64,
}

/// The length of the arc that begins in the direction of the line and ends at a place, and the
/// change of its direction.
fn arc([ahead, left]: [f64; 2]) -> (f64, f64) {
    let bend = 2.0 * libm::atan2(left, ahead);
    let (chord, half) = (libm::hypot(ahead, left), bend / 2.0);
    (if half.abs() < 1e-6 { chord } else { chord * half / libm::sin(half) }, bend)
}

/// Whether a factor is that of a possible error.
fn is_near(factor: f64) -> bool {
    (0.8..=1.25).contains(&factor)
}

/// Solves for the measures of a car that drove with this wheelbase, in metres: straight ahead, and
/// in circles with this radius, as commanded.
///
/// Returns `None` as [`solve`] does.
pub fn solve_car(
    wheelbase: f64,
    straight: &Straight,
    (radius, circles): (f64, &Spin),
) -> Option<FoundCar> {
    if straight.counted < 0.5 || circles.counted.abs() < TAU || straight.end[0] <= 0.0 {
        return None;
    }
    let (way, bend) = arc(straight.end);
    let scale = way / straight.counted;
    let drift = bend / way;
    let curvature = circles.seen / (scale * circles.counted * radius);
    // The tangent of the commanded angle, to which the front wheels add the angle of the drift.
    let asked = wheelbase / radius;
    let mut found = wheelbase;
    for _ in 0..50 {
        let added = drift * found;
        found = (asked + added) / ((1.0 - asked * added) * curvature);
    }
    let angle = -libm::atan(drift * found);
    let is_car = is_near(scale) && is_near(found / wheelbase) && angle.abs() < STEERS;
    is_car.then_some(FoundCar { scale, wheelbase: found, straight: angle })
}

/// Front wheels that point farther aside are not mounted well, in radians.
const STEERS: f64 = 0.35;

/// Solves for the measures of a robot that drove with this track, in metres.
///
/// Returns `None` if the drives are too short or the numbers are not those of a robot: an error of
/// more than 25%.
pub fn solve(track: f64, straight: &Straight, spin: &Spin) -> Option<Found> {
    if straight.counted < 0.5 || spin.counted.abs() < TAU || straight.end[0] <= 0.0 {
        return None;
    }
    let (way, bend) = arc(straight.end);
    let scale = way / straight.counted;
    let found_track = scale * spin.counted * track / spin.seen;
    let difference = (bend * found_track - scale * straight.turned * track) / straight.counted;
    let trim = (scale + difference / 2.0) / (scale - difference / 2.0);
    [scale, found_track / track, trim].into_iter().all(is_near).then_some(Found {
        scale,
        track: found_track,
        trim,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The drives of a robot with these factors of its wheels and this track.
    fn drives(factors: [f64; 2], track: f64, nominal: f64) -> (Straight, Spin) {
        let [left, right] = factors.map(|factor| factor * 2.0);
        let (bend, way) = ((right - left) / track, (left + right) / 2.0);
        let end = match bend.abs() < 1e-9 {
            true => [way, 0.0],
            false => [bend.sin() * way / bend, (1.0 - bend.cos()) * way / bend],
        };
        let counted = 10.0 * TAU;
        let seen = (factors[0] + factors[1]) / 2.0 * counted * nominal / track;
        (Straight { counted: 2.0, turned: 0.0, end }, Spin { counted, seen })
    }

    #[test]
    fn errors_of_five_percent_are_found() {
        for (scale, track, trim) in
            [(1.05, 1.0, 1.0), (1.0, 0.95, 1.0), (1.0, 1.0, 1.05), (0.95, 1.05, 0.95)]
        {
            let left = 2.0 * scale / (1.0 + trim);
            let (straight, spin) = drives([left, left * trim], 0.14 * track, 0.14);
            let found = solve(0.14, &straight, &spin).unwrap();
            assert!((found.scale - scale).abs() < 1e-9, "{found:?}");
            assert!((found.track - 0.14 * track).abs() < 1e-9, "{found:?}");
            assert!((found.trim - trim).abs() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn errors_of_a_car_are_found() {
        let (nominal, radius) = (0.0872, 0.25);
        for (scale, base, aside) in
            [(1.0, 1.0, 0.0), (1.05, 1.0, 0.0), (1.0, 0.95, 0.03), (0.95, 1.05, -0.1)]
        {
            let wheelbase = nominal * base;
            let curvature = |asked: f64| ((nominal * asked).atan() + aside).tan() / wheelbase;
            let (way, drift) = (2.0 * scale, curvature(0.0));
            let end = match drift.abs() < 1e-9 {
                true => [way, 0.0],
                false => [(drift * way).sin() / drift, (1.0 - (drift * way).cos()) / drift],
            };
            let counted = 2.0 * TAU;
            let seen = counted * radius * scale * curvature(1.0 / radius);
            let straight = Straight { counted: 2.0, turned: 0.0, end };
            let found = solve_car(nominal, &straight, (radius, &Spin { counted, seen })).unwrap();
            assert!((found.scale - scale).abs() < 1e-9, "{found:?}");
            assert!((found.wheelbase - wheelbase).abs() < 1e-9, "{found:?}");
            assert!((found.straight + aside).abs() < 1e-9, "{found:?}");
        }
        let straight = Straight { counted: 2.0, turned: 0.0, end: [2.0, 0.0] };
        let none = Spin { counted: 1.0, seen: 1.0 };
        assert_eq!(solve_car(nominal, &straight, (radius, &none)), None);
    }

    #[test]
    fn numbers_of_no_robot_are_refused() {
        let (straight, spin) = drives([1.0, 1.0], 0.14, 0.14);
        assert!(solve(0.14, &straight, &spin).is_some());
        // Centimetres instead of metres, turns that were not counted, and a drive backwards.
        let long = Straight { end: [200.0, 0.0], ..straight };
        assert_eq!(solve(0.14, &long, &spin), None);
        assert_eq!(solve(0.14, &straight, &Spin { seen: 0.1, ..spin }), None);
        assert_eq!(solve(0.14, &Straight { end: [-2.0, 0.0], ..straight }, &spin), None);
        assert_eq!(solve(0.14, &Straight { counted: 0.0, ..straight }, &spin), None);
        assert_eq!(solve(0.14, &Straight { end: [f64::NAN, 0.0], ..straight }, &spin), None);
    }
}
