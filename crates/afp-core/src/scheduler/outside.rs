//! Input from outside: values of entries, and the stop request.

use core::error::Error;
use core::fmt;
use core::marker::PhantomData;

use afp_types::{EntryId, Value, ValueRef};

use super::{Scheduler, State};
use crate::fault::Fault;
use crate::rt::{NamedPlan, PlanState, Writable, WriteError};
use crate::trace::{EntryKind, Names, TraceEntryId};

/// An entry of the plan `P` that takes values of type `T` from outside. `plan!` generates a
/// constant for each `in` and `var` entry: `Patrol::WAY`.
pub struct TypedEntry<P, T> {
    position: EntryId,
    of: PhantomData<fn(P, T)>,
}

/// Why an entry cannot be set by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SetError {
    /// The plan has no entry with this name.
    Unknown,
    /// The string is not a value of the entry's type.
    Unreadable {
        /// The reason.
        why: Fault,
        /// A valid example.
        help: &'static str,
    },
    /// The entry rejects the value.
    Refused(WriteError),
}

impl<P, T> TypedEntry<P, T> {
    /// The entry at a position in the plan.
    #[doc(hidden)]
    pub const fn new(position: u16) -> Self {
        TypedEntry { position: EntryId(position), of: PhantomData }
    }

    /// The position among the plan's entries.
    pub const fn position(self) -> EntryId {
        self.position
    }
}

impl<P, T> Clone for TypedEntry<P, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P, T> Copy for TypedEntry<P, T> {}

impl<P, T> fmt::Debug for TypedEntry<P, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "TypedEntry({})", self.position.0)
    }
}

impl fmt::Display for SetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SetError::Unknown => f.write_str("the plan has no such entry"),
            SetError::Unreadable { why, help } => write!(f, "{why}; {help}"),
            SetError::Refused(why) => why.fmt(f),
        }
    }
}

impl Error for SetError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            SetError::Unknown => None,
            SetError::Unreadable { why, .. } => Some(why),
            SetError::Refused(why) => Some(why),
        }
    }
}

impl From<WriteError> for SetError {
    fn from(why: WriteError) -> Self {
        SetError::Refused(why)
    }
}

/// How to write a value of an entry.
fn help(names: &impl Names, id: TraceEntryId) -> &'static str {
    let entry = names.entry(id);
    match entry.ty {
        "bool" => "write 'true' or 'false'",
        "int" => "write a whole number, such as '3'",
        "float" => "write a number, such as '0.5'",
        "string" => "write a shorter string",
        _ if !entry.unit.is_empty() => "write a number and a unit that fits, such as '80 cm'",
        _ if names.holds_object(id) => "only templates make objects: an object has no written form",
        _ => "write one of the values that its enum declares, with or without the enum's name",
    }
}

impl<P: PlanState> Scheduler<P> {
    /// Sets an entry: before the start an `in` entry, immediately; later an `in` or `var` entry, by
    /// the next step's commit. In the examples `Patrol` is a plan with an `in way: length`.
    ///
    /// ```ignore
    /// plan.set(Patrol::WAY, Length::from_si(0.8))?;
    /// ```
    ///
    /// # Errors
    /// [`WriteError`], without any effect.
    pub fn set<T: Writable>(
        &mut self,
        entry: TypedEntry<P, T>,
        value: T,
    ) -> Result<(), WriteError> {
        self.write(entry.position, value.to_value())
    }

    /// As [`Scheduler::set`], by name, with a value written as in the plan; strings without quotes.
    ///
    /// ```ignore
    /// plan.set_named("way", "80 cm")?;
    /// ```
    ///
    /// # Errors
    /// [`SetError`], without any effect.
    pub fn set_named(&mut self, entry: &str, text: &str) -> Result<(), SetError>
    where
        P: NamedPlan,
    {
        let (position, value) = self.read_named(entry, text)?;
        Ok(self.write(position, value)?)
    }

    /// Returns the position and the value that [`Scheduler::set_named`] writes.
    ///
    /// # Errors
    /// [`SetError`]: the entry is unknown or cannot be set now, or the string is not a value of its type.
    pub fn read_named(&self, entry: &str, text: &str) -> Result<(EntryId, Value), SetError>
    where
        P: NamedPlan,
    {
        let plan = self.plan();
        let position = plan.entry_named(entry).ok_or(SetError::Unknown)?;
        let names = plan.names();
        let id = position.into();
        match names.entry(id).kind {
            EntryKind::Out | EntryKind::Const => return Err(WriteError::ReadOnly.into()),
            EntryKind::Var if self.state == State::Ready => {
                return Err(WriteError::NotStarted.into());
            }
            EntryKind::In | EntryKind::Var => {}
        }
        let unreadable = |why| SetError::Unreadable { why, help: help(&names, id) };
        Ok((position, plan.read(position, text).map_err(unreadable)?))
    }

    /// As [`Scheduler::set`], with any value; quantities are in SI units.
    ///
    /// # Errors
    /// [`WriteError`], without any effect.
    pub fn write(&mut self, entry: EntryId, value: Value) -> Result<(), WriteError> {
        match self.state {
            State::Ready => self.machine.plan_mut().set_input(entry.0, &value),
            State::Running | State::Held => {
                self.machine.plan().accepts(entry.0, &value)?;
                self.writes.push_back((entry.0, value)).map_err(|_| WriteError::QueueFull)
            }
            State::Broken { .. } | State::Ended(_) => Err(WriteError::Ended),
        }
    }

    /// The committed value of an entry of the outermost plan, by name; quantities are in SI units.
    /// [`ValueRef::Unset`] before the first write, `None` for an unknown entry.
    pub fn get(&self, entry: &str) -> Option<ValueRef<'_>>
    where
        P: NamedPlan,
    {
        let plan = self.plan();
        plan.entry_named(entry).map(|position| plan.entry(position.0))
    }

    /// Requests a stop: the next step interrupts the plan and ends it as `Interrupted`. A plan that
    /// has not started then ends at its start, before anything runs.
    pub fn request_stop(&mut self) {
        self.stop_requested = true;
    }
}
