//! Another robot, built from the parts: it drives, hears, bumps, pushes and fails, and a session
//! drives it.

mod rover;

use afp_core::devices::find_fault;
use afp_core::{Duration, Environment, Instant, Platform};
use afp_session::{
    AnySession, AnyWorld, FigureValue, Loader, Open, Request, Session, Simulated, World as _,
    simulated,
};
use rover::{DEVICES, Rover, Wheels};

const ROOM: &str = "version = 1
name = 'Yard'
[robot]
pose_m_deg = [1, 1, 0]
[[wall]]
points_m = [[0, 0], [4, 0], [4, 2], [0, 2]]
closed = true
";

fn at(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

fn rover(rest: &str, seed: u64) -> Rover {
    let world = <Rover as Simulated>::World::read(&format!("{ROOM}{rest}")).unwrap();
    <Rover as Simulated>::new(&world, seed).unwrap()
}

/// Drives for a while from the start.
fn driven(rest: &str, (speed, turn): (f64, f64), millis: u64) -> Rover {
    let mut rover = rover(rest, 3);
    rover.drive(speed, turn);
    rover.advance(at(millis));
    rover
}

#[test]
fn wheels_follow_a_command() {
    let rover = driven("", (0.2, 0.0), 2000);
    let pose = rover.pose();
    assert!((0.33..0.41).contains(&(pose.x - 1.0)) && (pose.y - 1.0).abs() < 0.01, "{pose:?}");
    let [ahead, turned] = rover.way();
    assert!((ahead - (pose.x - 1.0)).abs() < 0.02 && turned.abs() < 0.02, "{ahead} {turned}");
    let pose = driven("", (0.0, 1.0), 1500).pose();
    assert!((1.2..1.5).contains(&pose.heading) && (pose.x - 1.0).abs() < 0.02, "{pose:?}");
    // Both rims are over their limit: half the speed on the same curve.
    let pose = driven("", (0.6, 0.0), 2000).pose();
    assert!((0.5..0.62).contains(&(pose.x - 1.0)), "{pose:?}");
}

#[test]
fn a_wall_is_heard_and_felt_and_stops_the_robot() {
    let mut rover = driven("", (0.3, 0.0), 1000);
    let heard = rover.range().expect("the wall ahead");
    // From the sensor on the front edge to the wall's face.
    let true_range = 4.0 - 0.05 - (rover.pose().x + 0.15);
    assert!((heard - true_range).abs() < 0.06, "{heard} {true_range}");
    assert!(!rover.touched());
    rover.advance(at(15_000));
    assert!(rover.touched());
    assert!((rover.pose().x - (3.95 - 0.15)).abs() < 0.01, "{:?}", rover.pose());
    let [contact] = rover.stage().collisions() else { panic!("{:?}", rover.stage().collisions()) };
    assert_eq!(rover.stage().obstacles()[contact.obstacle].name, "wall 1");
    // Its motors are weaker than its grip: the wheels stop, and the counters with them.
    let before = rover.way()[0];
    rover.advance(at(17_000));
    assert!((rover.way()[0] - before).abs() < 0.01);
}

#[test]
fn low_objects_are_felt_and_not_heard_and_light_objects_are_pushed() {
    let step = "[[box]]\npose_m_deg = [2, 1, 0]\nsize_m = [0.2, 0.6]\nheight_m = 0.04\n";
    let mut rover = driven(step, (0.2, 0.0), 500);
    assert!(rover.range().is_none_or(|range| range > 2.0), "{:?}", rover.range());
    rover.advance(at(8000));
    assert!(rover.touched() && rover.pose().x < 1.8);
    let carton =
        "[[box]]\npose_m_deg = [2, 1, 0]\nsize_m = [0.2, 0.3]\nheight_m = 0.3\nmass_kg = 0.3\n";
    let rover = driven(carton, (0.2, 0.0), 8000);
    assert!(rover.pose().x > 2.1, "{:?}", rover.pose());
    let moved = rover.stage().outline(4);
    assert!(moved.iter().all(|corner| corner[0] > 2.2), "{moved:?}");
}

#[test]
fn slip_shows_in_the_counters_and_a_blocked_wheel_turns_the_robot() {
    let mut slipping = rover("", 3);
    slipping.drive(0.3, 0.0);
    slipping.set_wheels(0.0, [false; 2]);
    slipping.advance(at(2000));
    assert!(slipping.way()[0] > 0.4 && slipping.pose().x < 1.05, "{:?}", slipping.pose());
    let mut blocked = rover("", 3);
    blocked.drive(0.2, 0.0);
    blocked.set_wheels(1.0, [true, false]);
    blocked.advance(at(1000));
    assert!(blocked.pose().heading > 0.3, "{:?}", blocked.pose());
}

#[test]
fn an_emergency_stop_stops_the_robot() {
    let mut rover = driven("", (0.3, 0.0), 1000);
    rover.emergency_stop();
    rover.drive(0.3, 0.0);
    rover.advance(at(1500));
    let stands = rover.pose();
    rover.advance(at(3000));
    assert!((rover.pose().x - stands.x).abs() < 0.002, "{stands:?} {:?}", rover.pose());
}

const PLAN: &str = "use rover
use std
plan Bounce {
    start ahead
    actor ahead: Roam(speed = 30 cm/s) {
        supervise bumper: CheckBumper { Pressed -> back }
        supervise near: CheckRange(limit = 20 cm) { Near -> turn }
        Never -> terminate
    }
    actor back: Roam(speed = -15 cm/s) {
        supervise enough: CheckTimeout(duration = 1 s) { TimedOut -> turn }
        Never -> terminate
    }
    actor turn: Roam(speed = 0 m/s, turn = 90 deg/s) {
        supervise round: CheckTimeout(duration = 1.2 s) { TimedOut -> ahead }
        Never -> terminate
    }
}";

fn session(seed: u64) -> Box<dyn AnySession> {
    let robot = simulated::<Rover, _>(rover::register);
    let world = robot.kind().world(ROOM).unwrap();
    robot.session(&rover::graph(PLAN), &*world as &dyn AnyWorld, seed, &[]).unwrap()
}

#[test]
fn a_session_drives_a_plan_on_the_robot_and_repeats_the_run() {
    let run = |session: &mut dyn AnySession| {
        session.run(at(30_000), &mut Open, &mut []).unwrap();
        session.trace()
    };
    let mut first = session(3);
    let trace = run(&mut *first);
    assert_eq!(run(&mut *session(3)), trace);
    assert_ne!(run(&mut *session(4)), trace, "another seed, another noise");
    let contacts = first.end().0.into_iter().find(|figure| figure.name == "contacts").unwrap();
    let FigureValue::Spans { spans, .. } = contacts.value else { panic!("{:?}", contacts.value) };
    assert!(spans.len() < 4, "it turns before most walls: {spans:?}");
    // A copy in the middle continues alike.
    let mut whole = session(3);
    whole.run(at(11_000), &mut Open, &mut []).unwrap();
    let mut copy = whole.keyframe().expect("it can be copied");
    assert_eq!((run(&mut *copy), run(&mut *whole)), (trace, trace));
}

#[test]
fn a_lost_sensor_ends_the_plan() {
    let mut session = session(3);
    let lost = find_fault(DEVICES, "ranger", "lost").unwrap();
    session.at(at(2000), Request::Break(lost, None, Duration::MAX)).unwrap();
    session.run(at(10_000), &mut Open, &mut []).unwrap();
    assert!(session.ending().is_some(), "{:?}", session.now());
}

#[test]
fn its_worlds_are_checked_for_its_body() {
    let starts = |x: &str| {
        let text = ROOM.replace("[1, 1, 0]", &format!("[{x}, 1, 0]"));
        <Rover as Simulated>::World::read(&text).err().map(|error| error.message)
    };
    // The Carbot's half length is 20 cm, and this robot's radius is 15 cm.
    assert_eq!(starts("0.22"), None);
    assert!(starts("0.19").unwrap().contains("inside of 'wall 1'"));
    let world = <Rover as Simulated>::World::read(ROOM).unwrap();
    assert!(AnyWorld::drawing(&world).body.len() > 8, "it is drawn round");
    let _: fn(_, _) -> Session<afp::load::LoadedPlan<Rover>, Rover> = Session::loaded;
}

/// The rover's tables in a world file with these lines, or the error and its place.
fn docks(rest: &str) -> Result<Vec<[f64; 2]>, String> {
    let text = format!("{ROOM}{rest}");
    let world = <Rover as Simulated>::World::read(&text).map_err(|error| {
        let place = error.span.map_or("", |span| &text[span]);
        format!("{}: {place}", error.message)
    })?;
    assert_eq!(
        afp_session::World::drawing(&world).lights,
        world.own.docks.iter().map(|it| it.at_m).collect::<Vec<_>>()
    );
    Ok(world.own.docks.iter().map(|dock| dock.at_m).collect())
}

#[test]
fn world_files_have_tables_of_other_robots() {
    assert_eq!(docks(""), Ok(vec![]));
    assert_eq!(docks("[[dock]]\nat_m = [1, 2]\n"), Ok(vec![[1.0, 2.0]]));
    let two = "[[dock]]\nat_m = [1, 2]\n[[dock]]\nat_m = [1, 2]\n";
    assert_eq!(docks(two).unwrap_err(), "2 docks; the rover knows one: ");
    let misspelt = docks("[[dok]]\nat_m = [1, 2]\n").unwrap_err();
    assert_eq!(misspelt, "a world has no 'dok': dok");
    let inside = docks("[[dock]]\nat_m = [1, 2]\nname = 3\n").unwrap_err();
    assert_eq!(inside, "unknown field 'name', expected 'at_m': name");
    // The Carbot has no docks.
    let carbot = afp_sim::World::parse(&format!("{ROOM}[[dock]]\nat_m = [1, 2]\n")).unwrap_err();
    assert!(carbot.help.ends_with("'infrared' and 'map'"), "{}", carbot.help);
}
