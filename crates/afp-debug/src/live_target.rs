//! A target next to a run that drives on by itself. Its events come from the run's observer, and
//! its requests go to the run's control thread.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};

use afp_core::devices::{DeviceRow, SignalId, SignalType, find_signal, signals};
use afp_core::trace::{ComponentId, ComponentKind, Names};
use afp_core::{Duration, EntryId, Instant, Value};
use afp_session::frames::BY_ODOMETRY;
use afp_session::{
    AnySession, Applied, EventKind, Holder, NamedRecord, Observer, OwnedSample, Pose2, Remote,
    Report, Request, RunEvent, SampleRef, Sampling, Stimulus, Tripwire,
};

use crate::program::Program;
use crate::sensed::{self, Sensed};
use crate::state::State;
use crate::target::{Advance, Happened, Position, Target};
use crate::watched::Watched;

/// The most events that wait for the adapter.
const WAITING: usize = 4096;
/// The period of samples.
const SAMPLES: Duration = Duration::from_millis(100);

/// The error for a change of time.
pub(crate) const DRIVES: &str = "the robot itself runs this plan: its time cannot be changed";

/// A message of the run.
enum Message {
    Event(Box<RunEvent>),
    Sample(SignalId, OwnedSample),
    Time(Instant),
}

/// Passes a run's events to its [`LiveTarget`]. It never waits: events without room are counted and
/// dropped.
pub struct Relay {
    to: SyncSender<Message>,
    lost: u64,
    /// For each signal, whether it is wanted.
    wanted: Vec<bool>,
}

/// A run that drives on by itself.
pub struct LiveTarget {
    program: Arc<Program>,
    names: Box<dyn Names + Send>,
    devices: &'static [DeviceRow],
    from: Receiver<Message>,
    remote: Remote,
    state: State,
    steps: u64,
    now: Instant,
    /// The last sample of each signal.
    samples: BTreeMap<SignalId, OwnedSample>,
    is_over: bool,
    misses: u64,
}

impl LiveTarget {
    /// A target for a session that has not started, and the observer that it needs.
    pub fn new(
        program: Arc<Program>,
        session: &dyn AnySession,
        remote: Remote,
    ) -> (LiveTarget, Relay) {
        let (to, from) = sync_channel(WAITING);
        let devices = session.devices();
        let is_small = |ty| !matches!(ty, SignalType::Image | SignalType::Outline);
        let wanted = signals(devices).map(|(.., row)| is_small(row.ty)).collect();
        let target = LiveTarget {
            program,
            names: session.owned_names(),
            devices,
            from,
            remote,
            state: State::default(),
            steps: 0,
            now: session.now(),
            samples: BTreeMap::new(),
            is_over: false,
            misses: 0,
        };
        (target, Relay { to, lost: 0, wanted })
    }

    /// Reads the last sample of a signal.
    fn read(&self, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>)) {
        if let Some(sample) = self.samples.get(&signal) {
            to(sample.get());
        }
    }
}

impl Relay {
    fn send(&mut self, at: Instant, message: Message) {
        if self.lost > 0 {
            let kind = EventKind::Lost(self.lost);
            let lost = Box::new(RunEvent { at, kind, ..RunEvent::default() });
            if self.to.try_send(Message::Event(lost)).is_ok() {
                self.lost = 0;
            }
        }
        if self.to.try_send(message).is_err() {
            self.lost += 1;
        }
    }
}

impl Observer for Relay {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        let event = RunEvent::new(named.at, named.record, named.names);
        self.send(named.at, Message::Event(Box::new(event)));
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        self.send(applied.now, Message::Event(Box::new(applied.event())));
    }

    fn sampling(&self) -> Sampling {
        Sampling::Every(SAMPLES)
    }

    fn wants(&self, _: Instant, signal: SignalId) -> bool {
        self.wanted.get(usize::from(signal.0)).is_some_and(|wanted| *wanted)
    }

    fn on_sample(&mut self, at: Instant, signal: SignalId, value: SampleRef<'_>) {
        self.send(at, Message::Sample(signal, OwnedSample::new(value)));
    }

    fn after_samples(&mut self, at: Instant) {
        self.send(at, Message::Time(at));
    }
}

impl Target for LiveTarget {
    fn program(&self) -> &Arc<Program> {
        &self.program
    }

