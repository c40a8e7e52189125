//! A run next to the adapter that drives on by itself: a robot. It is held and not paused, and its
//! operator must answer.

use std::time::Duration as Wall;

use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant, Release};
use afp_session::{EventKind, Request};
use dapts::{StoppedEventReason as Reason, event};

use super::mode::{BATCH, By, Mode};
use super::{Adapter, Answer, Host, Launch, Run};
use crate::breakpoints::Hits;
use crate::live_target::DRIVES;
use crate::target::{Advance, Happened, Target};

/// The interval of looks at the run's events.
const LOOK: Wall = Wall::from_millis(10);
/// The same without clients.
const LOOK_ALONE: Wall = Wall::from_secs(1);
/// The time after which the adapter itself holds a run for a breakpoint.
const LATE: Wall = Wall::from_millis(100);

/// Requests that change the time or the world of a run.
const NOT_LIVE: &[&str] = &[
    "afp/drop",
    "afp/fork",
    "afp/move",
    "afp/seek",
    "afp/speed",
    "goto",
    "restart",
    "reverseContinue",
    "stepBack",
];

/// A breakpoint or an exception that a live run is held for.
#[derive(Clone, Debug)]
pub(super) struct Hit {
    reason: Reason,
    why: String,
    ids: Vec<u64>,
    since: Wall,
}

