//! The words for what scenarios do to a robot: its controls, its devices and how they fail.
//!
//! The simulator has faults of the same names; a test of `afp-test` compares them.

use crate::toolbox::Constant;

/// What can be pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// The robot's button.
    Escape,
    /// The bumper.
    Touch,
}

impl Control {
    /// Every one of them.
    pub const ALL: &'static [Control] = &[Control::Escape, Control::Touch];

    /// How it is written.
    pub fn word(self) -> &'static str {
        match self {
            Control::Escape => "escape",
            Control::Touch => "touch",
        }
    }

    /// The one that is written so.
    pub fn parse(word: &str) -> Option<Control> {
        Control::ALL.iter().copied().find(|control| control.word() == word)
    }
}

/// A device that fails in a way.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The device.
    pub device: &'static str,
    /// The way.
    pub kind: &'static str,
    /// How late, how slow or how much is left; of the type that [`amount`] names.
    pub amount: Option<Constant>,
}

/// How sensors fail.
const SENSOR: &[&str] = &["frozen", "lost", "delayed", "nan", "slow"];

/// What can fail, and how.
pub const DEVICES: &[(&str, &[&str])] = &[
    ("ultrasonic", SENSOR),
    ("rotator", &["frozen", "lost", "delayed", "nan", "slow", "stuck"]),
    ("odometry", SENSOR),
    ("touch", SENSOR),
    ("buttons", SENSOR),
    ("infrared", SENSOR),
    ("color", SENSOR),
    ("camera", SENSOR),
    ("battery", &["frozen", "lost", "delayed", "nan", "slow", "low"]),
    ("left_motor", &["stalled"]),
    ("right_motor", &["stalled"]),
    ("wheels", &["slip"]),
    ("controller", &["dead"]),
];

/// What more can be said of a kind: a name and its type in the language.
pub fn amount(kind: &str) -> Option<(&'static str, &'static str)> {
    match kind {
        "delayed" | "slow" => Some(("time", "duration")),
        "slip" | "low" => Some(("share", "float")),
        _ => None,
    }
}
