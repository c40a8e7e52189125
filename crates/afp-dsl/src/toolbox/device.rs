//! The devices of a toolbox: controls, faults, signals.
//!
//! Scenarios and generated Rust, and thus command line, logs and Python, use these names.

use crate::types::Dimension;
use afp_syntax::source::Span;

pub use afp_syntax::ast::DeviceKind;

pub const ROBOT: &str = "robot";

#[derive(Clone, Debug)]
pub struct Device {
    pub kind: DeviceKind,
    /// Its name; [`ROBOT`] for the whole robot.
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// Its controls, in source order.
    pub controls: Vec<Control>,
    /// Its faults: for a sensor first those of every sensor, then in source order.
    pub faults: Vec<Fault>,
    /// Its signals, in source order.
    pub signals: Vec<Signal>,
    /// Its name, or the keyword `robot`.
    pub span: Span,
}

/// A control that can be pressed and released.
#[derive(Clone, Debug)]
pub struct Control {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// Whether it stops the plan; the Escape key of a terminal presses it.
    pub stops: bool,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Fault {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    pub amount: Option<Amount>,
    /// Its name; `None` for a fault of every sensor.
    pub span: Option<Span>,
}

/// The amount of a fault, in SI units.
#[derive(Clone, Debug)]
pub struct Amount {
    pub name: String,
    /// Its dimension; none for a plain number.
    pub dimension: Dimension,
    /// The default.
    pub default: f64,
    /// The minimum; infinite if unbounded.
    pub from: f64,
    /// The maximum; infinite if unbounded.
    pub to: f64,
    /// Its name; `None` for a fault of every sensor.
    pub span: Option<Span>,
}

#[derive(Clone, Debug)]
pub struct Signal {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    pub ty: SignalType,
    /// Whether it is ground truth, only for judges.
    pub truth: bool,
    pub span: Span,
}

/// The type of a signal's values.
pub type SignalType = afp_types::devices::SignalType<Dimension>;

/// Types of signals without values in the language; for logs and pictures.
pub(crate) const SHOWN: &[(&str, SignalType)] = &[
    ("pose", SignalType::Pose),
    ("range", SignalType::Range),
    ("image", SignalType::Image),
    ("outline", SignalType::Outline),
];

/// A day in seconds, the maximum delay of a sensor.
const LATEST: f64 = 86_400.0;

/// Faults of every sensor: name, default time, effect.
const EVERY_SENSOR: &[(&str, Option<f64>, &str)] = &[
    ("frozen", None, "It repeats its last value as a new value."),
    ("lost", None, "It does not answer."),
    ("nan", None, "Its values are not numbers."),
    ("delayed", Some(0.2), "Its readings arrive late by this time."),
    ("slow", Some(0.02), "Each use takes this time."),
];

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