impl<'h> Adapter<'h> {
    /// An adapter next to a run that drives on by itself. Clients join with `attach`, and the run
    /// continues without them.
    pub fn beside(host: Box<dyn Host<'h> + 'h>, target: Box<dyn Target + 'h>) -> Adapter<'h> {
        let mut adapter = Adapter::new(host);
        adapter.begin_with(target, Launch::default(), Wall::ZERO);
        if let Some(run) = &mut adapter.run {
            run.mode = Mode::On;
            run.has_begun = true;
        }
        adapter
    }

    /// Whether the run next to the adapter has ended.
    pub fn has_ended(&self) -> bool {
        self.run.as_ref().is_none_or(|run| run.mode == Mode::Over)
    }

    pub(super) fn live_due(&self) -> Wall {
        if self.attached().next().is_some() { LOOK } else { LOOK_ALONE }
    }

    /// Rejects requests that no robot can fulfil.
    pub(super) fn check_live(&self, command: &str) -> Answer<()> {
        let live = self.run.as_ref().is_some_and(|run| run.target.is_live());
        if live && NOT_LIVE.contains(&command) { Err(DRIVES.into()) } else { Ok(()) }
    }

    /// Holds the robot; the stop is reported when it is held.
    pub(super) fn hold_live(&mut self) -> Answer<()> {
        let run = self.run()?;
        if !matches!(run.mode, Mode::Held | Mode::Over) {
            run.target.ask(Duration::ZERO, Request::Pause)?;
        }
        Ok(())
    }

    /// As [`Adapter::hold_live`], when the operator of a step is gone.
    pub(super) fn hold_without_operator(&mut self) {
        // Requests of an operator that is gone cannot fill the queue for long.
        if self.hold_live().is_err()
            && let Some(run) = &mut self.run
        {
            let why = "the operator is gone".to_owned();
            run.hit = Some(Hit { reason: Reason::Pause, why, ids: Vec::new(), since: Wall::ZERO });
        }
    }

    /// Continues a held robot.
    pub(super) fn release_live(&mut self, mode: Mode, how: Release) -> Answer<()> {
        let run = self.run()?;
        match run.mode {
            Mode::Over => return Err("the plan has ended".into()),
            Mode::Held => {}
            _ => return Err("the robot is not held: 'pause' holds it".into()),
        }
        run.target.ask(Duration::ZERO, Request::Release(how))?;
        (run.mode, run.exception, run.hit) = (mode, None, None);
        Ok(())
    }

    /// Stops the robot; the end is reported when the plan has ended.
    pub(super) fn stop_live(&mut self) -> Answer<()> {
        let name = self.name_of(self.asker).to_owned();
        let run = self.run()?;
        if run.mode != Mode::Over {
            run.target.ask(Duration::ZERO, Request::Stop)?;
            run.ended_by = Some(name);
        }
        Ok(())
    }

    /// Gives changed breakpoints to a live run.
    pub(super) fn rewire(&mut self) {
        let Some(run) = self.run.as_mut().filter(|run| run.target.is_live()) else { return };
        if !self.breakpoints.changed {
            return;
        }
        let program = run.target.program().clone();
        let tripwire = self.breakpoints.tripwire(&program, run.target.state());
        // If the run cannot take it now, the next call tries again.
        self.breakpoints.changed = run.target.watch(tripwire).is_err();
    }

    /// Reports the events of a live run since the last call.
    pub(super) fn drive_live(&mut self, run: &mut Run<'_>, now: Wall) {
        let program = run.target.program().clone();
        for _ in 0..BATCH {
            let before = run.target.steps();
            let (mut happened, mut hits) = (None, Hits::default());
            let breakpoints = &mut self.breakpoints;
            let advance = run.target.advance(Instant::MAX, &mut |what, state| {
                hits = breakpoints.hits(&what.event, before, &program, state);
                happened = Some(what.clone());
            });
            match (advance, happened) {
                (Ok(Advance::On), Some(what)) => self.on_live(run, &what, hits, now),
                (Ok(Advance::On), None) => {}
                (Ok(Advance::Limit), _) => break,
                (Ok(Advance::Ended) | Err(_), _) => self.end_live(run),
            }
            if run.mode == Mode::Over {
                return;
            }
        }
        let late = run.hit.as_mut().filter(|hit| now.saturating_sub(hit.since) > LATE);
        if let Some(hit) = late.filter(|_| run.mode != Mode::Held) {
            hit.since = now;
            // It is tried again if the queue is full.
            let _ = run.target.ask(Duration::ZERO, Request::Pause);
        }
    }

    fn on_live(&mut self, run: &mut Run<'_>, what: &Happened, hits: Hits, now: Wall) {
        self.say(run, what);
        hits.logs.iter().for_each(|text| self.log(what, text));
        run.keep_trace(std::slice::from_ref(what));
        if let Some(name) = hits.exception {
            run.exception = Some((name, what.text.clone()));
        }
        let reason = match (hits.exception, hits.stop.first()) {
            (Some(_), _) => Some(Reason::Exception),
            (None, first) => first.map(|(_, kind)| kind.reason()),
        };
        if let Some(reason) = reason {
            let (why, since) = (what.text.clone(), now);
            let ids = hits.stop.iter().map(|(id, _)| *id).collect();
            run.hit.get_or_insert(Hit { reason, why, ids, since });
        }
        match &what.event.kind {
            EventKind::Held { .. } => self.held(run, what),
            EventKind::Released => {
                if run.mode == Mode::Held {
                    run.mode = Mode::On;
                }
                let body =
                    dapts::ContinuedEvent { all_threads_continued: Some(true), thread_id: 1 };
                self.event::<event::Continued>(&body);
            }
            EventKind::Ended { .. } if what.event.component.id == ComponentId(0) => {
                self.end_live(run);
            }
            _ => run.keep_forces(std::slice::from_ref(what)),
        }
    }

    fn held(&mut self, run: &mut Run<'_>, what: &Happened) {
        // A forced value must not surprise the operator who continues.
        run.forces.clear();
        let usual = if run.mode.is_step() { Reason::Step } else { Reason::Pause };
        let hit = run.hit.take();
        let (reason, why, ids) = hit
            .map_or((usual, what.text.clone(), Vec::new()), |hit| (hit.reason, hit.why, hit.ids));
        self.stopped_at(run, reason, &why, ids);
    }

    fn end_live(&mut self, run: &mut Run<'_>) {
        let by = run.ended_by.take().map_or(By::Plan, By::Client);
        self.end(run, &by);
    }
}
