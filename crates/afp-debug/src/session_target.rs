//! A target with a session, whose time advances only while the run continues.

use std::sync::Arc;

use afp_core::devices::{DeviceRow, SignalType, find_signal, signals};
use afp_core::trace::{ComponentId, ComponentKind, TraceEntryId, TraceHash};
use afp_core::{Duration, Instant, SetError, StartError, WriteError};
use afp_session::{
    AnySession, Applied, Figures, Holder, NamedRecord, Observer, Open, Pose2, Report, Request,
    RunEvent, SampleRef, Stimulus, View,
};

use crate::program::Program;
use crate::sensed::{self, Sensed};
use crate::state::State;
use crate::target::{Advance, Happened, Position, Target};

/// The simulated time between two keyframes.
const KEYFRAMES: Duration = Duration::from_secs(10);
/// The most keyframes; beyond it, every second one is dropped.
const MOST_KEYFRAMES: usize = 256;

/// Makes the session of a run again, including all requests before the start.
pub type MakeSession<'m> = dyn FnMut() -> Result<Box<dyn AnySession>, String> + 'm;

/// A session of a simulated robot. If the robot or a component cannot be copied, going back runs
/// again from the start.
pub struct SessionTarget<'m> {
    program: Arc<Program>,
    make: Box<MakeSession<'m>>,
    run: Run,
    /// The latest instant reached.
    furthest: Instant,
    /// The instants of the session's requests, in order.
    asked: Vec<Instant>,
    /// Copies of the run, by time.
    keyframes: Vec<Run>,
    /// The current interval of keyframes.
    apart: Duration,
    /// Warnings about the run.
    warnings: Vec<String>,
}

struct Run {
    session: Box<dyn AnySession>,
    state: State,
    steps: u64,
}

impl<'m> SessionTarget<'m> {
    /// Makes a run before its first step.
    ///
    /// # Errors
    /// The reason if the session cannot be made.
    pub fn new(program: Arc<Program>, mut make: Box<MakeSession<'m>>) -> Result<Self, String> {
        let run = Run { session: make()?, state: State::default(), steps: 0 };
        let keyframes = run.keyframe().into_iter().collect();
        let furthest = run.session.now();
        let asked = vec![furthest; run.session.requests().len()];
        let (apart, warnings) = (KEYFRAMES, Vec::new());
        Ok(SessionTarget { program, make, run, furthest, asked, keyframes, apart, warnings })
    }

    /// Adds warnings to show before the start.
    pub fn with_warnings(self, warnings: Vec<String>) -> Self {
        SessionTarget { warnings, ..self }
    }

    /// Disables copies, as for a robot that cannot be copied: going back always runs again from the
    /// start.
    pub fn never_kept(self) -> Self {
        SessionTarget { keyframes: Vec::new(), ..self }
    }

    /// Keeps a copy of the run if the last one is old enough. A replayed run already has the later
    /// requests.
    fn keep(&mut self) {
        let Some(last) = self.keyframes.last() else { return };
        let now = self.run.session.now();
        if now < self.furthest || now < last.session.now() + self.apart {
            return;
        }
        self.keyframes.extend(self.run.keyframe());
        if self.keyframes.len() > MOST_KEYFRAMES {
            let mut number = 0;
            self.keyframes.retain(|_| {
                number += 1;
                number % 2 == 1
            });
            self.apart = self.apart * 2;
        }
    }

    /// Returns the run at a position, with its requests repeated.
    fn replayed(&mut self, asked: &[(Instant, Request)], to: Position) -> Result<Run, String> {
        let before = |run: &Run| match to {
            Position::Step(steps) => run.steps <= steps,
            Position::At(at) => run.session.now() <= at,
        };
        let kept = self.keyframes.iter().rfind(|run| before(run)).and_then(Run::keyframe);
        let mut run = match kept {
            Some(run) => run,
            None => Run { session: (self.make)()?, state: State::default(), steps: 0 },
        };
        for (at, request) in asked.iter().skip(run.session.requests().len()) {
            run.session.at(*at, request.clone()).map_err(|why| why.to_string())?;
        }
        let limit = match to {
            Position::Step(_) => Instant::MAX,
            Position::At(at) => at,
        };
        let is_there = |run: &Run| match to {
            Position::Step(steps) => run.steps >= steps,
            Position::At(at) => run.session.now() >= at && run.session.due() > at,
        };
        while !is_there(&run) && run.session.ending().is_none() {
            run.advance(limit, &self.program, &mut |_, _| {})?;
        }
        Ok(run)
    }

