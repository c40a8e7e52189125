//! The likelihood of a range sensor's reading at an assumed place.
//!
//! It is relative to the maximum, for three cases: an echo from the map, an echo from a nearer
//! object that is not on the map, and any other.

use crate::maps::field::Expected;

/// The error of an echo, in metres, and its growth per metre: noise, the grid of the field, the
/// wrong speed of sound.
const OFF: f64 = 0.025;
const OFF_SHARE: f64 = 0.015;

/// An echo from nearer than the map's: an unknown object.
const NEARER: f64 = 0.15;
/// An echo without an explanation.
const UNEXPLAINED: f64 = 0.05;
/// An echo if the map is silent: soft, small or new objects are missing on the map.
const UNHEARD_OF: f64 = 0.2;
/// Silence if the map has an echo, and if it has none.
const MISSED: f64 = 0.25;
const SILENT: f64 = 0.7;
/// An impossible place.
const IMPOSSIBLE: f64 = 0.02;

/// The likelihood of a reading.
pub(super) fn likelihood(expected: Expected, heard: Option<f64>) -> f64 {
    match (expected, heard) {
        (Expected::Solid, _) => IMPOSSIBLE,
        (Expected::Echo(_), None) => MISSED,
        (Expected::Silence, None) => SILENT,
        (Expected::Silence, Some(_)) => UNHEARD_OF,
        (Expected::Echo(expected), Some(heard)) => {
            let error = (heard - expected) / (OFF + OFF_SHARE * heard);
            let rest = if error < 0.0 { NEARER } else { UNEXPLAINED };
            // The squared Lorentzian falls off nearly like a Gaussian, and costs one division.
            let bell = 1.0 / (1.0 + 0.25 * error * error);
            rest + (1.0 - rest) * bell * bell
        }
    }
}

const EXCUSED: f64 = 0.95;

/// The likelihood at a believed place: an unknown object may be before the map's object.
pub(super) fn excused(expected: Expected, heard: Option<f64>) -> f64 {
    let likelihood = likelihood(expected, heard);
    let nearer = match (expected, heard) {
        (Expected::Echo(expected), Some(heard)) => heard < expected,
        (Expected::Silence, Some(_)) => true,
        _ => false,
    };
    if nearer { likelihood.max(EXCUSED) } else { likelihood }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_maps_distance_is_likeliest_and_nearer_is_likelier_than_farther() {
        let of = |heard| likelihood(Expected::Echo(2.0), Some(heard));
        assert_eq!(of(2.0), 1.0);
        assert!(of(1.0) > of(3.0) && of(1.95) > of(1.9) && of(1.9) > of(1.5));
        assert!(likelihood(Expected::Silence, None) > likelihood(Expected::Echo(1.0), None));
        assert!(likelihood(Expected::Solid, Some(2.0)) < UNEXPLAINED);
    }

    #[test]
    fn only_an_object_in_front_of_the_map_is_tolerated() {
        let of = |heard| excused(Expected::Echo(2.0), heard);
        assert_eq!((of(Some(1.0)), of(Some(2.0))), (EXCUSED, 1.0));
        assert!(of(Some(3.0)) < 0.1 && of(None) < 0.3);
        assert_eq!(excused(Expected::Silence, Some(1.0)), EXCUSED);
        assert!(excused(Expected::Solid, Some(1.0)) < 0.1);
    }
}
