//! A robot that drives around a room knows its place, and finds it again, without an allocation.
//!
//! This is a separate test binary, because it counts in the global allocator.

use afp_carbot::devices::Beam;
use afp_carbot::history::Pose;
use afp_core::quantity::{Angle, Length};
use afp_counting::{Counting, allocations};
use afp_navigation::maps::{EchoField, Expected, Filter, Map, Ping};
use afp_session::Pose2;

#[global_allocator]
static ALLOCATOR: Counting = Counting::SYSTEM;

const FORWARD: f64 = 0.1;

fn field() -> (EchoField, Beam) {
    let block =
        |x: f64, y: f64, w: f64, h: f64| vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
    let walls = [block(-0.1, -0.1, 5.2, 0.1), block(-0.1, 4.0, 5.2, 0.1)];
    let sides = [block(-0.1, 0.0, 0.1, 4.0), block(5.0, 0.0, 0.1, 4.0)];
    let furniture = [block(0.0, 3.2, 1.6, 0.8), block(3.6, 0.0, 0.5, 0.9)];
    let beam = Beam {
        forward: Length::from_si(FORWARD),
        opening: Angle::from_deg(30.0),
        min: Length::from_si(0.03),
        max: Length::from_si(4.0),
    };
    (EchoField::new(Map::new(walls.into_iter().chain(sides).chain(furniture)), &beam), beam)
}

/// A robot on a circle that looks around; its odometry counts 2 % too much.
struct Robot {
    place: Pose2,
    odometry: Pose2,
    pings: u32,
}

impl Robot {
    fn go(&mut self, field: &EchoField) -> Ping {
        let moved = Pose2 { x: 0.01, y: 0.0, heading: 0.01 };
        self.place = self.place.beyond(moved);
        self.odometry = self.odometry.beyond(Pose2 { x: 0.0102, y: 0.0, heading: 0.0101 });
        self.pings += 1;
        let bearing = 1.6 * libm::sin(f64::from(self.pings) * 0.15);
        let sensor = self.place.beyond(Pose2 { x: FORWARD, y: 0.0, heading: bearing });
        let distance = match field.expected([sensor.x, sensor.y], sensor.heading) {
            Expected::Echo(distance) => Some(distance),
            Expected::Silence | Expected::Solid => None,
        };
        let Pose2 { x, y, heading } = self.odometry;
        Ping { robot: Pose { x, y, heading }, bearing, distance }
    }
}

/// The error of the belief: metres and degrees.
fn off(filter: &Filter, robot: &Robot) -> (f64, f64) {
    let belief = filter.belief();
    let turned = belief.heading.si() - robot.place.heading;
    let turned = turned - std::f64::consts::TAU * (turned / std::f64::consts::TAU).round();
    let (x, y) = (belief.x.si() - robot.place.x, belief.y.si() - robot.place.y);
    (x.hypot(y), turned.abs().to_degrees())
}

#[test]
fn a_filter_follows_and_finds_the_robot_and_allocates_nothing() {
    let (field, beam) = field();
    let start = Pose2 { x: 2.2, y: 1.2, heading: 0.0 };
    let mut robot = Robot { place: start, odometry: Pose2::default(), pings: 0 };
    let mut filter = Filter::new(field.clone(), &beam, start, 1);
    let before = allocations();
    for ping in 0..1500 {
        filter.update(&robot.go(&field));
        let (far, turned) = off(&filter, &robot);
        assert!(far < 0.12 && turned < 8.0, "ping {ping}: {far} m, {turned} deg");
    }
    // Somebody carries the robot.
    robot.place = Pose2 { x: 3.4, y: 2.4, heading: 2.0 };
    let lost = (0..600).take_while(|_| {
        filter.update(&robot.go(&field));
        let (far, turned) = off(&filter, &robot);
        far > 0.12 || turned > 8.0
    });
    // 20 pings a second: half a minute.
    assert!(lost.count() < 600, "{:?}", off(&filter, &robot));
    assert_eq!(allocations() - before, 0);
    assert!(filter.belief().spread.si() < 0.5, "{:?}", filter.belief());
}

#[test]
fn the_same_seed_gives_the_same_belief() {
    let (field, beam) = field();
    let start = Pose2 { x: 2.2, y: 1.2, heading: 0.0 };
    let run = |seed| {
        let mut robot = Robot { place: start, odometry: Pose2::default(), pings: 0 };
        let mut filter = Filter::new(field.clone(), &beam, start, seed);
        (0..100).for_each(|_| filter.update(&robot.go(&field)));
        filter.belief()
    };
    assert_eq!(run(7), run(7));
    assert_ne!(run(7), run(8));
}