    fn state(&self) -> &State {
        &self.state
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn is_live(&self) -> bool {
        true
    }

    fn watch(&mut self, tripwire: Option<Box<dyn Tripwire>>) -> Result<(), String> {
        self.remote.watch(tripwire).map_err(|busy| busy.to_string())
    }

    fn advance(
        &mut self,
        _: Instant,
        report: &mut dyn FnMut(&Happened, &State),
    ) -> Result<Advance, String> {
        match self.from.try_recv() {
            Ok(Message::Event(event)) => {
                self.steps += u64::from(event.at > self.now || self.steps == 0);
                self.now = self.now.max(event.at);
                self.state.apply(&event, &self.program);
                if let EventKind::Missed(miss) = &event.kind {
                    self.misses += miss.deadlines();
                }
                report(&Happened::new(*event), &self.state);
            }
            Ok(Message::Sample(signal, sample)) => {
                self.samples.insert(signal, sample);
            }
            Ok(Message::Time(at)) => self.now = self.now.max(at),
            Err(TryRecvError::Empty) => return Ok(Advance::Limit),
            Err(TryRecvError::Disconnected) => {
                self.is_over = true;
                return Ok(Advance::Ended);
            }
        }
        Ok(Advance::On)
    }

    fn seek(&mut self, _: Position) -> Result<(), String> {
        Err(DRIVES.to_owned())
    }

    fn past(&mut self, _: Instant) -> Result<State, String> {
        Err(DRIVES.to_owned())
    }

    fn pose(&self) -> Option<Pose2> {
        let truth = find_signal(self.devices, "robot", "pose");
        let mut pose = None;
        for signal in self.samples.keys() {
            self.read(*signal, &mut |sample| match sample {
                SampleRef::Pose(frame) if Some(*signal) == truth => pose = Some(frame.pose),
                // A real robot has only its odometry.
                SampleRef::Pose(frame) if frame.child == BY_ODOMETRY => {
                    pose.get_or_insert(frame.pose);
                }
                _ => {}
            });
        }
        pose
    }

    fn sensed(&self) -> Vec<Sensed> {
        sensed::all(self.devices, &|signal, to| self.read(signal, to), self.pose())
    }

    fn misses(&self) -> u64 {
        self.misses
    }

    fn set(&mut self, entry: &str, text: &str) -> Result<String, String> {
        let unknown = || format!("the plan has no entry '{entry}'");
        let id = self.program.entry(ComponentId(0), entry).ok_or_else(unknown)?;
        let declared = self.program.graph_entry(id).ok_or_else(unknown)?;
        let watched = Watched::new(&self.program, ComponentId(0), text)?;
        let value: Value = watched.constant_for(&declared.ty)?;
        let number = EntryId(u16::try_from(id.0).map_err(|_| unknown())?);
        let shown = Holder::Entry(id).named(&*self.names, value.as_deref());
        let shown = shown.in_unit(self.names.entry(id).unit).to_string();
        self.ask(Duration::ZERO, Request::Write(number, value))?;
        Ok(shown)
    }

    fn devices(&self) -> &'static [DeviceRow] {
        self.devices
    }

    fn ask(&mut self, _: Duration, request: Request) -> Result<Instant, String> {
        if self.is_over {
            return Err("the plan has ended".to_owned());
        }
        self.remote.ask(request).map_err(|busy| busy.to_string())?;
        Ok(self.now)
    }

    fn repeat(&mut self, _: Instant, _: &Stimulus) -> Result<(), String> {
        Err(DRIVES.to_owned())
    }

    fn fire(&mut self, component: ComponentId, outcome: &str) -> Result<(), String> {
        let named = self.names.component(component);
        let (path, ends) = (named.path.to_owned(), named.kind != ComponentKind::Supervisor);
        let report = Report { outcome: outcome.to_owned(), ends };
        let what = Stimulus::Inject(path, report, Vec::new());
        let request = what.request(self.devices, &*self.names).map_err(|why| why.to_string())?;
        self.ask(Duration::ZERO, request).map(|_| ())
    }

    fn stop(&mut self, _: &mut dyn FnMut(&Happened, &State)) {
        // The end is an event of the run.
        let _ = self.ask(Duration::ZERO, Request::Stop);
    }
}
