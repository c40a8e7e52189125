//! All drivers of the simulator share one clock and one trace, whatever observers they have.

use afp::load::{LoadedPlan, Registry};
use afp_carbot::table::{TABLE, signal};
use afp_core::devices::{find_control, find_fault};
use afp_core::{Duration, Instant};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_log::{About, Recorder, SessionLog, WhenFull};
use afp_session::{
    AnySession, Counts, Go, Observer, Open, Request, Robot, SampleRef, Session, Simulated, Track,
};
use afp_sim::{Simulation, World};
use afp_syntax::source::Source;

const PLAN: &str = include_str!("../../../plans/wall_following.afp");
/// Watches the optical flow of the camera during a turn.
const MOTION: &str = "use carbot
plan Watch {
    var bearing: angle = 0 deg
    start drive
    supervise touch: CheckTouchSensor { TouchSensorPressed -> back }
    actor drive: Forward(distance = 20 cm) {
        supervise motion: CheckMotion(speed = 1 deg/s, bearing => bearing) { MotionSeen -> turn }
        ForwardSuccessful -> turn
    }
    actor back: Forward(distance = -10 cm) { ForwardSuccessful -> turn }
    actor turn: Turn(angle = 70 deg) {
        supervise motion: CheckMotion(speed = 1 deg/s, bearing => bearing) { MotionSeen -> drive }
        TurnSuccessful -> drive
    }
}";
const ROOM: &str = include_str!("../../../worlds/wall_following.toml");

type Loaded = Session<LoadedPlan<Simulation>, Simulation>;

fn session() -> Loaded {
    session_of(PLAN, 3)
}

fn session_of(plan: &str, seed: u64) -> Loaded {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("plan.afp", plan), &toolboxes, &Texts::default());
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let mut registry = Registry::new();
    afp_carbot::templates::register(&mut registry);
    let plan = LoadedPlan::new(graph, &registry).unwrap();
    let sim = <Simulation as Simulated>::new(&World::parse(ROOM).unwrap(), seed).unwrap();
    Session::loaded(plan, sim)
}

fn at(seconds: u64) -> Instant {
    Instant::ZERO + Duration::from_secs(seconds)
}

#[test]
fn a_slow_sensor_makes_polls_late_under_each_driver() {
    let mut session = session();
    let slow = find_fault(TABLE, "touch", "slow").unwrap();
    session.at(Instant::ZERO, Request::Break(slow, None, Duration::MAX)).unwrap();
    assert_eq!(session.run(at(2), &mut Open, &mut []), Ok(Go::On));
    assert!(session.misses() > 50, "{}", session.misses());
}

#[test]
fn a_distance_needs_no_path() {
    let mut session = session();
    let mut whole = Track::new(session.devices());
    let mut alone = Track::distance_alone(session.devices());
    session.run(at(20), &mut Open, &mut [&mut whole, &mut alone]).unwrap();
    assert!(whole.distance > 1.0 && whole.path.len() > 900 && !whole.marks.is_empty());
    assert_eq!((alone.distance, alone.path.len(), alone.marks.len()), (whole.distance, 0, 0));
}

#[test]
fn a_log_has_the_distance_of_its_run() {
    let folder = tempfile::tempdir().unwrap();
    for (plan, seed, broken) in
        [(PLAN, 3, None), (MOTION, 5, Some("touch")), (PLAN, 7, Some("ultrasonic"))]
    {
        let mut session = session_of(plan, seed);
        if let Some(device) = broken {
            let lost = find_fault(TABLE, device, "lost").unwrap();
            session.at(at(3), Request::Break(lost, None, Duration::MAX)).unwrap();
        }
        let path = folder.path().join("a.mcap");
        let (about, names) = (About::default(), session.owned_names());
        let recorder = Recorder::create(&path, &about, session.owned_names(), WhenFull::Wait);
        let mut log = SessionLog::new(recorder.unwrap(), session.devices(), Vec::new(), false);
        let mut track = Track::new(session.devices());
        session.run(at(26), &mut Open, &mut [&mut track, &mut log]).unwrap();
        log.finish(&session).unwrap();
        let read = afp_log::read(&path).unwrap();
        let (way, marks) = afp_log::svg::follow(&read.events, &read.poses, &*names);
        assert!(!marks.is_empty() && way.len() == track.path.len());
        for (here, there) in marks.iter().zip(&track.marks) {
            assert_eq!((here.at, here.supervisor), (there.at, there.supervisor));
            let off = libm::hypot(here.pose.x - there.pose.x, here.pose.y - there.pose.y);
            assert!(off < 1e-9, "{here:?} {there:?}");
        }
        for (here, there) in way.iter().zip(&track.path) {
            assert_eq!((here.at, here.actor), (there.at, there.actor));
        }
    }
}

