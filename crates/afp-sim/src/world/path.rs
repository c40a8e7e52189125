//! The path of a moving obstacle.

/// Straight legs between places, repeated endlessly: around if closed, or else there and back.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    legs: Vec<Leg>,
    /// The start time, in seconds.
    start: f64,
    /// The duration until it is back, in seconds.
    period: f64,
}

/// From a place to the next, then a rest.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Leg {
    from: [f64; 2],
    to: [f64; 2],
    /// Its beginning, in seconds after the start of the path.
    begin: f64,
    /// The duration of the motion, in seconds.
    takes: f64,
}

impl Path {
    /// The path from the start through `places`, given relative to the start in metres. `speed` is
    /// in metres a second, and the obstacle waits `wait` seconds at each place. `None` if the path
    /// has no length.
    pub(super) fn new(
        places: &[[f64; 2]],
        closed: bool,
        speed: f64,
        wait: f64,
        start: f64,
    ) -> Option<Path> {
        let mut stops = vec![[0.0, 0.0]];
        stops.extend_from_slice(places);
        if closed {
            stops.push([0.0, 0.0]);
        } else {
            stops.extend(places.iter().rev().skip(1).copied().chain([[0.0, 0.0]]));
        }
        let (mut legs, mut period) = (Vec::new(), 0.0);
        for ends in stops.windows(2) {
            let (from, to) = (ends[0], ends[1]);
            let takes = libm::hypot(to[0] - from[0], to[1] - from[1]) / speed;
            if takes > 0.0 {
                legs.push(Leg { from, to, begin: period, takes });
                period += takes + wait;
            }
        }
        (period > 0.0 && period.is_finite()).then_some(Path { legs, start, period })
    }

    /// The places on the path, relative to the start, in metres; the first is the start.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        self.legs.iter().map(|leg| leg.from)
    }

    /// The offset from the start, `time` seconds after the start, in metres.
    pub fn offset(&self, time: f64) -> [f64; 2] {
        if time <= self.start {
            return [0.0, 0.0];
        }
        let since = time - self.start;
        let within = since - libm::floor(since / self.period) * self.period;
        let leg = self.legs.iter().rev().find(|leg| leg.begin <= within);
        leg.map_or([0.0, 0.0], |leg| {
            let share = ((within - leg.begin) / leg.takes).min(1.0);
            [0, 1].map(|i| leg.from[i] + (leg.to[i] - leg.from[i]) * share)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9
    }

    #[test]
    fn an_open_path_goes_there_and_back_with_rests() {
        let path = Path::new(&[[1.0, 0.0], [1.0, 2.0]], false, 0.5, 1.0, 3.0).unwrap();
        let cases = [
            (2.0, [0.0, 0.0]),
            (4.0, [0.5, 0.0]),
            (5.5, [1.0, 0.0]),
            (7.0, [1.0, 0.5]),
            (10.5, [1.0, 2.0]),
            (12.0, [1.0, 1.5]),
            (17.0, [0.5, 0.0]),
            (18.5, [0.0, 0.0]),
            (20.0, [0.5, 0.0]),
        ];
        for (time, expected) in cases {
            assert!(near(path.offset(time), expected), "{time}: {:?}", path.offset(time));
        }
    }

    #[test]
    fn a_closed_path_goes_around() {
        let path = Path::new(&[[1.0, 0.0], [1.0, 1.0]], true, 1.0, 0.0, 0.0).unwrap();
        let back = path.offset(2.0 + 0.5 * 2f64.sqrt());
        assert!(near(back, [0.5, 0.5]), "{back:?}");
        assert!(near(path.offset(2.0 + 2f64.sqrt() + 0.25), [0.25, 0.0]));
    }

    #[test]
    fn a_path_without_a_length_is_rejected() {
        assert_eq!(Path::new(&[], false, 1.0, 0.0, 0.0), None);
        assert_eq!(Path::new(&[[0.0, 0.0]], true, 1.0, 0.0, 0.0), None);
    }
}
