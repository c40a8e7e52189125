//! Obstacles that the sensors have found and that are missing on the map.

use crate::maps::field::{EchoField, Expected};
use afp_carbot::devices::Body;
use afp_core::{Duration, Instant};
use afp_session::Pose2;

/// The maximum number of remembered places; the oldest ones are replaced.
pub(crate) const MOST: usize = 1024;
/// Echoes from farther away are too vague, in metres.
const NEAR: f64 = 1.5;
/// An object on the map within this distance explains an echo, in metres.
const EXPLAINED: f64 = 0.25;
/// The angles and the number of an echo's possible places next to the sensor's direction, in
/// radians.
const ASIDE: f64 = 0.1;
const PLACES: i32 = 2;
/// Places within this distance count as one, in metres.
const SAME: f64 = 0.06;
/// The number of echoes of an occupied place, and the maximum of the counter.
const SURE: i8 = 2;
const SUREST: i8 = 6;
/// An echo from this distance behind a place, in metres, within this angle of the line to it, in
/// radians, shows that the place is free.
const BEHIND: f64 = 0.3;
const THROUGH: f64 = 0.12;
/// The time after which an unconfirmed place is forgotten.
const REMEMBERED: Duration = Duration::from_secs(60);
/// The position of an object at the pressed bumper: its distance from the robot's front, and its
/// distance inside of the sides, in metres.
const AHEAD: f64 = 0.04;
const INSIDE: f64 = 0.025;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Found {
    place: [f64; 2],
    count: i8,
    /// Whether only the bumper has felt it, so that the range sensor may not detect it.
    felt: bool,
    last: Instant,
}

impl Found {
    /// Whether it was heard or felt in the last minute.
    fn is_remembered(&self, now: Instant) -> bool {
        now.since(self.last) < REMEMBERED
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Finds {
    found: Vec<Found>,
    /// The position of an object at the pressed bumper: its distance from the robot's middle, and
    /// its maximum distance to the side, in metres.
    bumper: [f64; 2],
}

/// A ping in the frame of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Heard {
    pub(crate) sensor: [f64; 2],
    pub(crate) direction: f64,
    pub(crate) distance: f64,
}

impl Finds {
    pub(crate) fn new(body: &Body) -> Self {
        let bumper = [body.front.si() + AHEAD, body.half_width.si() - INSIDE];
        Finds { found: Vec::with_capacity(MOST), bumper }
    }

    /// The places of obstacles. Unconfirmed places are forgotten after their time.
    pub(crate) fn places(&self, now: Instant) -> impl Iterator<Item = [f64; 2]> {
        let is_there = move |found: &&Found| found.count >= SURE && found.is_remembered(now);
        self.found.iter().filter(is_there).map(|found| found.place)
    }

    /// Handles an echo: adds its source unless the map explains it, and clears the places that it
    /// passed.
    pub(crate) fn on_echo(&mut self, heard: &Heard, field: &EchoField, now: Instant) {
        let Heard { sensor, direction, distance } = *heard;
        self.found.retain_mut(|found| {
            let [x, y] = [found.place[0] - sensor[0], found.place[1] - sensor[1]];
            let aside = crate::maps::filter::wrap(libm::atan2(y, x) - direction).abs();
            if !found.felt && aside < THROUGH && libm::hypot(x, y) < distance - BEHIND {
                found.count -= 1;
            }
            found.count > 0 && found.is_remembered(now)
        });
        if distance > NEAR || is_explained(heard, field) {
            return;
        }
        for n in -PLACES..=PLACES {
            let aside = ASIDE * f64::from(n) / f64::from(PLACES);
            let (sin, cos) = libm::sincos(direction + aside);
            let place = [sensor[0] + distance * cos, sensor[1] + distance * sin];
            self.note(Found { place, count: 1, felt: false, last: now });
        }
    }

    /// Handles a press of the bumper of a robot at this place.
    pub(crate) fn on_bump(&mut self, robot: Pose2, now: Instant) {
        let [ahead, aside] = self.bumper;
        for n in -PLACES..=PLACES {
            let y = aside * f64::from(n) / f64::from(PLACES);
            let Pose2 { x, y, .. } = robot.beyond(Pose2 { x: ahead, y, heading: 0.0 });
            self.note(Found { place: [x, y], count: SURE, felt: true, last: now });
        }
    }

