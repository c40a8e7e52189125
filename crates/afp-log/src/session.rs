//! A log as an observer of a session.

use std::collections::BTreeMap;

use afp_core::devices::{DeviceRow, SignalId, SignalRow, SignalType, signals};
use afp_core::trace::{Ending, Record, Sink};
use afp_core::{Duration, Instant, Value};
use afp_session::{
    AnySession, Applied, Datum, Done, FILM, LoopTimes, NamedRecord, Observer, Requested, RunEvent,
    SAMPLE, SampleRef, Sampling, Shape,
};

use crate::channels::{FRAMES, Signal};
use crate::error::LogError;
use crate::recorder::{Recorder, Written};
use crate::robot::{Image, Level, Transform};
use crate::wall_clock::Clocks;

/// The interval in which live clients get the whole scene.
const SCENES: Duration = Duration::from_secs(1);

/// Records a session: its trace, and the signals of its robot.
pub struct SessionLog {
    recorder: Recorder,
    signals: Vec<Followed>,
    /// The frame with its own channel for the pose.
    body: Option<SignalId>,
    started: bool,
    frames: Vec<Transform>,
    /// The time of each range sensor's last logged echo.
    echoes: BTreeMap<SignalId, Instant>,
    /// The height of each device's frame, in metres.
    heights: BTreeMap<&'static str, f64>,
    /// The next time for camera pictures; never if they are not logged.
    camera: Instant,
    /// Whether these samples include a picture.
    has_picture: bool,
    /// The moving objects at their last written places.
    shapes: Vec<Shape>,
    moved: Vec<Shape>,
    /// The next time for the whole scene. In a file, the scene is only at the beginning.
    scene_again: Instant,
    /// The latest look at the clocks of a real robot's computer.
    clocks: Option<Clocks>,
}

struct Followed {
    signal: Signal,
    ty: SignalType,
    said: Option<Datum>,
    is_heard: bool,
}

impl SessionLog {
    /// Starts recording a session that is about to start, for a robot with these devices in this
    /// scene. With `camera`, the log gets two pictures a second. Live clients get the scene again
    /// each second, so that later clients have it, too.
    pub fn new(
        mut recorder: Recorder,
        devices: &'static [DeviceRow],
        scene: Vec<Shape>,
        camera: bool,
    ) -> Self {
        let scene_again = if recorder.is_live { Instant::ZERO } else { Instant::MAX };
        recorder.scene(Instant::ZERO, scene.clone());
        SessionLog {
            recorder,
            signals: signals(devices).map(|(_, device, row)| Followed::new(device, row)).collect(),
            body: afp_core::devices::find_signal(devices, "robot", "pose"),
            started: false,
            frames: Vec::new(),
            echoes: BTreeMap::new(),
            heights: BTreeMap::new(),
            camera: if camera { Instant::ZERO } else { Instant::MAX },
            has_picture: false,
            shapes: scene,
            moved: Vec::new(),
            scene_again,
            clocks: None,
        }
    }

    /// Also writes the jumps of the wall clock, for a run in real time.
    #[must_use]
    pub fn in_real_time(self) -> Self {
        SessionLog { clocks: Some(Clocks::now()), ..self }
    }

    /// Writes the session's results, waits for the writer and gives the log its name.
    ///
    /// # Errors
    /// The first failure of the writer.
    pub fn finish(mut self, session: &dyn AnySession) -> Result<Written, LogError> {
        let now = session.now();
        // The robot has stopped, so waiting is harmless.
        self.recorder.wait_when_full();
        self.after_loss(now);
        for (at, _, what) in session.pending() {
            let request = Requested { at, what, done: Done::NotReached };
            self.recorder.event(RunEvent::requested(now, request));
        }
        let mut facts = vec![("trace".to_owned(), session.trace().to_string())];
        if let Some(times) = session.loop_times() {
            let LoopTimes { late, steps, .. } = times;
            facts.extend(
                [("loop_late", late), ("loop_steps", steps)]
                    .map(|(key, times)| (key.to_owned(), times.to_string())),
            );
            facts.extend(times.facts(session.names()));
        }
        self.recorder.end(now, facts);
        self.recorder.finish()
    }

    /// Writes a device's value if it has changed.
    fn signal(&mut self, at: Instant, id: SignalId, value: Datum) {
        let Some(followed) = self.signals.get_mut(usize::from(id.0)) else { return };
        followed.is_heard = true;
        if followed.said.as_ref() != Some(&value) {
            followed.said = Some(value.clone());
            self.recorder.sample(at, followed.signal, value);
        }
    }

    /// Writes which devices have become silent.
    fn silence(&mut self, at: Instant) {
        for followed in &mut self.signals {
            let is_heard = std::mem::take(&mut followed.is_heard);
            if !is_heard && followed.said.as_ref().is_some_and(|last| *last != Datum::Unset) {
                followed.said = Some(Datum::Unset);
                self.recorder.sample(at, followed.signal, Datum::Unset);
            }
        }
    }

