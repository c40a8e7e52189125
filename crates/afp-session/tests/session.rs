//! Properties of all sessions: the order at an instant, requests, samples, and the end.

#[path = "session/broken.rs"]
mod broken;
#[path = "session/holds.rs"]
mod holds;
#[path = "session/queue.rs"]
mod queue;
mod support;
#[path = "session/suspended.rs"]
mod suspended;

use std::sync::Arc;
use std::sync::atomic::Ordering;

use afp_core::devices::{ControlId, FaultId, SignalId};
use afp_core::trace::{Ending, Outcome, Record, Verdict};
use afp_core::{Duration, EntryId, Fault, Instant, Platform, SetError, Text, Value, WriteError};
use afp_session::{
    AnySession, Applied, Figure, Go, Measure, NamedRecord, Next, Observer, Open, Request,
    RequestError, RequestId, SampleRef, Sampling, Session, Stimulus, View,
};
use support::{POSITION, Toy, plan};

/// Rolls until the bumper is pressed, then waits, then ends.
const PLAN: &str = "use toy
use std
plan Bump {
    in name: string = \"\"
    in speed: speed = 10 cm/s
    start go
    actor go: Roll(speed = speed) {
        supervise touch: CheckBumper { Pressed -> rest }
        Never -> terminate
    }
    actor rest: Wait(duration = 1 s) { Elapsed -> terminate }
}";

const FRONT: ControlId = ControlId(0);
const HONK: ControlId = ControlId(1);
const SLIP: FaultId = FaultId(0);
const LOST: FaultId = FaultId(1);

