//! Sessions of any plan over any robot: where types end.

use std::any::Any;

use afp_core::devices::{DeviceRow, SignalId};
use afp_core::trace::{ComponentId, Ending, Names, TraceHash};
use afp_core::{Duration, EntryId, Fault, Instant, StartError, Value, ValueRef, WriteError};

use crate::figures::Figures;
use crate::not_set::NotSet;
use crate::observer::{Gate, Go, Next, Observer};
use crate::request::{Request, RequestError, RequestId};
use crate::sample::SampleRef;
use crate::stimulus::Stimulus;

/// A session, whatever its plan and its robot.
pub trait AnySession: Send {
    /// The instant up to which time has passed.
    fn now(&self) -> Instant;

    /// When the next step is made; [`Instant::MAX`] once the plan has ended.
    fn due(&self) -> Instant;

    /// The names of the plan.
    fn names(&self) -> &dyn Names;

    /// The names of the plan, for who outlives the session.
    fn owned_names(&self) -> Box<dyn Names + Send>;

    /// The devices of the robot.
    fn devices(&self) -> &'static [DeviceRow];

    /// The active element of the outermost plan.
    fn active(&self) -> Option<ComponentId>;

    /// How the plan ended, once it has.
    fn ending(&self) -> Option<Ending>;

    /// The value of an entry of the plan itself.
    fn entry(&self, id: EntryId) -> ValueRef<'_>;

    /// Deadlines missed so far, skipped releases included.
    fn misses(&self) -> u64;

    /// What a signal is now.
    fn read(&self, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>));

    /// The value that a text, `35 cm`, is for an entry.
    ///
    /// # Errors
    /// It is none of the entry's type.
    fn read_text(&self, entry: EntryId, text: &str) -> Result<Value, Fault>;

    /// Writes an entry as people write it, `35 cm`: before the start an `in` entry, later with the next step. Gives
    /// the value.
    ///
    /// # Errors
    /// An entry that is not there or cannot be written, a value that does not fit.
    fn set(&mut self, entry: &str, text: &str) -> Result<Value, NotSet>;

    /// Writes an entry: before the start an `in` entry at once, later with the next step.
    ///
    /// # Errors
    /// The value does not fit, the plan has ended, or too many writes wait.
    fn write(&mut self, entry: EntryId, value: Value) -> Result<(), WriteError>;

    /// Asks for something at an instant. It is checked now and done then; what cannot be done then is reported to
    /// observers.
    ///
    /// # Errors
    /// It can never be done.
    fn at(&mut self, at: Instant, request: Request) -> Result<RequestId, RequestError>;

    /// Whether something could be asked for at any instant.
    ///
    /// # Errors
    /// It can never be done.
    fn can(&self, request: &Request) -> Result<(), RequestError>;

    /// How long a run goes on when the plan has ended, so that the robot comes to rest; zero by default.
    fn set_rest(&mut self, rest: Duration);

    /// How late the control loop of a real robot may be before the run ends in an error; nothing in simulation.
    fn set_stall(&mut self, stall: Duration);

    /// Lets time pass up to the next thing to do, but not beyond `limit`, and does it.
    ///
    /// # Errors
    /// The plan cannot start.
    fn tick(
        &mut self,
        limit: Instant,
        gate: &mut dyn Gate,
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError>;

    /// Does the next thing, as [`AnySession::tick`] does without a limit or a gate, and says what that was.
    ///
    /// # Errors
    /// The plan cannot start.
    fn next_step(&mut self, to: &mut [&mut dyn Observer]) -> Result<Next, StartError>;

    /// Runs the plan until `until`, until it has ended and the robot has come to rest, or until the gate stops it;
    /// whether it did. A plan that still runs goes on with the next call.
    ///
    /// # Errors
    /// The plan cannot start.
    fn run(
        &mut self,
        until: Instant,
        gate: &mut dyn Gate,
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError>;

    /// Makes the plan end here and now, as interrupted.
    fn stop(&mut self, to: &mut [&mut dyn Observer]);

    /// Ends the plan here and now because nothing of it can be trusted any more.
    fn abort(&mut self, fault: Fault, to: &mut [&mut dyn Observer]);

    /// Stops the robot for good and says what the run came to.
    fn end(&mut self) -> Figures;

    /// What the run came to so far.
    fn figures(&self) -> Figures;

    /// Whether nothing is left to do before `until`, or at it.
    fn is_over(&self, until: Instant) -> bool;

    /// The robot, for who knows its type.
    fn robot(&self) -> &dyn Any;

    /// The hash of the trace so far, without polls that saw nothing: the same for the same plan, world and seed,
    /// on every machine.
    fn trace(&self) -> TraceHash;

    /// Sets the hash of the trace, which an observer has made.
    fn set_trace(&mut self, trace: TraceHash);

    /// What was asked for so far, with the instants: asked for from the start on, the same run comes of it.
    fn requests(&self) -> &[(Instant, Request)];

    /// The same run at the same instant, which goes on by itself and alike; none where the robot, a measure or a
    /// component cannot be copied.
    fn keyframe(&self) -> Option<Box<dyn AnySession>>;

    /// What was asked for and has not come yet, by time.
    fn pending(&self) -> Vec<(Instant, RequestId, Stimulus)>;
}
