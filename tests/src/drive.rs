//! Runs a plan on the platform of the tests, in virtual time.

use std::panic::{AssertUnwindSafe, catch_unwind};

use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{Line, Names, NoTrace, Record, Sink};
use afp_core::{EntryId, Fault, Instant, Release, Scheduler, StartError, Wake};

use crate::platform::{CostClock, Log, Platform};
use crate::script::{Outside, Script};

/// Writes the trace to the log.
struct Lines<N> {
    names: N,
    log: Log,
}

impl<N: Names> Sink for Lines<N> {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.log.note(Line { at, record, names: &self.names }.to_string());
        if let Record::Faulted { fault, detail: detail @ Some(_), .. } = *record {
            self.log.note(format!("[{}]", fault.explained(detail, &self.names)));
        }
    }
}

struct Run<'s, P: NamedPlan, S> {
    scheduler: Scheduler<P>,
    platform: Platform,
    sink: (Lines<P::Names>, S),
    clock: CostClock,
    log: Log,
    script: &'s Script,
    /// The number of stimuli so far.
    arrived: usize,
    /// The request of a debugger for the next step.
    steered: Option<Steered>,
}

/// A request of a debugger.
#[derive(Clone, Copy)]
enum Steered {
    Hold,
    Release(Release),
}

/// Runs a plan by a script; returns the trace and, in square brackets, the requests to the
/// platform, line by line.
pub fn drive<P>(plan: P, script: &Script) -> Vec<String>
where
    P: NamedPlan + Plan<Platform>,
{
    drive_with(plan, script, NoTrace)
}

/// Like [`drive`]; `sink` also receives the trace as records.
pub fn drive_with<P, S>(plan: P, script: &Script, sink: S) -> Vec<String>
where
    P: NamedPlan + Plan<Platform>,
    S: Sink,
{
    let (log, clock) = (Log::default(), CostClock::default());
    let names = plan.names();
    if script.show_names {
        crate::names::note(&names, &log);
    }
    let mut run = Run {
        scheduler: Scheduler::new(plan),
        platform: Platform::new(script.clone(), log.clone(), clock.clone()),
        sink: (Lines { names, log: log.clone() }, sink),
        clock,
        log: log.clone(),
        script,
        arrived: 0,
        steered: None,
    };
    run.set_inputs();
    if let Some(wake) = run.start() {
        run.run(wake);
        run.check_end();
        if run.scheduler.misses() > 0 {
            run.log.note(format!("[deadlines missed: {}]", run.scheduler.misses()));
        }
    }
    shorten(log.lines(), script.show_last)
}

/// The last lines, after the number of omitted ones.
fn shorten(mut lines: Vec<String>, keep: Option<usize>) -> Vec<String> {
    let more = keep.map_or(0, |keep| lines.len().saturating_sub(keep));
    if more > 0 {
        lines.drain(..more);
        lines.insert(0, format!("[{more} lines]"));
    }
    lines
}

impl<P: NamedPlan + Plan<Platform>, S: Sink> Run<'_, P, S> {
    fn set_inputs(&mut self) {
        for (name, value) in &self.script.inputs {
            let entry = self.scheduler.plan().entry_named(name);
            match entry.map(|entry| self.scheduler.write(entry, value.clone())) {
                None => self.log.note(format!("[no entry {name}]")),
                Some(Err(why)) => self.log.note(format!("[{name} refused: {why}]")),
                Some(Ok(())) => {}
            }
        }
    }

    fn start(&mut self) -> Option<Wake> {
        let on = (&mut self.platform, &mut self.sink, &self.clock);
        let start = || self.scheduler.start(on, Instant::ZERO);
        match catch_unwind(AssertUnwindSafe(start)) {
            Ok(Ok(wake)) => Some(self.noted(wake)),
            Ok(Err(StartError::InputMissing(entry))) => {
                let entry = self.sink.0.names.entry(entry.into()).path;
                self.log.note(format!("[cannot start without {entry}]"));
                None
            }
            Ok(Err(why)) => unreachable!("it is started once: {why}"),
            Err(_) => Some(self.abort()),
        }
    }

    fn run(&mut self, mut wake: Wake) {
        let mut steps = self.script.steps.as_ref().map(|steps| steps.iter());
        while let Wake::At(at) = wake {
            let next = match &mut steps {
                Some(steps) => steps.next().copied(),
                None => Some(self.next(at)).filter(|at| *at <= self.script.until),
            };
            let Some(now) = next else { break };
            self.arrive(now);
            wake = self.step(now);
        }
    }

    /// The next step: at the plan's wake, or at a stimulus.
    fn next(&self, wake: Instant) -> Instant {
        let outside = self.script.outside.get(self.arrived).map_or(Instant::MAX, |(at, _)| *at);
        wake.min(outside).max(self.clock.latest())
    }

    fn arrive(&mut self, now: Instant) {
        while let Some((_, what)) =
            self.script.outside.get(self.arrived).filter(|(at, _)| *at <= now)
        {
            self.arrived += 1;
            match what {
                Outside::Stop => self.scheduler.request_stop(),
                Outside::Hold => self.steered = Some(Steered::Hold),
                Outside::Release(how) => self.steered = Some(Steered::Release(*how)),
                Outside::Write(name, value) => {
                    let entry =
                        self.scheduler.plan().entry_named(name).unwrap_or(EntryId(u16::MAX));
                    if let Err(why) = self.scheduler.write(entry, value.clone()) {
                        self.log.note(format!("{now} [{name} refused: {why}]"));
                    }
                }
            }
        }
    }

    fn step(&mut self, now: Instant) -> Wake {
        if self.script.copied {
            self.scheduler = self.scheduler.try_clone().expect("all components can be copied");
        }
        let on = (&mut self.platform, &mut self.sink, &self.clock);
        let step = || match self.steered.take() {
            None => self.scheduler.step(on, now),
            Some(Steered::Hold) => self.scheduler.hold(on, now),
            Some(Steered::Release(how)) => self.scheduler.release(on, now, how),
        };
        match catch_unwind(AssertUnwindSafe(step)) {
            Ok(wake) => self.noted(wake),
            Err(_) => self.abort(),
        }
    }

    /// Checks that a plan that has ended left no actor.
    fn check_end(&self) {
        let stopped = self.log.lines().iter().any(|line| line == "[emergency stop]");
        if self.scheduler.ending().is_some() && !stopped {
            self.platform.check_end();
        }
    }

    fn abort(&mut self) -> Wake {
        let on = (&mut self.platform, &mut self.sink, &self.clock);
        self.scheduler.abort(on, Fault::PANIC)
    }

    fn noted(&self, wake: Wake) -> Wake {
        if let (true, Wake::At(at)) = (self.script.show_wakes, wake) {
            self.log.note(format!("[wake {at}]"));
        }
        wake
    }
}
