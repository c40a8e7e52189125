//! A path on the map.

use afp_core::{Fault, Reason};
use heapless::Vec;

/// The path has too many corners.
pub const LONG_PATH: Fault = Fault::new(&Reason {
    code: "long-path",
    text: "the way has more than 128 corners: choose a goal on the way to it first",
});

/// A polyline in the map frame, from the robot's position at planning to the goal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// Precise to a millimetre within some kilometres.
    corners: Vec<[f32; 2], { Path::MOST }>,
}

/// The nearest point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    /// Distance to it, metres.
    pub(crate) off: f64,
    /// Distance from there to the end, metres.
    pub(crate) rest: f64,
}

impl Path {
    /// Maximum number of places.
    pub const MOST: usize = 128;

    /// Makes a path through these places, metres.
    ///
    /// # Errors
    /// The fault `long-path`: there are more than 128 places.
    pub fn new(places: impl IntoIterator<Item = [f64; 2]>) -> Result<Path, Fault> {
        let mut corners = Vec::new();
        for [x, y] in places {
            corners.push([x as f32, y as f32]).map_err(|_| LONG_PATH)?;
        }
        Ok(Path { corners })
    }

    /// Appends a place, metres; a full path drops its first place.
    pub(crate) fn note(&mut self, [x, y]: [f64; 2]) {
        if self.corners.is_full() {
            self.corners.remove(0);
        }
        let _full = self.corners.push([x as f32, y as f32]);
    }

    /// The places from the first to the last, metres.
    pub fn places(&self) -> impl DoubleEndedIterator<Item = [f64; 2]> + ExactSizeIterator + Clone {
        self.corners.iter().map(|[x, y]| [f64::from(*x), f64::from(*y)])
    }

    /// The last place; `None` for an empty path.
    pub(crate) fn end(&self) -> Option<[f64; 2]> {
        self.places().next_back()
    }

    /// The point of the path nearest to a place; `None` for an empty path.
    pub(crate) fn nearest(&self, [x, y]: [f64; 2]) -> Option<Nearest> {
        let mut last = self.end()?;
        let mut best = Nearest { off: libm::hypot(last[0] - x, last[1] - y), rest: 0.0 };
        let mut beyond = 0.0;
        for from in self.places().rev().skip(1) {
            let (along, length) = difference(from, last);
            let ahead = (x - from[0]) * along[0] + (y - from[1]) * along[1];
            let share = if length > 0.0 { (ahead / length).clamp(0.0, length) } else { 0.0 };
            let place = if length > 0.0 {
                [from[0] + along[0] / length * share, from[1] + along[1] / length * share]
            } else {
                from
            };
            let off = libm::hypot(place[0] - x, place[1] - y);
            if off < best.off {
                best = Nearest { off, rest: beyond + length - share };
            }
            (beyond, last) = (beyond + length, from);
        }
        Some(best)
    }

    /// The rest of the path from the point nearest to `place`; `None` if that is farther than
    /// `within`, metres.
    pub fn rest_from(&self, place: [f64; 2], within: f64) -> Option<Path> {
        let near = self.nearest(place).filter(|near| near.off <= within)?;
        let (mut beyond, mut last, mut passed) = (0.0, self.end()?, self.corners.len());
        for from in self.places().rev() {
            beyond += difference(from, last).1;
            if beyond >= near.rest && beyond > 0.0 {
                break;
            }
            (last, passed) = (from, passed - 1);
        }
        let ahead = self.places().skip(passed);
        Path::new([place].into_iter().chain(ahead)).ok()
    }

    /// The place with this distance left. Clamped to the first place; beyond the end the last piece
    /// continues straight.
    pub(crate) fn place(&self, rest: f64) -> Option<[f64; 2]> {
        let mut last = self.end()?;
        let mut beyond = 0.0;
        for from in self.places().rev().skip(1) {
            let (along, length) = difference(from, last);
            if length > 0.0 && rest <= beyond + length {
                let back = (rest - beyond) / length;
                return Some([last[0] - along[0] * back, last[1] - along[1] * back]);
            }
            (beyond, last) = (beyond + length, from);
        }
        Some(last)
    }
}

/// The vector between two places and its length.
fn difference(from: [f64; 2], to: [f64; 2]) -> ([f64; 2], f64) {
    let along = [to[0] - from[0], to[1] - from[1]];
    (along, libm::hypot(along[0], along[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// One metre along x, then two along y.
    fn corner() -> Path {
        Path::new([[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]]).unwrap()
    }

    #[test]
    fn the_rest_begins_at_the_robot_and_ends_at_the_end_of_the_path() {
        let path = Path::new([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]).unwrap();
        let rest = |x, y| {
            path.rest_from([x, y], 0.1).map(|path| path.places().collect::<std::vec::Vec<_>>())
        };
        assert_eq!(rest(0.5, 0.0), Some(std::vec![[0.5, 0.0], [1.0, 0.0], [1.0, 1.0]]));
        assert_eq!(rest(1.0, 0.5), Some(std::vec![[1.0, 0.5], [1.0, 1.0]]));
        assert_eq!(rest(1.0, 1.0), Some(std::vec![[1.0, 1.0], [1.0, 1.0]]));
        assert_eq!(rest(0.5, 0.5), None);
        assert_eq!(Path::default().rest_from([0.0, 0.0], 1.0), None);
    }

    #[test]
    fn the_nearest_place_has_its_distance_and_the_rest_of_the_path() {
        let near = |x, y| corner().nearest([x, y]).unwrap();
        assert_eq!(near(0.25, 0.5), Nearest { off: 0.5, rest: 2.75 });
        assert_eq!(near(1.5, 1.5), Nearest { off: 0.5, rest: 0.5 });
        assert_eq!(near(1.0, 2.5), Nearest { off: 0.5, rest: 0.0 });
        assert_eq!(near(-1.0, 0.0), Nearest { off: 1.0, rest: 3.0 });
        assert_eq!(Path::default().nearest([0.0, 0.0]), None);
    }

    #[test]
    fn a_place_is_counted_from_the_end_and_the_last_piece_continues() {
        let place = |rest| corner().place(rest).unwrap();
        assert_eq!(place(0.5), [1.0, 1.5]);
        assert_eq!(place(2.25), [0.75, 0.0]);
        assert_eq!(place(-0.5), [1.0, 2.5]);
        assert_eq!(place(9.0), [0.0, 0.0]);
        assert_eq!(Path::new([[1.0, 1.0]]).unwrap().place(0.5), Some([1.0, 1.0]));
        assert_eq!(Path::default().place(0.0), None);
    }

    #[test]
    fn equal_places_are_accepted() {
        let twice = Path::new([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]]).unwrap();
        assert_eq!(twice.nearest([0.5, 0.0]), Some(Nearest { off: 0.0, rest: 0.5 }));
        assert_eq!(twice.place(-0.5), Some([1.5, 0.0]));
    }

    #[test]
    fn a_place_above_the_limit_replaces_the_first_place() {
        let mut path = Path::new((0..Path::MOST).map(|n| [n as f64, 0.0])).unwrap();
        path.note([0.5, 0.5]);
        assert_eq!((path.places().next(), path.end()), (Some([1.0, 0.0]), Some([0.5, 0.5])));
        assert_eq!(path.places().len(), Path::MOST);
    }

    #[test]
    fn a_path_with_too_many_corners_is_rejected() {
        let places: Vec<_> = (0..=Path::MOST).map(|n| [n as f64, 0.0]).collect();
        assert_eq!(Path::new(places), Err(LONG_PATH));
    }
}