    fn note(&mut self, new: Found) {
        let near = |found: &&mut Found| {
            let [x, y] = [found.place[0] - new.place[0], found.place[1] - new.place[1]];
            libm::hypot(x, y) < SAME
        };
        if let Some(known) = self.found.iter_mut().find(near) {
            // Close places of one echo count once.
            if known.last < new.last || new.felt {
                known.count = known.count.saturating_add(new.count).min(SUREST);
            }
            (known.felt, known.last) = (known.felt || new.felt, new.last);
            return;
        }
        if self.found.len() == MOST {
            let oldest = (0..MOST).min_by_key(|at| self.found[*at].last);
            oldest.map(|oldest| self.found.remove(oldest));
        }
        self.found.push(new);
    }
}

/// Whether the echo's source on the map is at its distance or nearer.
fn is_explained(heard: &Heard, field: &EchoField) -> bool {
    [-0.17, 0.0, 0.17].iter().any(|aside| {
        match field.expected(heard.sensor, heard.direction + aside) {
            Expected::Echo(range) => range < heard.distance + EXPLAINED,
            Expected::Silence => false,
            Expected::Solid => true,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::map::Map;
    use crate::maps::room::tests::{body, carbot};
    use afp_carbot::devices::Beam;
    use afp_core::quantity::{Angle, Length};

    /// A room of four metres by four.
    fn field() -> EchoField {
        let wall =
            |x: [f64; 2], y: [f64; 2]| vec![[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
        let map = Map::new([
            wall([0.0, 4.0], [0.0, 0.1]),
            wall([0.0, 4.0], [3.9, 4.0]),
            wall([0.0, 0.1], [0.0, 4.0]),
            wall([3.9, 4.0], [0.0, 4.0]),
        ]);
        let beam = Beam {
            forward: Length::from_si(0.1),
            opening: Angle::from_deg(30.0),
            min: Length::from_si(0.03),
            max: Length::from_si(4.0),
        };
        EchoField::new(map, &beam)
    }

    /// The time of the `number`-th ping.
    fn ping(number: u64) -> Instant {
        Instant::ZERO + Duration::from_millis(50 * number)
    }

    fn ahead(distance: f64) -> Heard {
        Heard { sensor: [1.0, 2.0], direction: 0.0, distance }
    }

    fn places(finds: &Finds, now: Instant) -> Vec<[f64; 2]> {
        finds.places(now).collect()
    }

    #[test]
    fn an_unknown_obstacle_is_found_by_two_echoes() {
        let (mut finds, field) = (Finds::new(&carbot()), field());
        finds.on_echo(&ahead(1.0), &field, Instant::ZERO);
        assert_eq!(places(&finds, ping(0)), [] as [[f64; 2]; 0]);
        finds.on_echo(&ahead(1.0), &field, ping(1));
        let found = places(&finds, ping(1));
        assert!(found.iter().any(|[x, y]| (x - 2.0).abs() < 0.02 && (y - 2.0).abs() < 0.02));
        assert!(found.iter().all(|[x, y]| (x - 2.0).abs() < 0.05 && (y - 2.0).abs() < 0.2));
    }

    #[test]
    fn the_confirmed_obstacles_stay_if_there_are_too_many() {
        let mut finds = Finds::new(&carbot());
        let mut note = |x: usize, n: u64| {
            let place = [x as f64, 0.0];
            finds.note(Found { place, count: 1, felt: false, last: ping(n) });
        };
        (0..MOST).for_each(|x| note(x, 0));
        note(0, 1);
        note(MOST, 2);
        let all: Vec<_> = finds.found.iter().map(|found| found.place[0]).collect();
        assert_eq!((all.len(), all[0], all[1]), (MOST, 0.0, 2.0));
    }

    #[test]
    fn mapped_and_distant_objects_are_ignored() {
        let (mut finds, field) = (Finds::new(&carbot()), field());
        let wall = Heard { sensor: [3.0, 2.0], direction: 0.0, distance: 0.85 };
        for heard in [wall, ahead(1.8)] {
            finds.on_echo(&heard, &field, ping(0));
            finds.on_echo(&heard, &field, ping(1));
        }
        assert_eq!(finds.found, []);
    }

    #[test]
    fn a_place_in_front_of_an_echo_is_free_unless_the_bumper_touched_it() {
        let (mut finds, field) = (Finds::new(&carbot()), field());
        for n in 0..3 {
            finds.on_echo(&ahead(1.0), &field, ping(n));
        }
        finds.on_bump(Pose2 { x: 1.3, y: 2.0, heading: 0.0 }, ping(3));
        for n in 4..8 {
            finds.on_echo(&ahead(2.9), &field, ping(n));
        }
        let found = places(&finds, ping(8));
        let at = |x: f64| found.iter().any(|place| (place[0] - x).hypot(place[1] - 2.0) < 0.05);
        assert!(!at(2.0) && at(1.54), "{found:?}");
    }

    #[test]
    fn an_object_at_the_bumper_is_before_the_front() {
        let mut finds = Finds::new(&body(1.0, 0.8));
        finds.on_bump(Pose2 { x: 1.0, y: 2.0, heading: 0.0 }, ping(0));
        let found = places(&finds, ping(0));
        assert!(found.iter().all(|[x, _]| (x - 1.54).abs() < 1e-9), "{found:?}");
        let aside = |place: &[f64; 2]| place[1] - 2.0;
        let most = found.iter().map(aside).fold(0.0, f64::max);
        assert!((most - 0.375).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn after_a_minute_an_obstacle_is_forgotten() {
        let (mut finds, field) = (Finds::new(&carbot()), field());
        finds.on_echo(&ahead(1.0), &field, Instant::ZERO);
        finds.on_echo(&ahead(1.0), &field, ping(1));
        let later = |secs| ping(1) + Duration::from_secs(secs);
        assert_ne!(places(&finds, later(59)), [] as [[f64; 2]; 0]);
        assert_eq!(places(&finds, later(60)), [] as [[f64; 2]; 0]);
        // The next echo from its place counts as the first.
        finds.on_echo(&ahead(1.0), &field, later(61));
        assert_eq!(places(&finds, later(61)), [] as [[f64; 2]; 0]);
    }
}
