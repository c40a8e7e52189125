//! Facts about the events of supervisors, which the checks rely on.

use crate::graph::Formula;
use crate::toolbox::Condition;

/// A declared fact. Entries of its formulas are input ports, by position.
#[derive(Clone, Debug)]
pub enum Fact {
    /// The event holds if and only if all comparisons hold.
    When(u16, Vec<Condition>),
    /// The event is never reported before this time after the start.
    After(u16, Formula),
    /// Two supervisors of the template never report these events at the same time, if all comparisons hold. Entries after
    /// the input ports are those of the supervisor that reports the second event.
    Exclusive([u16; 2], Vec<Condition>),
}