    /// Writes the state again if a part of it may be lost.
    fn after_loss(&mut self, at: Instant) {
        if !self.recorder.has_told_of_loss(at) {
            return;
        }
        for Followed { signal, said, .. } in &self.signals {
            if let Some(said) = said {
                self.recorder.sample(at, *signal, said.clone());
            }
        }
        self.recorder.scene(at, self.shapes.clone());
        self.echoes.clear();
    }

    /// Writes a jump of the wall clock since the last look.
    fn look_at_clocks(&mut self, at: Instant) {
        let Some((before, now)) = self.clocks.and_then(|before| Some((before, before.next()?)))
        else {
            return;
        };
        self.clocks = Some(now);
        if let Some(jump) = now.jump_since(&before) {
            let text = format!("the wall clock jumped by {jump:+.3} s");
            self.recorder.text(at, Level::Warning, "clock", &text);
        }
    }

    fn device(&self, id: SignalId) -> &'static str {
        self.signals.get(usize::from(id.0)).map_or("", |it| it.signal.device)
    }

    fn outline(&mut self, shape: &Shape) {
        let known = self.shapes.iter_mut().find(|known| known.id == shape.id);
        match known {
            Some(known) if known.outline == shape.outline => return,
            Some(known) => known.clone_from(shape),
            None => self.shapes.push(shape.clone()),
        }
        self.moved.push(shape.clone());
    }
}

impl Observer for SessionLog {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        if !self.started {
            self.started = true;
            self.recorder.started(named.at);
        }
        self.recorder.record(named.at, named.record);
        if let Some(level) = level(named.record) {
            self.recorder.text(named.at, level, "plan", named.text());
        }
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        let text = match applied.refused {
            None => applied.what.to_string(),
            Some(why) => format!("{}: {why}", applied.what),
        };
        let level = if applied.refused.is_some() { Level::Warning } else { Level::Info };
        self.recorder.event(applied.event());
        self.recorder.text(applied.now, level, "outside", &text);
    }

    fn wants_clear_polls(&self) -> bool {
        true
    }

    fn on_loss(&mut self, at: Instant, count: u64, entries: &[Value]) {
        self.recorder.loss(at, count, entries);
    }

    fn sampling(&self) -> Sampling {
        Sampling::Every(SAMPLE)
    }

    fn wants(&self, at: Instant, signal: SignalId) -> bool {
        match self.signals.get(usize::from(signal.0)) {
            Some(Followed { ty: SignalType::Image, .. }) => at >= self.camera,
            other => other.is_some(),
        }
    }

    fn on_sample(&mut self, at: Instant, signal: SignalId, value: SampleRef<'_>) {
        match value {
            SampleRef::Pose(frame) => {
                if self.body == Some(signal) {
                    self.recorder.pose(at, frame.parent, frame.pose);
                }
                self.heights.insert(self.device(signal), frame.height);
                self.frames.push(frame);
            }
            SampleRef::Range(ranging) => {
                if self.echoes.insert(signal, ranging.time) != Some(ranging.time) {
                    let device = self.device(signal);
                    let height = self.heights.get(device).copied().unwrap_or_default();
                    self.recorder.ranging(at, device, ranging, height);
                }
            }
            SampleRef::Image(image) => {
                self.has_picture = true;
                let afp_session::Image { time, frame, width, height, rgb } = image;
                let image = Image { time, frame, width, height, rgb: rgb.into() };
                self.recorder.image(at, self.device(signal), image);
            }
            SampleRef::Outline(shape) => self.outline(shape),
            SampleRef::Bool(_) | SampleRef::Int(_) | SampleRef::Float(_) | SampleRef::Text(_) => {
                self.signal(at, signal, value.value().unwrap_or(Datum::Unset));
            }
        }
    }

    fn after_samples(&mut self, at: Instant) {
        self.silence(at);
        self.look_at_clocks(at);
        if std::mem::take(&mut self.has_picture) {
            self.camera = at + FILM;
        }
        for frames in self.frames.chunks(FRAMES) {
            self.recorder.transforms(at, frames);
        }
        self.frames.clear();
        if at >= self.scene_again {
            self.scene_again = at + SCENES;
            self.moved.clear();
            self.recorder.scene(at, self.shapes.clone());
        }
        if !self.moved.is_empty() {
            self.recorder.scene(at, std::mem::take(&mut self.moved));
        }
        self.after_loss(at);
        // In real time, the writer looks often enough by itself.
        if self.clocks.is_none() {
            self.recorder.wake();
        }
    }
}

impl Followed {
    fn new(device: &DeviceRow, row: &SignalRow) -> Self {
        let signal = Signal { device: device.name, name: row.name, unit: row.ty.unit() };
        Followed { signal, ty: row.ty, said: None, is_heard: false }
    }
}

/// The level of a record as text for people; `None` if it is not interesting.
fn level(record: &Record<'_>) -> Option<Level> {
    match record {
        Record::Faulted { .. } | Record::Ended { ending: Ending::Error(_), .. } => {
            Some(Level::Error)
        }
        Record::Missed { .. } | Record::ClockWentBack { .. } => Some(Level::Warning),
        Record::Event { .. } | Record::Ended { .. } | Record::StopRequested => Some(Level::Info),
        _ => None,
    }
}