#[test]
fn looking_judging_logging_and_pausing_do_not_change_the_run() {
    let mut whole = session();
    assert_eq!(whole.run(at(26), &mut Open, &mut []), Ok(Go::On));
    let mut parts = session();
    Simulation::MEASURES.iter().filter_map(|name| Simulation::measure(name)).for_each(|measure| {
        parts.add_measure(measure);
    });
    let folder = tempfile::tempdir().unwrap();
    let (about, names) = (About::default(), parts.owned_names());
    let path = folder.path().join("a.mcap");
    let recorder = Recorder::create(&path, &about, names, WhenFull::Wait).unwrap();
    let mut log = SessionLog::new(recorder, parts.devices(), Vec::new(), true);
    let (mut counts, mut track) = (Counts::new(parts.names()), Track::new(parts.devices()));
    let mut observers: [&mut dyn Observer; 3] = [&mut counts, &mut track, &mut log];
    let mut gate = |target: Instant, _: Instant| if target > at(7) { Go::Stop } else { Go::On };
    assert_eq!(parts.run(at(20), &mut gate, &mut observers), Ok(Go::Stop));
    assert!(parts.now() <= at(7));
    assert_eq!(parts.run(at(11), &mut Open, &mut observers), Ok(Go::On));
    assert_eq!(parts.run(at(26), &mut Open, &mut observers), Ok(Go::On));
    assert_eq!((parts.trace(), parts.now()), (whole.trace(), at(26)));
    parts.stop(&mut observers);
    assert_ne!(parts.trace(), whole.trace());
    assert!(parts.ending().is_some());
    assert_eq!((track.path.len(), log.finish(&parts).unwrap().lost), (1301, 0));
    assert!(parts.end().number("wall_error", "judged_s").unwrap() > 1.0);
}

#[test]
fn a_keyframe_continues_like_its_run() {
    // With noise, a fault across each end, a held control, and a plan that watches optical flow.
    for (plan, seed) in [(PLAN, 3), (MOTION, 5)] {
        let mut session = session_of(plan, seed);
        let fault = |device, kind| find_fault(TABLE, device, kind).unwrap();
        let (slip, delayed) = (fault("wheels", "slip"), fault("ultrasonic", "delayed"));
        let touch = find_control(TABLE, "touch").unwrap();
        session.at(at(2), Request::Break(slip, Some(0.6), Duration::from_secs(9))).unwrap();
        session.at(at(8), Request::Break(delayed, Some(0.1), Duration::from_secs(2))).unwrap();
        session.at(at(7), Request::Press(touch, true)).unwrap();
        session.at(at(9), Request::Press(touch, false)).unwrap();
        session.add_measure(Simulation::measure("wall").unwrap());
        let middle = at(7) + Duration::from_millis(3);
        session.run(middle, &mut Open, &mut []).unwrap();
        let mut copy = AnySession::keyframe(&session).unwrap();
        let mut track = Track::new(session.devices());
        // One runs first, to reveal shared state.
        copy.run(at(26), &mut Open, &mut [&mut track]).unwrap();
        session.run(at(26), &mut Open, &mut []).unwrap();
        assert_eq!((copy.trace(), copy.now()), (session.trace(), session.now()));
        assert_eq!(copy.end(), session.end());
        let mut whole = session_of(plan, seed);
        for (at, request) in AnySession::requests(&session).to_vec() {
            whole.at(at, request).unwrap();
        }
        whole.run(at(26), &mut Open, &mut []).unwrap();
        assert_eq!(whole.trace(), session.trace());
        let pose = |session: &Loaded| session.robot().truth().pose();
        assert_eq!(pose(&whole), pose(&session));
    }
}

#[test]
fn every_sample_has_the_type_of_its_row() {
    let mut session = session();
    session.run(at(1), &mut Open, &mut []).unwrap();
    for (id, device, row) in afp_core::devices::signals(TABLE) {
        let mut seen = 0;
        session.read(id, &mut |value| {
            assert!(value.is(row.ty), "{}.{}: {value:?}", device.name, row.name);
            seen += 1;
        });
        // The room has nothing that moves, glows or sounds, and the plan needs no pose.
        let silent = ["world", "infrared", "localisation"].contains(&device.name)
            || (device.name, row.name) == ("signals", "tone");
        assert_eq!(seen > 0, !silent, "{}.{}", device.name, row.name);
    }
    let mut touched = None;
    session
        .read(signal::TOUCH_TOUCHED, &mut |value| touched = Some(value == SampleRef::Bool(true)));
    assert_eq!(touched, Some(false));
    assert_eq!(session.robot().figures().len(), 1);
}