    /// Forgets requests after now, since the run continues differently.
    fn forget_later(&mut self) -> Result<(), String> {
        let (now, steps) = (self.run.session.now(), self.run.steps);
        if now >= self.furthest {
            return Ok(());
        }
        let requests = self.run.session.requests();
        let had = self.asked.partition_point(|asked| *asked < now);
        // At this instant it keeps the requests that are done, and those made together with them.
        let along = self.asked.partition_point(|asked| *asked <= now);
        let begun = requests.iter().skip(had).take(along - had).any(|(at, _)| *at <= now);
        self.asked.truncate(if begun { along } else { had });
        let asked = requests.get(..self.asked.len()).unwrap_or(requests).to_vec();
        self.keyframes.retain(|run| run.session.now() <= now && run.steps <= steps);
        self.run = self.replayed(&asked, Position::Step(steps))?;
        // The current instant may be between two steps.
        while self.run.session.now() < now && self.run.session.ending().is_none() {
            self.run.advance(now, &self.program, &mut |_, _| {})?;
        }
        self.furthest = now;
        Ok(())
    }

    /// Reads a signal of the robot, if it has a value.
    fn read<T>(&self, signal: &str, take: impl Fn(SampleRef<'_>) -> T) -> Option<T> {
        let session = &self.run.session;
        let mut taken = None;
        let signal = find_signal(session.devices(), "robot", signal)?;
        session.read(signal, &mut |sample| taken = Some(take(sample)));
        taken
    }

    /// Records the instant of the last request.
    fn note_asked(&mut self) {
        self.asked.resize(self.run.session.requests().len(), self.run.session.now());
    }
}

impl Run {
    fn keyframe(&self) -> Option<Run> {
        let session = self.session.keyframe()?;
        Some(Run { session, state: self.state.clone(), steps: self.steps })
    }

    fn advance(
        &mut self,
        limit: Instant,
        program: &Program,
        report: &mut dyn FnMut(&Happened, &State),
    ) -> Result<Advance, String> {
        let Run { session, state, steps } = self;
        let mut reporter = Reporter { program, state, steps, report };
        let ticked = session.tick(limit, &mut Open, &mut [&mut reporter]);
        ticked.map_err(|why| cannot_start(why, program))?;
        Ok(match session.ending() {
            Some(_) => Advance::Ended,
            None if session.now() >= limit && session.due() > limit => Advance::Limit,
            None => Advance::On,
        })
    }
}

impl Target for SessionTarget<'_> {
    fn program(&self) -> &Arc<Program> {
        &self.program
    }

    fn state(&self) -> &State {
        &self.run.state
    }

    fn now(&self) -> Instant {
        self.run.session.now()
    }

    fn steps(&self) -> u64 {
        self.run.steps
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn is_kept(&self) -> bool {
        !self.keyframes.is_empty()
    }

    fn advance(
        &mut self,
        limit: Instant,
        report: &mut dyn FnMut(&Happened, &State),
    ) -> Result<Advance, String> {
        if self.run.session.ending().is_some() {
            return Ok(Advance::Ended);
        }
        let advance = self.run.advance(limit, &self.program, report)?;
        self.furthest = self.furthest.max(self.run.session.now());
        self.keep();
        Ok(advance)
    }

    fn seek(&mut self, to: Position) -> Result<(), String> {
        let asked = self.run.session.requests().to_vec();
        self.run = self.replayed(&asked, to)?;
        Ok(())
    }

    fn past(&mut self, at: Instant) -> Result<State, String> {
        let asked = self.run.session.requests().to_vec();
        Ok(self.replayed(&asked, Position::At(at))?.state)
    }

    fn contact(&self) -> Option<String> {
        let touches = self.read("collision", |sample| matches!(sample, SampleRef::Bool(true)))?;
        let thing = |sample: SampleRef<'_>| match sample {
            SampleRef::Text(text) => text.to_owned(),
            _ => String::new(),
        };
        touches.then(|| self.read("contact", thing).unwrap_or_default())
    }

