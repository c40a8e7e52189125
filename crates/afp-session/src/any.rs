//! Sessions without type parameters, for any plan and robot.

use std::any::Any;

use afp_core::devices::{DeviceRow, SignalId};
use afp_core::trace::{ComponentId, Ending, Names, TraceHash};
use afp_core::{Duration, EntryId, Fault, Instant, StartError, Value, ValueRef, WriteError};

use crate::figures::Figures;
use crate::loop_times::LoopTimes;
use crate::not_set::NotSet;
use crate::observer::{Gate, Go, Next, Observer};
use crate::request::{Request, RequestError, RequestId};
use crate::sample::SampleRef;
use crate::stimulus::Stimulus;

/// A session of any plan and robot.
pub trait AnySession: Send {
    /// The present time of the run.
    fn now(&self) -> Instant;

    /// The time of the next step; [`Instant::MAX`] after the end of the plan.
    fn due(&self) -> Instant;

    /// The names of the plan.
    fn names(&self) -> &dyn Names;

    /// The names of the plan, for owners that outlive the session.
    fn owned_names(&self) -> Box<dyn Names + Send>;

    /// The devices of the robot.
    fn devices(&self) -> &'static [DeviceRow];

    /// The active element of the outermost plan.
    fn active(&self) -> Option<ComponentId>;

    /// The ending of the plan, if it has ended.
    fn ending(&self) -> Option<Ending>;

    /// The value of an entry of the plan itself.
    fn entry(&self, id: EntryId) -> ValueRef<'_>;

    /// Whether the plan is held.
    fn is_held(&self) -> bool;

    /// Deadlines missed so far, skipped releases included.
    fn misses(&self) -> u64;

    /// Reads a signal.
    fn read(&self, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>));

    /// Converts a text such as `35 cm` to a value of an entry.
    ///
    /// # Errors
    /// The text is not a value of the entry's type.
    fn read_text(&self, entry: EntryId, text: &str) -> Result<Value, Fault>;

    /// Writes an entry as text, `35 cm`: before the start an `in` entry, later any entry with the
    /// next step. Returns the value.
    ///
    /// # Errors
    /// The entry does not exist or cannot be written; the value does not fit.
    fn set(&mut self, entry: &str, text: &str) -> Result<Value, NotSet>;

    /// Writes an entry: an `in` entry at once before the start, later any entry with the next step.
    ///
    /// # Errors
    /// The value does not fit, the plan has ended, or too many writes are pending.
    fn write(&mut self, entry: EntryId, value: Value) -> Result<(), WriteError>;

    /// Makes a request for an instant. It is checked now and done then; observers learn if it fails
    /// then.
    ///
    /// # Errors
    /// The request can never be done.
    fn at(&mut self, at: Instant, request: Request) -> Result<RequestId, RequestError>;

    /// Whether a request could be made for some instant.
    ///
    /// # Errors
    /// The request can never be done.
    fn can(&self, request: &Request) -> Result<(), RequestError>;

    /// Sets how long the run continues after the plan's end, so that the robot comes to rest; zero
    /// by default.
    fn set_rest(&mut self, rest: Duration);

    /// Sets the limit for the lateness of a real robot's control loop, beyond which the run ends in
    /// an error. No effect in simulation.
    fn set_stall(&mut self, stall: Duration);

    /// Lets time pass before the start, in which a real robot is heard.
    fn wait(&mut self, to: Instant);

    /// Whether the button that arms the robot is pressed; `None` for a robot without a button.
    fn button(&self) -> Option<bool>;

    /// Lets time pass up to the next event of the run, at most to `limit`, and handles it.
    ///
    /// # Errors
    /// The plan cannot start.
    fn tick(
        &mut self,
        limit: Instant,
        gate: &mut dyn Gate,
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError>;

    /// As [`AnySession::tick`] without limit or gate; returns the kind of event.
    ///
    /// # Errors
    /// The plan cannot start.
    fn next_step(&mut self, to: &mut [&mut dyn Observer]) -> Result<Next, StartError>;

    /// Runs up to `until`, to the end of the plan and the rest of the robot, or until the gate
    /// stops the run; returns whether it did. A plan that has not ended continues with the next
    /// call.
    ///
    /// # Errors
    /// The plan cannot start.
    fn run(
        &mut self,
        until: Instant,
        gate: &mut dyn Gate,
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError>;

    /// Ends the plan now, as interrupted.
    fn stop(&mut self, to: &mut [&mut dyn Observer]);

    /// Ends the plan now with a fault, because it can no longer be trusted.
    fn abort(&mut self, fault: Fault, to: &mut [&mut dyn Observer]);

    /// Stops the robot permanently and returns the results.
    fn end(&mut self) -> Figures;

    /// The results so far.
    fn figures(&self) -> Figures;

    /// Whether the run has no event left up to `until`.
    fn is_over(&self, until: Instant) -> bool;

    /// The robot, for a downcast.
    fn robot(&self) -> &dyn Any;

    /// The hash of the trace so far, without polls that found no event. It is the same for the same
    /// plan, world and seed, on every machine.
    fn trace(&self) -> TraceHash;

    /// Sets the hash of the trace, if an observer computes it.
    fn set_trace(&mut self, trace: TraceHash);

    /// The times of a real robot's control loop; `None` in simulation.
    fn loop_times(&self) -> Option<&LoopTimes>;

    /// All requests so far with their times. The same requests make the same run.
    fn requests(&self) -> &[(Instant, Request)];

    /// A copy of the run that continues in the same way; `None` if the robot, a measure or a
    /// component cannot be copied.
    fn keyframe(&self) -> Option<Box<dyn AnySession>>;

    /// Requests whose time has not come, by time.
    fn pending(&self) -> Vec<(Instant, RequestId, Stimulus)>;
}