fn at(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

type Loaded = Session<afp::load::LoadedPlan<Toy>, Toy>;
type Way = fn(&mut Loaded);

fn session() -> Loaded {
    Session::loaded(plan(PLAN), Toy::new())
}

/// Notes what it receives.
#[derive(Default)]
struct Notes {
    lines: Vec<String>,
    clear_polls: Option<u64>,
    steps: Vec<Instant>,
    sampling: Option<Sampling>,
    samples: Vec<(Instant, f64)>,
    refused: Vec<(Instant, RequestId, RequestError)>,
}

impl Observer for Notes {
    fn on_record(&mut self, record: &NamedRecord<'_>) {
        match record.record {
            Record::Polled { verdict: Verdict::Clear, .. } => {
                assert_eq!(record.line, "");
                *self.clear_polls.get_or_insert(0) += 1;
            }
            _ => self.lines.push(record.line.to_owned()),
        }
    }

    fn wants_clear_polls(&self) -> bool {
        self.clear_polls.is_some()
    }

    fn after_step(&mut self, view: &View<'_>) {
        self.steps.push(view.now());
    }

    fn sampling(&self) -> Sampling {
        self.sampling.unwrap_or(Sampling::Never)
    }

    fn wants(&self, _: Instant, signal: SignalId) -> bool {
        signal == POSITION
    }

    fn on_sample(&mut self, at: Instant, _: SignalId, value: SampleRef<'_>) {
        let SampleRef::Pose(of) = value else { panic!("{value:?}") };
        self.samples.push((at, of.pose.x));
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        if let Some(why) = applied.refused {
            self.refused.push((applied.now, applied.id, why.clone()));
        }
    }
}

impl Notes {
    fn has(&self, line: &str) -> bool {
        self.lines.iter().any(|known| known == line)
    }
}

#[test]
fn a_press_at_the_start_is_seen_by_the_first_look() {
    let mut session = session();
    let mut notes = Notes::default();
    session.at(Instant::ZERO, Request::Press(FRONT, true)).unwrap();
    session.run(at(500), &mut Open, &mut [&mut notes]).unwrap();
    assert!(notes.has("0.000000 go diverted by go.touch"), "{:#?}", notes.lines);
}

#[test]
fn requests_are_applied_in_order_before_the_step_of_their_instant() {
    let mut session = session();
    let mut notes = Notes::default();
    // Later times are done later; at one time, the order of creation counts.
    session.at(at(300), Request::Press(FRONT, true)).unwrap();
    session.at(at(300), Request::Press(FRONT, false)).unwrap();
    session.at(at(100), Request::Press(FRONT, true)).unwrap();
    session.at(at(105), Request::Press(FRONT, false)).unwrap();
    session.run(at(500), &mut Open, &mut [&mut notes]).unwrap();
    assert!(notes.has("0.100000 go.touch event Pressed -> rest"), "{:#?}", notes.lines);
    let asked: Vec<_> =
        session.requests().iter().map(|(at, _)| at.as_nanos() / 1_000_000).collect();
    assert_eq!(asked, [300, 300, 100, 105]);
}

#[test]
fn the_latest_of_several_faults_wins() {
    let mut session = session();
    let second = Duration::from_secs(1);
    session.at(at(1000), Request::Break(SLIP, Some(0.0), second + second)).unwrap();
    session.at(at(2000), Request::Break(SLIP, None, second + second)).unwrap();
    let position = |session: &Session<_, Toy>| (session.robot().position * 1e3).round() / 1e3;
    for (until, way) in [(1000, 0.1), (2000, 0.1), (3000, 0.15), (4000, 0.2), (5000, 0.3)] {
        session.run(at(until), &mut Open, &mut []).unwrap();
        assert_eq!(position(&session), way, "{until} ms");
    }
    session.at(at(5000), Request::Break(LOST, None, Duration::MAX)).unwrap();
    session.at(at(5000), Request::Press(FRONT, true)).unwrap();
    session.run(at(6000), &mut Open, &mut []).unwrap();
    assert_eq!(position(&session), 0.4);
}

#[test]
fn impossible_requests_are_refused_at_once_and_late_requests_are_reported() {
    let mut session = session();
    let mut notes = Notes::default();
    for (request, why) in [
        (Request::Press(HONK, true), RequestError::Lacks("horn")),
        (Request::Press(ControlId(9), true), RequestError::NoControl),
        (Request::Break(FaultId(9), None, Duration::MAX), RequestError::NoFault),
        (Request::Break(SLIP, Some(2.0), Duration::MAX), RequestError::Amount(2.0)),
        (Request::Write(EntryId(1), Value::Bool(true)), RequestError::Write(WriteError::Type)),
    ] {
        assert_eq!(session.at(at(10), request), Err(why));
    }
    // On a real robot, controls and faults are not available, whatever its devices declare.
    let mut there = Session::on_hardware(plan(PLAN), Toy::new());
    for request in [
        Request::Press(FRONT, true),
        Request::Hold(FRONT, Duration::from_secs(1)),
        Request::Break(LOST, None, Duration::MAX),
    ] {
        assert_eq!(
            (session.can(&request), there.can(&request)),
            (Ok(()), Err(RequestError::Refused))
        );
        assert_eq!(there.at(at(10), request), Err(RequestError::Refused));
    }
    assert!(there.at(at(10), Request::Stop).is_ok());
    // `rest` is not active yet.
    let finish = |component| Request::Inject(component, Outcome::Declared(0), Vec::new());
    let id = session.at(at(50), finish(component(&session, "rest"))).unwrap();
    session.run(at(100), &mut Open, &mut [&mut notes]).unwrap();
    assert_eq!(notes.refused, [(at(50), id, RequestError::NotActive("rest".to_owned()))]);
    let late = session.at(at(50), Request::Stop);
    assert_eq!(late, Err(RequestError::Over { at: at(50), now: at(100) }));
    // Of two outcomes at one instant the first counts; the error names it as in scenarios.
    let go = component(&session, "go");
    let (devices, names) = (AnySession::devices(&session), AnySession::names(&session));
    let shown = Stimulus::new(&finish(go), devices, names);
    assert!(shown.to_string().starts_with("finish go."), "{shown}");
    let ids = [go; 2].map(|each| session.at(at(150), finish(each)).unwrap());
    session.run(at(200), &mut Open, &mut [&mut notes]).unwrap();
    let reports = RequestError::Reports("go".to_owned());
    assert_eq!(notes.refused[1..], [(at(150), ids[1], reports)]);
    session.stop(&mut []);
    assert_eq!(session.at(at(200), Request::Stop), Err(RequestError::Ended));
}

fn component(session: &Loaded, path: &str) -> afp_core::trace::ComponentId {
    let names = AnySession::names(session);
    let mut ids = (0..names.components()).map(afp_core::trace::ComponentId);
    ids.find(|id| names.component(*id).path == path).unwrap()
}

#[test]
fn an_entry_is_set_before_the_start_and_written_later() {
    let mut session = session();
    assert_eq!(session.set("speed", "20 cm/s"), Ok(Value::Float(0.2)));
    let refused = session.set("pace", "20 cm/s").unwrap_err();
    assert_eq!(refused.cause, SetError::Unknown);
    let refused = session.set("speed", "fast").unwrap_err();
    assert!(matches!(refused.cause, SetError::Unreadable { .. }), "{refused:?}");
    assert!(refused.help.contains("cm/s"), "{}", refused.help);
    session
        .at(Instant::ZERO, Request::Write(EntryId(0), Value::Text(Text::try_from("a").unwrap())))
        .unwrap();
    let mut notes = Notes::default();
    session.run(at(1000), &mut Open, &mut [&mut notes]).unwrap();
    assert!((session.robot().position - 0.2).abs() < 1e-9);
    assert!(notes.has("0.000000 Bump commits name: unset -> \"a\""), "{:#?}", notes.lines);
    assert!(session.plan_mut().is_none(), "a running plan is only written to");
    session.set("name", "b").unwrap();
    session.run(at(1020), &mut Open, &mut [&mut notes]).unwrap();
    assert!(notes.has("1.010000 outside commits name: \"a\" -> \"b\""), "{:#?}", notes.lines);
}

#[test]
fn samples_have_their_own_grid_without_an_effect_on_the_plan() {
    let mut quiet = session();
    quiet.run(at(200), &mut Open, &mut []).unwrap();
    for sampling in
        [Sampling::Every(Duration::from_millis(7)), Sampling::Following(Duration::from_millis(7))]
    {
        let mut session = session();
        let mut notes =
            Notes { sampling: Some(sampling), clear_polls: Some(0), ..Notes::default() };
        session.run(at(200), &mut Open, &mut [&mut notes]).unwrap();
        assert_eq!(session.trace(), quiet.trace());
        let times: Vec<_> = notes.samples.iter().map(|(at, _)| at.as_nanos() / 1_000_000).collect();
        let grid: Vec<u64> = match sampling {
            Sampling::Following(_) => (0..=200).filter(|ms| ms % 7 == 0 || ms % 10 == 0).collect(),
            _ => (0..=200).step_by(7).collect(),
        };
        assert_eq!(times, grid, "{sampling:?}");
        assert_eq!(notes.clear_polls, Some(21));
        assert_eq!(notes.steps.len(), 21);
    }
}

#[test]
fn a_run_in_pieces_equals_the_whole_run() {
    let mut whole = session();
    whole.run(at(3000), &mut Open, &mut []).unwrap();
    let mut parts: Box<dyn AnySession> = Box::new(session());
    let mut closed = false;
    let mut gate = |target: Instant, _: Instant| match target > at(700) && !closed {
        true => Go::Stop,
        false => Go::On,
    };
    assert_eq!(parts.run(at(3000), &mut gate, &mut []), Ok(Go::Stop));
    assert!(parts.now() <= at(700));
    closed = true;
    let mut notes =
        Notes { sampling: Some(Sampling::Every(Duration::from_millis(3))), ..Notes::default() };
    let mut gate = |_: Instant, _: Instant| if closed { Go::On } else { Go::Stop };
    assert_eq!(parts.run(at(1100), &mut gate, &mut [&mut notes]), Ok(Go::On));
    assert_eq!(parts.run(at(3000), &mut gate, &mut []), Ok(Go::On));
    assert_eq!((parts.trace(), parts.now()), (whole.trace(), at(3000)));
}

#[test]
fn a_run_continues_for_its_rest_from_the_platforms_time() {
    let begin = at(5003);
    let mut session = Session::loaded(plan(PLAN), Toy::at(begin));
    session.set_rest(Duration::from_millis(250));
    session.at(begin, Request::Press(FRONT, true)).unwrap();
    let mut notes = Notes::default();
    assert_eq!(session.run(at(60_000), &mut Open, &mut [&mut notes]), Ok(Go::On));
    assert_eq!(notes.steps.first(), Some(&begin));
    assert_eq!(session.ending(), Some(Ending::Ok));
    assert_eq!(session.robot().now(), at(6003 + 250));
    assert_eq!(session.due(), Instant::MAX);
}

#[test]
fn a_stop_makes_its_own_step() {
    let mut session = session();
    session.at(at(55), Request::Stop).unwrap();
    let mut notes = Notes::default();
    session.run(at(1000), &mut Open, &mut [&mut notes]).unwrap();
    assert!(notes.has("0.055000 Bump ended Interrupted"), "{:#?}", notes.lines);
}

#[test]
fn every_exit_stops_the_robot() {
    let broken = PLAN.replace("speed = speed", "speed = speed, fragile = true");
    let ways: [(&str, Way); 4] = [
        ("dropped before the start", |_| {}),
        ("dropped while it runs", |session| {
            assert!(session.run(at(100), &mut Open, &mut []).is_ok())
        }),
        ("ended", |session| drop(session.end())),
        ("aborted", |session| session.abort(Fault::INTERNAL, &mut [])),
    ];
    for (way, go) in ways {
        let toy = Toy::new();
        let stops = Arc::clone(&toy.stops);
        let mut session = Session::loaded(plan(PLAN), toy);
        go(&mut session);
        drop(session);
        assert!(stops.load(Ordering::Relaxed) > 0, "{way}");
    }
    let toy = Toy::new();
    let stops = Arc::clone(&toy.stops);
    let mut session = Session::loaded(plan(&broken), toy);
    let mut notes = Notes::default();
    session.run(at(5000), &mut Open, &mut [&mut notes]).unwrap();
    assert_eq!(session.ending(), Some(Ending::Error(Fault::PANIC)));
    assert!(stops.load(Ordering::Relaxed) > 0, "a panic");
    assert!(notes.lines.last().unwrap().ends_with("Bump ended Error(panic)"), "{:#?}", notes.lines);
}

/// Panics at the end of a step.
struct Clumsy;

impl Observer for Clumsy {
    fn after_step(&mut self, _: &View<'_>) {
        panic!("an observer is broken");
    }
}

#[test]
fn a_panic_of_an_observer_is_not_a_fault_of_the_plan() {
    let mut session = session();
    let run = std::panic::AssertUnwindSafe(|| session.run(at(100), &mut Open, &mut [&mut Clumsy]));
    assert!(std::panic::catch_unwind(run).is_err());
    assert_eq!(session.ending(), None);
    session.run(at(100), &mut Open, &mut []).unwrap();
    assert!(session.robot().position > 0.0);
}

/// Counts what it receives.
#[derive(Default)]
struct Tally {
    looks: u64,
    events: u64,
}

impl Measure<Toy> for Tally {
    fn on_record(&mut self, record: &NamedRecord<'_>, robot: &Toy) {
        if matches!(record.record, Record::Event { .. }) {
            assert!(robot.position > 0.0);
            self.events += 1;
        }
    }

    fn on_sample(&mut self, at: Instant, robot: &Toy) {
        assert_eq!(at, robot.now());
        self.looks += 1;
    }

    fn figures(&self) -> Vec<Figure> {
        let value = afp_session::FigureValue::Numbers(vec![
            ("looks", self.looks as f64),
            ("events", self.events as f64),
        ]);
        vec![Figure { name: "tally", value, text: String::new() }]
    }
}

#[test]
fn measures_read_the_robot_and_return_results() {
    let mut session = session();
    session.add_measure(Box::new(Tally::default()));
    session.at(at(33), Request::Press(FRONT, true)).unwrap();
    session.run(at(1000), &mut Open, &mut []).unwrap();
    let figures = session.end();
    assert_eq!(figures.number("tally", "looks"), Some(51.0));
    assert_eq!(figures.number("tally", "events"), Some(1.0));
    assert!(figures.number("way", "way_m").unwrap() > 0.0);
}

#[test]
fn a_run_step_by_step_equals_the_whole_run() {
    let begun = || {
        let mut session = session();
        session.at(at(305), Request::Press(FRONT, true)).unwrap();
        session
    };
    let notes =
        || Notes { sampling: Some(Sampling::Every(Duration::from_millis(7))), ..Notes::default() };
    let (mut whole, mut told) = (begun(), notes());
    whole.run(at(3000), &mut Open, &mut [&mut told]).unwrap();
    assert_eq!(whole.ending(), Some(Ending::Ok));
    let (mut single, mut heard, mut before) = (begun(), notes(), 0);
    loop {
        let steps = heard.steps.len();
        match single.next_step(&mut [&mut heard]).unwrap() {
            made @ (Next::Step | Next::Ended) => {
                let runs = made == Next::Step;
                assert_eq!((heard.steps.len() - steps, runs), (1, single.ending().is_none()));
                if !runs {
                    break;
                }
            }
            Next::BeforeStep => {
                assert_eq!(heard.steps.len(), steps);
                before += 1;
            }
        }
    }
    assert_eq!((single.trace(), &heard.steps), (whole.trace(), &told.steps));
    assert!(before > 100, "{before} samples and requests between steps");
    assert_eq!(single.next_step(&mut [&mut heard]), Ok(Next::Ended));
}
