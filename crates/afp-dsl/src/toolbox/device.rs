//! The devices that a toolbox declares: what can be pressed, how they fail, what they signal.
//!
//! Scenarios, generated Rust, and through it command line, logs and Python take a robot's words from here.

use crate::types::Dimension;
use afp_syntax::source::Span;

pub use afp_syntax::ast::DeviceKind;

/// What the robot as a whole is called among devices.
pub const ROBOT: &str = "robot";

#[derive(Clone, Debug)]
pub struct Device {
    pub kind: DeviceKind,
    /// Its name; [`ROBOT`] for the robot as a whole.
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// What can be pressed on it, as written.
    pub controls: Vec<Control>,
    /// How it can fail: of a sensor first the ways in which every sensor can, then as written.
    pub faults: Vec<Fault>,
    /// What it signals, as written.
    pub signals: Vec<Signal>,
    /// The name in the text; of the robot the word `robot`.
    pub span: Span,
}

/// Something that can be held down and let go.
#[derive(Clone, Debug)]
pub struct Control {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// Whether it is there to end what runs; the Escape key of a terminal presses it.
    pub stops: bool,
    /// The name in the text.
    pub span: Span,
}

/// A way in which a device can fail.
#[derive(Clone, Debug)]
pub struct Fault {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// How much of it there can be.
    pub amount: Option<Amount>,
    /// The name in the text; `None` for one that every sensor has.
    pub span: Option<Span>,
}

/// How much of a fault there is, in SI units.
#[derive(Clone, Debug)]
pub struct Amount {
    pub name: String,
    /// Its dimension; none for a plain number.
    pub dimension: Dimension,
    /// What is taken where nothing is said.
    pub default: f64,
    /// The least; infinite where no bound is written.
    pub from: f64,
    /// The greatest; infinite where no bound is written.
    pub to: f64,
    /// The name in the text; `None` for a fault that every sensor has.
    pub span: Option<Span>,
}

/// Something that a device says.
#[derive(Clone, Debug)]
pub struct Signal {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    pub ty: SignalType,
    /// Whether only a judge may know it.
    pub truth: bool,
    /// The name in the text.
    pub span: Span,
}

/// What the values of a signal are.
pub type SignalType = afp_types::devices::SignalType<Dimension>;

/// Types of signals that the language has no values of; for logs and pictures.
pub(crate) const SHOWN: &[(&str, SignalType)] = &[
    ("pose", SignalType::Pose),
    ("range", SignalType::Range),
    ("image", SignalType::Image),
    ("outline", SignalType::Outline),
];

/// A day, seconds: no sensor is later than that.
const LATEST: f64 = 86_400.0;

/// How every sensor can fail: the name, the time that is taken where none is said, what happens.
const EVERY_SENSOR: &[(&str, Option<f64>, &str)] = &[
    ("frozen", None, "It repeats its last value as if it were new."),
    ("lost", None, "It does not answer."),
    ("nan", None, "It delivers what is no number."),
    ("delayed", Some(0.2), "Its readings arrive so much later."),
    ("slow", Some(0.02), "Each use takes so long."),
];

/// The faults that every sensor has.
pub(crate) fn of_every_sensor() -> Vec<Fault> {
    let time = |default| Amount {
        name: "time".to_owned(),
        dimension: Dimension { time: 1, ..Dimension::NONE },
        default,
        from: 0.0,
        to: LATEST,
        span: None,
    };
    let fault = |(name, default, doc): &(&str, Option<f64>, &str)| Fault {
        name: (*name).to_owned(),
        doc: (*doc).to_owned(),
        amount: default.map(time),
        span: None,
    };
    EVERY_SENSOR.iter().map(fault).collect()
}
