//! Mistakes in the robot's Rust code end the run, with an explanation.

use std::sync::atomic::Ordering;

use afp_core::trace::{Ending, Record};
use afp_core::{Duration, Fault, Platform};
use afp_session::{AnySession, NamedRecord, Observer, Open, Request, Sampling, Session};

use super::support::{Toy, plan};
use super::{Loaded, Notes, PLAN, at};

fn stuck_from(millis: u64) -> Loaded {
    let mut toy = Toy::new();
    toy.stuck_from = Some(at(millis));
    Session::loaded(plan(PLAN), toy)
}

fn wordy_from(millis: u64) -> Loaded {
    let mut toy = Toy::new();
    toy.wordy_from = Some(at(millis));
    Session::loaded(plan(PLAN), toy)
}

fn fault(session: &Loaded) -> Fault {
    match session.ending() {
        Some(Ending::Error(fault)) => fault,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_stopped_clock_ends_the_run() {
    let mut session = stuck_from(200);
    let stops = session.robot().stops.clone();
    session.set_rest(Duration::from_secs(1));
    session.run(at(3000), &mut Open, &mut []).unwrap();
    let fault = fault(&session);
    assert_eq!(fault.code(), "robot-stuck");
    assert!(fault.text().contains("the robot's time does not go on"), "{}", fault.text());
    assert_eq!(session.robot().now(), at(200));
    assert!(stops.load(Ordering::Relaxed) > 0);
}

#[test]
fn a_stopped_clock_after_the_plans_end_ends_the_run() {
    let mut session = stuck_from(200);
    session.set_rest(Duration::from_secs(1));
    session.run(at(100), &mut Open, &mut []).unwrap();
    session.stop(&mut []);
    session.run(at(3000), &mut Open, &mut []).unwrap();
    assert_eq!(session.ending(), Some(Ending::Interrupted));
}

#[test]
fn a_late_control_loop_ends_the_run_of_a_real_robot() {
    let held_up = |millis| {
        let mut toy = Toy::new();
        toy.held_up = Some((at(500), Duration::from_millis(millis)));
        toy
    };
    let ending = |mut session: Session<_, Toy>, stall: Option<Duration>| {
        stall.into_iter().for_each(|stall| session.set_stall(stall));
        session.at(at(900), Request::Stop).unwrap();
        let stops = session.robot().stops.clone();
        session.run(at(3000), &mut Open, &mut []).unwrap();
        let way = session.robot().position;
        session.run(at(6000), &mut Open, &mut []).unwrap();
        assert_eq!(session.robot().position, way, "it drives on");
        let code = match session.ending() {
            Some(Ending::Error(fault)) => fault.code(),
            Some(Ending::Interrupted) => "interrupted",
            other => panic!("{other:?}"),
        };
        (code, stops.load(Ordering::Relaxed) > 0)
    };
    let real = |millis| Session::on_hardware(plan(PLAN), held_up(millis));
    let more = Some(Duration::from_millis(300));
    assert_eq!(ending(real(100), None), ("interrupted", false));
    assert_eq!(ending(real(101), None), ("stalled", true));
    assert_eq!(ending(real(300), more), ("interrupted", false));
    assert_eq!(ending(real(301), more), ("stalled", true));
    assert_eq!(ending(Session::loaded(plan(PLAN), held_up(300)), None), ("interrupted", false));
    // Before the start and after the end, the robot cannot move, so a delay is harmless.
    let mut toy = Toy::new();
    toy.held_up = Some((at(0), Duration::from_secs(1)));
    let mut ended = Session::on_hardware(plan(PLAN), toy);
    ended.run(at(1), &mut Open, &mut []).unwrap();
    assert_eq!(ended.ending(), None);
    ended.stop(&mut []);
    assert_eq!(ended.ending(), Some(Ending::Interrupted));
}

/// Counts faults.
#[derive(Default)]
struct Faults(u32);

impl Observer for Faults {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        self.0 += u32::from(matches!(named.record, Record::Faulted { .. }));
    }
}

#[test]
fn a_sample_with_an_undeclared_type_ends_the_run() {
    for sampling in
        [Sampling::Every(Duration::from_millis(20)), Sampling::Following(Duration::from_millis(5))]
    {
        let mut session = wordy_from(200);
        let mut notes = Notes { sampling: Some(sampling), ..Notes::default() };
        let mut faults = Faults::default();
        session.run(at(3000), &mut Open, &mut [&mut notes, &mut faults]).unwrap();
        let fault = fault(&session);
        assert_eq!(fault.code(), "signal-type");
        let said = "the robot returns its signal 'bumper.touched' as string, but the toolbox declares bool";
        assert_eq!((fault.text(), faults.0), (said, 1));
        assert_eq!(session.robot().now(), at(200));
    }
}

#[test]
fn a_signal_with_an_undeclared_type_has_no_value() {
    let session = wordy_from(0);
    let mut heard = 0;
    session.read(afp_core::devices::SignalId(1), &mut |_| heard += 1);
    assert_eq!(heard, 0);
}
