//! Reports to observers and measures.

use std::fmt::Write;

use afp_core::devices::Devices;
use afp_core::devices::SignalId;
use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{ComponentId, Ending, Line, Names};
use afp_core::{EntryId, Fault, Instant, Scheduler, ValueRef};

use super::Session;
use crate::observer::{Inside, NamedRecord, Observer, View};
use crate::record::{Keep, is_clear};
use crate::robot::{Robot, read_signal};
use crate::sample::SampleRef;
use crate::sampling::{Samples, Turn};

/// The content of a view of a session.
struct Looked<'a, P: NamedPlan, R> {
    scheduler: &'a Scheduler<P>,
    robot: &'a R,
    names: &'a P::Names,
}

impl<P: NamedPlan, R: Robot> Inside for Looked<'_, P, R> {
    fn entry(&self, id: EntryId) -> ValueRef<'_> {
        self.scheduler.plan().entry(id.0)
    }

    fn active(&self) -> Option<ComponentId> {
        active(self.scheduler)
    }

    fn ending(&self) -> Option<Ending> {
        self.scheduler.ending()
    }

    fn names(&self) -> &dyn Names {
        self.names
    }

    fn read(&self, at: Instant, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>)) {
        let table = <R::Devices as Devices>::TABLE;
        self.robot.sample(&mut Samples::of_one(at, table, signal, to));
    }
}

/// The active element of the outermost plan.
pub(super) fn active<P: NamedPlan>(scheduler: &Scheduler<P>) -> Option<ComponentId> {
    scheduler.active().map(|element| ComponentId(u32::from(element.0) + 1))
}

impl<P, R, S> Session<P, R, S>
where
    P: NamedPlan + Plan<R>,
    R: Robot,
    S: Keep,
{
    /// Reports the records of the step to measures and observers.
    pub(super) fn report_records(&mut self, to: &mut [&mut dyn Observer]) {
        let Session { robot, names, sink, trace, makes_trace, line, measures, .. } = self;
        let records = sink.take();
        for owned in &records {
            let (at, record) = (owned.at, owned.get());
            line.clear();
            let clear = is_clear(&record);
            if !clear && *makes_trace {
                // Writing to a `String` cannot fail.
                let _ = write!(line, "{}", Line { at, record: &record, names: &*names });
                trace.line(line);
            }
            let named = NamedRecord { at, record: &record, names: &*names, line };
            if !clear {
                measures.iter_mut().for_each(|measure| measure.on_record(&named, robot));
            }
            for observer in to.iter_mut().filter(|each| !clear || each.wants_clear_polls()) {
                observer.on_record(&named);
            }
        }
        sink.give_back(records);
    }

    /// Reports the end of a step to observers, after the samples of the step.
    pub(super) fn report_step(&mut self, now: Instant, to: &mut [&mut dyn Observer]) {
        let wrong = self.take_samples(now, Turn::Step, to);
        let Session { scheduler, robot, names, .. } = self;
        let looked = Looked { scheduler, robot, names };
        let view = View { now, inside: &looked };
        to.iter_mut().for_each(|observer| observer.after_step(&view));
        if let Some(wrong) = wrong {
            self.distrust(wrong, to);
        }
    }

    /// Gives samples to the observers whose turn it is; returns the fault of a sample, if there was
    /// one.
    pub(super) fn take_samples(
        &self,
        now: Instant,
        turn: Turn,
        to: &mut [&mut dyn Observer],
    ) -> Option<Fault> {
        if turn == Turn::Step && !to.iter().any(|each| each.sampling().follows()) {
            return None;
        }
        let mut samples = Samples::of_turn(now, self.table(), to, turn);
        self.robot.sample(&mut samples);
        samples.finish()
    }

    /// Reads a signal.
    pub fn read(&self, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>)) {
        read_signal(&self.robot, signal, to);
    }
}