    fn pose(&self) -> Option<Pose2> {
        let pose = |sample: SampleRef<'_>| match sample {
            SampleRef::Pose(frame) => Some(frame.pose),
            _ => None,
        };
        self.read("pose", pose)?
    }

    fn moving(&self) -> Vec<(String, Vec<[f64; 2]>)> {
        let session = &self.run.session;
        let mut all = Vec::new();
        let outlines = signals(session.devices()).filter(|(.., row)| row.ty == SignalType::Outline);
        for (signal, ..) in outlines {
            session.read(signal, &mut |sample| {
                if let SampleRef::Outline(shape) = sample {
                    all.push((shape.id.clone(), shape.outline.clone()));
                }
            });
        }
        all
    }

    fn sensed(&self) -> Vec<Sensed> {
        let session = &self.run.session;
        sensed::all(session.devices(), &|signal, to| session.read(signal, to), self.pose())
    }

    fn picture(&self) -> Option<(u32, u32, Vec<u8>)> {
        let session = &self.run.session;
        let (signal, ..) =
            signals(session.devices()).find(|(.., row)| row.ty == SignalType::Image)?;
        let mut picture = None;
        session.read(signal, &mut |sample| {
            if let SampleRef::Image(image) = sample {
                picture = Some((image.width, image.height, image.rgb.to_vec()));
            }
        });
        picture
    }

    fn figures(&self) -> Figures {
        self.run.session.figures()
    }

    fn misses(&self) -> u64 {
        self.run.session.misses()
    }

    fn trace(&self) -> Option<TraceHash> {
        Some(self.run.session.trace())
    }

    fn requests(&self) -> Vec<(Instant, Stimulus)> {
        let session = &self.run.session;
        let named = |request| Stimulus::new(request, session.devices(), session.names());
        session.requests().iter().map(|(at, request)| (*at, named(request))).collect()
    }

    fn set(&mut self, entry: &str, text: &str) -> Result<String, String> {
        self.forget_later()?;
        let id = self.program.entries.iter().position(|it| it.path == entry);
        let value = self.run.session.set(entry, text).map_err(|told| match told.cause {
            SetError::Refused(WriteError::NotStarted) => {
                format!("{} (help: step once, then write it)", told.why)
            }
            _ => told.to_string(),
        })?;
        self.note_asked();
        let id = id.map(|id| TraceEntryId(id as u32));
        let of = id.map_or(Holder::Unknown, Holder::Entry);
        let datum = of.named(self.run.session.names(), value.as_deref());
        let unit = id.map_or("", |id| self.run.session.names().entry(id).unit);
        Ok(datum.in_unit(unit).to_string())
    }

    fn devices(&self) -> &'static [DeviceRow] {
        self.run.session.devices()
    }

    fn ask(&mut self, later: Duration, request: Request) -> Result<Instant, String> {
        self.forget_later()?;
        let at = self.run.session.now() + later;
        self.run.session.at(at, request).map_err(|why| why.to_string())?;
        self.note_asked();
        Ok(self.run.session.requests().last().map_or(at, |(at, _)| *at))
    }

    fn repeat(&mut self, at: Instant, what: &Stimulus) -> Result<(), String> {
        let session = &self.run.session;
        let request = what.request(session.devices(), session.names());
        let later = at.max(session.now()) - session.now();
        self.ask(later, request.map_err(|why| why.to_string())?).map(|_| ())
    }

    fn fire(&mut self, component: ComponentId, outcome: &str) -> Result<(), String> {
        let session = &self.run.session;
        let named = session.names().component(component);
        let (component, ends) = (named.path.to_owned(), named.kind != ComponentKind::Supervisor);
        let report = Report { outcome: outcome.to_owned(), ends };
        let what = Stimulus::Inject(component, report, Vec::new());
        self.repeat(session.now(), &what)
    }

    fn stop(&mut self, report: &mut dyn FnMut(&Happened, &State)) {
        let Run { session, state, steps } = &mut self.run;
        let mut reporter = Reporter { program: &self.program, state, steps, report };
        session.stop(&mut [&mut reporter]);
    }
}

/// The reason why a plan cannot start, and an action.
fn cannot_start(why: StartError, program: &Program) -> String {
    match why {
        StartError::InputMissing(entry) => {
            let name = program.entries.get(entry.index()).map_or("", |entry| &*entry.path);
            format!(
                "the 'in' entry '{name}' has neither a value nor a default: give it one with 'set'"
            )
        }
        _ => "the plan already runs".to_owned(),
    }
}

/// Reports a session's events to the adapter, and updates the state.
struct Reporter<'a> {
    program: &'a Program,
    state: &'a mut State,
    steps: &'a mut u64,
    report: &'a mut dyn FnMut(&Happened, &State),
}

impl Reporter<'_> {
    fn report(&mut self, event: RunEvent) {
        self.state.apply(&event, self.program);
        (self.report)(&Happened::new(event), self.state);
    }
}

impl Observer for Reporter<'_> {
    fn on_record(&mut self, record: &NamedRecord<'_>) {
        self.report(RunEvent::new(record.at, record.record, record.names));
    }

    fn after_step(&mut self, _: &View<'_>) {
        *self.steps += 1;
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        self.report(applied.event());
    }
}
