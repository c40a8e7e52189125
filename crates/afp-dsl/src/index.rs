//! What every name means.

mod record;

pub(crate) use record::{Found, Meanings, Recorder};

/// A word of the language, or of the robot, that needs no declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Word {
    /// The state `OK` of a sub-plan.
    Ok,
    /// The state `Interrupted` of a sub-plan.
    Interrupted,
    /// The edge `Error` of an element.
    Error,
    /// The edge `DeadlineMissed` of a supervisor.
    DeadlineMissed,
    /// The target `terminate`.
    Terminate,
    /// The target `ignore`.
    Ignore,
    /// A built-in type, such as `length`.
    Type,
    /// `true` or `false`
    Truth,
    /// What a template commands, behind `uses`.
    Resource,
    /// A button, bumper or sensor of the robot, in a scenario.
    Device,
    /// Something about the robot that a scenario can expect, such as `collision`.
    Fact,
    /// What a scenario's fault is told, such as `kind`.
    Argument,
    /// Every actor, behind `idle`.
    All,
}
