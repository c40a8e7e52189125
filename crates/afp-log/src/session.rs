//! A log as an observer of a session.

use std::path::Path;

use afp_core::devices::{DeviceRow, SignalId, SignalType, signals};
use afp_core::trace::{Ending, Record, Sink};
use afp_core::{Duration, Instant};
use afp_session::{NamedRecord, Observer, SAMPLE, SampleRef, Sampling, Shape};

use crate::error::LogError;
use crate::names::NameTable;
use crate::recorder::{About, FRAMES, Recorder, WhenFull, Written};
use crate::robot::{Image, Level, Transform};

/// How often a log gets what the camera sees.
const FILM: Duration = Duration::from_millis(500);

/// Records a session: its trace, and what its robot signals.
pub struct SessionLog {
    recorder: Recorder,
    signals: Vec<SignalType>,
    /// The frame whose place has a channel of its own.
    body: Option<SignalId>,
    started: bool,
    frames: Vec<Transform>,
    /// When the last echo was sent that the log has.
    last_echo: Option<Instant>,
    /// When the camera is looked at next; never where it is not to be logged.
    camera: Instant,
    /// What moves, as it was last written.
    shapes: Vec<Shape>,
    moved: Vec<Shape>,
}

impl SessionLog {
    /// Begins a log of a session about to start, of a robot with those devices in that scene. With `camera` it gets
    /// what the camera sees, twice a second.
    ///
    /// # Errors
    /// [`LogError::Create`] when the file cannot be made.
    pub fn create(
        path: &Path,
        about: &About,
        names: NameTable,
        devices: &[DeviceRow],
        scene: Vec<Shape>,
        camera: bool,
    ) -> Result<Self, LogError> {
        let mut recorder = Recorder::create(path, about, names, WhenFull::Wait)?;
        recorder.scene(Instant::ZERO, scene.clone());
        Ok(SessionLog {
            recorder,
            signals: signals(devices).map(|(_, _, row)| row.ty).collect(),
            body: afp_core::devices::find_signal(devices, "robot", "pose"),
            started: false,
            frames: Vec::new(),
            last_echo: None,
            camera: if camera { Instant::ZERO } else { Instant::MAX },
            shapes: scene,
            moved: Vec::new(),
        })
    }

    /// Waits for the writer and gives the log its name.
    ///
    /// # Errors
    /// The first failure of the writer.
    pub fn finish(self) -> Result<Written, LogError> {
        self.recorder.finish()
    }

    /// Notes where something is, if it has moved since.
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

    fn wants_clear_polls(&self) -> bool {
        true
    }

    fn sampling(&self) -> Sampling {
        Sampling::Every(SAMPLE)
    }

    fn wants(&self, at: Instant, signal: SignalId) -> bool {
        match self.signals.get(usize::from(signal.0)) {
            Some(SignalType::Image) => at >= self.camera,
            Some(SignalType::Pose | SignalType::Range | SignalType::Outline) => true,
            _ => false,
        }
    }

    fn on_sample(&mut self, at: Instant, signal: SignalId, value: SampleRef<'_>) {
        match value {
            SampleRef::Pose(frame) => {
                if self.body == Some(signal) {
                    self.recorder.pose(at, frame.parent, frame.pose);
                }
                self.frames.push(frame);
            }
            SampleRef::Range(ranging) if self.last_echo != Some(ranging.time) => {
                self.last_echo = Some(ranging.time);
                self.recorder.ranging(at, ranging);
            }
            SampleRef::Image(image) => {
                self.camera = at + FILM;
                let afp_session::Image { time, frame, width, height, rgb } = image;
                self.recorder.image(at, Image { time, frame, width, height, rgb: rgb.into() });
            }
            SampleRef::Outline(shape) => self.outline(shape),
            _ => {}
        }
    }

    fn after_samples(&mut self, at: Instant) {
        for frames in self.frames.chunks(FRAMES) {
            self.recorder.transforms(at, frames);
        }
        self.frames.clear();
        if !self.moved.is_empty() {
            self.recorder.scene(at, std::mem::take(&mut self.moved));
        }
    }
}

/// What people who read the log as text want to know, and how much it matters.
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
