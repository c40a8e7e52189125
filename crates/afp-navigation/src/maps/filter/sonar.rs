//! How likely what the range sensor heard is, where it is thought to be.
//!
//! Relative to the likeliest, in shares: an echo from where the map says, one from something nearer that is not on the
//! map, anything else.

use crate::maps::field::Expected;

/// How far an echo may be off, metres, and how much farther for each metre: noise, the grid of the field, the wrong
/// speed of sound.
const OFF: f64 = 0.025;
const OFF_SHARE: f64 = 0.015;

/// An echo from nearer than the map says: somebody stands there.
const NEARER: f64 = 0.15;
/// An echo that nothing explains.
const UNEXPLAINED: f64 = 0.05;
/// An echo where the map is silent: it knows nothing of what is soft, small or new.
const UNHEARD_OF: f64 = 0.2;
/// Silence where the map says an echo, and where it does not.
const MISSED: f64 = 0.25;
const SILENT: f64 = 0.7;
/// A place where nobody can be.
const IMPOSSIBLE: f64 = 0.02;

/// The likelihood of what was heard.
pub(super) fn likelihood(expected: Expected, heard: Option<f64>) -> f64 {
    match (expected, heard) {
        (Expected::Solid, _) => IMPOSSIBLE,
        (Expected::Echo(_), None) => MISSED,
        (Expected::Silence, None) => SILENT,
        (Expected::Silence, Some(_)) => UNHEARD_OF,
        (Expected::Echo(expected), Some(heard)) => {
            let error = (heard - expected) / (OFF + OFF_SHARE * heard);
            let rest = if error < 0.0 { NEARER } else { UNEXPLAINED };
            // Squared, the bell of Lorentz falls off nearly as that of Gauss does, and costs one division.
            let bell = 1.0 / (1.0 + 0.25 * error * error);
            rest + (1.0 - rest) * bell * bell
        }
    }
}

/// What becomes of the likelihood where something may stand that is not on the map.
const EXCUSED: f64 = 0.95;

/// The same for a place that is believed in: something that is not on the map may stand before what is.
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
    fn what_the_map_says_is_the_likeliest_and_nearer_likelier_than_farther() {
        let of = |heard| likelihood(Expected::Echo(2.0), Some(heard));
        assert_eq!(of(2.0), 1.0);
        assert!(of(1.0) > of(3.0) && of(1.95) > of(1.9) && of(1.9) > of(1.5));
        assert!(likelihood(Expected::Silence, None) > likelihood(Expected::Echo(1.0), None));
        assert!(likelihood(Expected::Solid, Some(2.0)) < UNEXPLAINED);
    }

    #[test]
    fn what_stands_before_the_map_is_excused_and_nothing_else() {
        let of = |heard| excused(Expected::Echo(2.0), heard);
        assert_eq!((of(Some(1.0)), of(Some(2.0))), (EXCUSED, 1.0));
        assert!(of(Some(3.0)) < 0.1 && of(None) < 0.3);
        assert_eq!(excused(Expected::Silence, Some(1.0)), EXCUSED);
        assert!(excused(Expected::Solid, Some(1.0)) < 0.1);
    }
}
