//! Steps a plan on its world and keeps the trace.

use afp_core::trace::{Ending, Line, Record, Sink};
use afp_core::{EntryId, Instant, Scheduler, StartError, Value, Wake, WriteError};

use super::build::Builder;
use super::ms;
use super::names::SpecNames;
use super::scripted::Scripted;
use super::world::{CostClock, World};

pub struct Lines {
    names: SpecNames,
    lines: Vec<String>,
}

impl Sink for Lines {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.lines.push(Line { at, record, names: &self.names }.to_string());
    }
}

pub struct Run {
    pub scheduler: Scheduler<Scripted>,
    pub world: World,
    clock: CostClock,
    sink: Lines,
    pub wake: Wake,
}

impl Run {
    pub fn ready(plan: Builder, world: World) -> Self {
        let spec = plan.build();
        let names = SpecNames::new(&spec);
        let clock = world.clock.clone();
        Run {
            scheduler: Scheduler::new(Scripted::new(spec)),
            world,
            clock,
            sink: Lines { names, lines: Vec::new() },
            wake: Wake::At(Instant::ZERO),
        }
    }

    pub fn started(plan: Builder, world: World) -> Self {
        let mut run = Run::ready(plan, world);
        run.start().expect("it can start");
        run
    }

    pub fn start(&mut self) -> Result<Wake, StartError> {
        let on = (&mut self.world, &mut self.sink, &self.clock);
        self.wake = self.scheduler.start(on, Instant::ZERO)?;
        Ok(self.wake)
    }

    /// Steps at a time in milliseconds.
    pub fn step(&mut self, at: u64) -> Wake {
        let on = (&mut self.world, &mut self.sink, &self.clock);
        self.wake = self.scheduler.step(on, ms(at));
        self.wake
    }

    /// Steps at each requested instant up to and including `end`, milliseconds.
    pub fn until(&mut self, end: u64) -> &mut Self {
        while let Wake::At(at) = self.wake {
            if at > ms(end) {
                break;
            }
            let on = (&mut self.world, &mut self.sink, &self.clock);
            let wake = self.scheduler.step(on, at);
            assert!(!matches!(wake, Wake::At(next) if next <= at), "the scheduler spins at {at}");
            self.wake = wake;
        }
        self
    }

    pub fn write(&mut self, entry: &str, value: i64) -> Result<(), WriteError> {
        let entry = self.scheduler.plan().spec().entry(entry);
        self.scheduler.write(EntryId(entry), Value::Int(value))
    }

    pub fn names(&self) -> &SpecNames {
        &self.sink.names
    }

    pub fn failure(&self) -> Option<String> {
        self.scheduler.failure().map(|failure| failure.named(&self.sink.names).to_string())
    }

    pub fn abort(&mut self) {
        let fault = afp_core::Fault::PANIC;
        self.wake = self.scheduler.abort((&mut self.world, &mut self.sink, &self.clock), fault);
    }

    pub fn entry(&self, name: &str) -> Value {
        self.scheduler.plan().get(name)
    }

    pub fn ending(&self) -> Option<Ending> {
        self.scheduler.ending()
    }

    pub fn active(&self) -> Option<&'static str> {
        let active = self.scheduler.active()?;
        Some(self.scheduler.plan().spec().elements[active.index()].name)
    }

    pub fn trace(&mut self) -> Vec<String> {
        std::mem::take(&mut self.sink.lines)
    }

    /// The trace since the last call, without polls that saw nothing and without starts.
    pub fn story(&mut self) -> Vec<String> {
        let mut lines = self.trace();
        lines.retain(|line| !line.ends_with("polled: clear"));
        lines
    }

    /// Calls of one kind, as `5 interrupt go`.
    pub fn calls(&self, what: &str) -> Vec<&str> {
        let of_kind = |call: &&str| call.split(' ').nth(1) == Some(what);
        self.world.calls.iter().map(String::as_str).filter(of_kind).collect()
    }

    pub fn emergency_stops(&self) -> usize {
        self.world.calls.iter().filter(|call| *call == "emergency stop").count()
    }
}

/// Compares a trace with the lines of a text; leading spaces are ignored.
#[track_caller]
pub fn assert_lines(actual: &[String], expected: &str) {
    let expected: Vec<&str> =
        expected.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    assert!(actual == expected, "expected\n{}\ngot\n{}", expected.join("\n"), actual.join("\n"));
}
