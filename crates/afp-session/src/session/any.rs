//! Every session as one type.

use std::any::Any;

use afp_core::devices::{DeviceRow, SignalId};
use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{ComponentId, Ending, Names, TraceHash};
use afp_core::{Duration, EntryId, Fault, Instant, StartError, Value, ValueRef, WriteError};

use super::{Session, report};
use crate::any::AnySession;
use crate::figures::Figures;
use crate::loop_times::LoopTimes;
use crate::not_set::NotSet;
use crate::observer::{Gate, Go, Next, Observer};
use crate::record::Keep;
use crate::request::{Request, RequestError, RequestId};
use crate::robot::Robot;
use crate::sample::SampleRef;
use crate::stimulus::Stimulus;

impl<P, R, S> AnySession for Session<P, R, S>
where
    P: NamedPlan + Plan<R>,
    R: Robot,
    S: Keep + Clone + 'static,
    P: 'static,
    R: 'static,
    Session<P, R, S>: Send,
{
    fn now(&self) -> Instant {
        self.robot.now()
    }

    fn due(&self) -> Instant {
        self.due()
    }

    fn names(&self) -> &dyn Names {
        &self.names
    }

    fn owned_names(&self) -> Box<dyn Names + Send> {
        Box::new(self.scheduler.plan().names())
    }

    fn devices(&self) -> &'static [DeviceRow] {
        self.table()
    }

    fn active(&self) -> Option<ComponentId> {
        report::active(&self.scheduler)
    }

    fn ending(&self) -> Option<Ending> {
        self.ending()
    }

    fn is_held(&self) -> bool {
        self.is_held()
    }

    fn entry(&self, id: EntryId) -> ValueRef<'_> {
        self.scheduler.plan().entry(id.0)
    }

    fn misses(&self) -> u64 {
        self.scheduler.misses()
    }

    fn read(&self, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>)) {
        self.read(signal, to);
    }

    fn read_text(&self, entry: EntryId, text: &str) -> Result<Value, Fault> {
        self.scheduler.plan().read(entry, text)
    }

    fn set(&mut self, entry: &str, text: &str) -> Result<Value, NotSet> {
        self.set(entry, text)
    }

    fn write(&mut self, entry: EntryId, value: Value) -> Result<(), WriteError> {
        self.write(entry, value)
    }

    fn at(&mut self, at: Instant, request: Request) -> Result<RequestId, RequestError> {
        self.at(at, request)
    }

    fn can(&self, request: &Request) -> Result<(), RequestError> {
        self.can(request)
    }

    fn set_rest(&mut self, rest: Duration) {
        self.set_rest(rest);
    }

    fn set_stall(&mut self, stall: Duration) {
        self.stall = self.stall.map(|_| stall);
    }

    fn wait(&mut self, to: Instant) {
        self.robot.advance(to);
    }

    fn button(&self) -> Option<bool> {
        self.robot.button()
    }

    fn tick(
        &mut self,
        limit: Instant,
        gate: &mut dyn Gate,
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError> {
        self.tick(limit, gate, to)
    }

    fn next_step(&mut self, to: &mut [&mut dyn Observer]) -> Result<Next, StartError> {
        self.next_step(to)
    }

    fn run(
        &mut self,
        until: Instant,
        gate: &mut dyn Gate,
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError> {
        self.run(until, gate, to)
    }

    fn stop(&mut self, to: &mut [&mut dyn Observer]) {
        self.stop(to);
    }

    fn abort(&mut self, fault: Fault, to: &mut [&mut dyn Observer]) {
        self.abort(fault, to);
    }

    fn end(&mut self) -> Figures {
        self.end()
    }

    fn figures(&self) -> Figures {
        self.figures()
    }

    fn is_over(&self, until: Instant) -> bool {
        self.is_over(until)
    }

    fn robot(&self) -> &dyn Any {
        &self.robot
    }

    fn trace(&self) -> TraceHash {
        self.trace()
    }

    fn set_trace(&mut self, trace: TraceHash) {
        self.trace = trace;
    }

    fn loop_times(&self) -> Option<&LoopTimes> {
        self.meter.as_deref().map(|meter| &meter.times)
    }

    fn requests(&self) -> &[(Instant, Request)] {
        self.requests()
    }

    fn keyframe(&self) -> Option<Box<dyn AnySession>> {
        Some(Box::new(self.keyframe()?))
    }

    fn pending(&self) -> Vec<(Instant, RequestId, Stimulus)> {
        self.pending()
    }
}
