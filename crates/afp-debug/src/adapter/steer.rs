//! Advances time until a step is complete, a breakpoint is hit, or a client pauses the run.

use std::time::Duration as Wall;

use afp_core::Release;
use afp_core::trace::ComponentId;
use afp_session::EventKind;
use dapts::{SteppingGranularity, StoppedEventReason as Reason};
use serde::Deserialize;
use serde_json::{Value, json};

use super::goto::is_there;
use super::mode::{BATCH, By, Mode, Pace, STATES, pause_after};
use super::{Adapter, Answer, Run};
use crate::breakpoints::Hits;
use crate::program::Program;
use crate::target::{Advance, Happened};

#[derive(Deserialize)]
pub(super) struct Step {
    pub granularity: Option<SteppingGranularity>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Subscribe {
    state: bool,
    sensed: bool,
    trace: bool,
}

impl Adapter<'_> {
    /// Starts or ends the asking client's subscriptions.
    pub(super) fn subscribe(&mut self, asked: Subscribe) -> Answer<()> {
        self.run()?;
        if let Some(client) = self.clients.get_mut(&self.asker) {
            (client.state, client.sensed) = (asked.state, asked.sensed);
        }
        self.trace(asked.trace)?;
        self.send_state();
        self.send_roles();
        Ok(())
    }

    /// Returns the time until the run must advance; `None` if it waits for a client.
    pub fn due(&self) -> Option<Wall> {
        let run = self.run.as_ref()?;
        let due = match run.mode {
            Mode::Over => None,
            _ if run.target.is_live() => Some(self.live_due()),
            Mode::Held => None,
            Mode::Seek { .. } => Some(Wall::ZERO),
            _ if run.pace.factor.is_none() => Some(Wall::ZERO),
            _ => Some(Wall::from_millis(10)),
        };
        due.into_iter().chain(self.lease_due()).min()
    }

    pub(super) fn go(&mut self, mode: Mode, now: Wall) -> Answer<()> {
        let run = self.run()?;
        if run.mode == Mode::Over {
            return Err(
                "the plan has ended: 'restart' starts it again, 'stepBack' goes back".into()
            );
        }
        run.mode = mode;
        run.exception = None;
        run.touched = run.target.contact();
        run.pace = Pace::new(run.pace.factor, run.target.now(), now);
        Ok(())
    }

    pub(super) fn go_on(&mut self, now: Wall) -> Answer<Value> {
        match self.run()?.target.is_live() {
            true => self.release_live(Mode::On, Release::Continue)?,
            false => self.go(Mode::On, now)?,
        }
        Ok(json!({"allThreadsContinued": true}))
    }

    pub(super) fn step(&mut self, command: &str, step: Step, now: Wall) -> Answer<()> {
        if self.run()?.target.is_live() {
            return self.release_live(Mode::Next(ComponentId(0)), Release::Step);
        }
        let stack = self.run()?.target.state().stack();
        let program = self.run()?.target.program().clone();
        let plan =
            stack.last().and_then(|id| program.unit(*id)).map_or(ComponentId(0), |it| it.plan);
        let mode = match (command, step.granularity) {
            (_, Some(SteppingGranularity::Instruction)) => Mode::One,
            ("next", _) => Mode::Next(plan),
            ("stepIn", _) => Mode::Into,
            _ => Mode::Out(plan),
        };
        self.go(mode, now)
    }

    pub(super) fn pause(&mut self) -> Answer<()> {
        let run = self.run()?;
        if run.target.is_live() {
            return self.hold_live();
        }
        if !matches!(run.mode, Mode::Held | Mode::Over) {
            self.stopped(Reason::Pause, "paused", Vec::new());
        }
        Ok(())
    }

    /// Advances until something stops the run, it catches up with the wall clock, or the batch is
    /// done.
    pub(super) fn drive(&mut self, now: Wall) {
        let Some(mut run) = self.run.take() else { return };
        match run.mode {
            Mode::Over => {}
            _ if run.target.is_live() => self.drive_live(&mut run, now),
            Mode::Held => {}
            Mode::Seek { to, goes_on } => self.seek_on(&mut run, to, goes_on, now),
            _ => self.drive_run(&mut run, now),
        }
        if run.mode != Mode::Held && now >= run.next_state {
            self.send_trace(&mut run);
            let bytes = self.send_state_of(&run);
            let pause = if run.target.is_live() { pause_after(bytes) } else { Wall::ZERO };
            run.next_state = now + pause.max(STATES);
        }
        self.run = Some(run);
    }

    fn drive_run(&mut self, run: &mut Run<'_>, now: Wall) {
        let limit = run.pace.limit(now).min(run.end);
        let program = run.target.program().clone();
        let begun = run.target.steps();
        let (mut happened, mut hits) = (Vec::new(), Vec::new());
        for _ in 0..BATCH {
            let before = run.target.steps();
            let breakpoints = &mut self.breakpoints;
            let advance = run.target.advance(limit, &mut |what, state| {
                hits.push(breakpoints.hits(&what.event, before, &program, state));
                happened.push(what.clone());
            });
            let advance = match advance {
                Ok(advance) => advance,
                Err(why) => return self.failed(run, &why),
            };
            run.keep_trace(&happened);
            let held = self.look_at(run, &happened, hits.drain(..), before)
                || self.look_for_collision(run);
            run.keep_forces(&happened);
            if let Err(why) = run.lead_on(&happened) {
                return self.stopped_at(run, Reason::Goto, &why, Vec::new());
            }
            happened.clear();
            match advance {
                _ if held => return,
                Advance::Ended if run.target.is_recorded() && run.target.steps() > begun => {
                    // From the end of a log, a client can only go back.
                    return self.stopped_at(run, Reason::Pause, "the log ends", Vec::new());
                }
                Advance::Ended => return self.end(run, &By::Plan),
                Advance::Limit if limit == run.end => return self.time_up(run),
                Advance::Limit => break,
                Advance::On => {}
            }
        }
    }

    /// Reports the events of a step, and stops at a breakpoint.
    fn look_at(
        &mut self,
        run: &mut Run<'_>,
        happened: &[Happened],
        hits: impl Iterator<Item = Hits>,
        before: u64,
    ) -> bool {
        if happened.is_empty() && run.mode != Mode::One {
            return false;
        }
        let mut all = Hits::default();
        for (what, hits) in happened.iter().zip(hits) {
            self.say(run, what);
            hits.logs.iter().for_each(|text| self.log(what, text));
            if run.launch.no_debug {
                continue;
            }
            all.stop.extend(hits.stop);
            // Later faults in the step follow from the first one.
            if let Some(name) = hits.exception.filter(|_| all.exception.is_none()) {
                all.exception = Some(name);
                run.exception = Some((name, what.text.clone()));
            }
        }
        let steps = run.target.steps();
        if steps > before
            && happened.iter().any(|what| is_transition(what, run.target.program(), None))
        {
            run.note(steps);
        }
        self.pause_at(run, &all, happened, steps > before)
    }

    /// Stops on a new contact of the robot, if a client asked for that.
    fn look_for_collision(&mut self, run: &mut Run<'_>) -> bool {
        if !self.breakpoints.looks_for_collisions() || run.launch.no_debug {
            return false;
        }
        let now = run.target.contact();
        let before = std::mem::replace(&mut run.touched, now.clone());
        let Some(thing) = now.filter(|_| before.is_none()) else { return false };
        let why = match &*thing {
            "" => "the robot touches something".to_owned(),
            thing => format!("the robot touches '{thing}'"),
        };
        run.exception = Some(("collision", why.clone()));
        self.stopped_at(run, Reason::Exception, &why, Vec::new());
        true
    }

    fn pause_at(
        &mut self,
        run: &mut Run<'_>,
        hits: &Hits,
        happened: &[Happened],
        stepped: bool,
    ) -> bool {
        let ids = hits.stop.iter().map(|(id, _)| *id).collect();
        let why =
            happened.iter().rev().find(|what| is_transition(what, run.target.program(), None));
        let why = why.or(happened.last()).map_or("one step", |what| &*what.text);
        let wrong = run.exception.as_ref().filter(|_| hits.exception.is_some());
        let why = wrong.map_or(why, |(_, text)| text).to_owned();
        let reason = match (hits.exception, hits.stop.first()) {
            (Some(_), _) => Reason::Exception,
            (None, Some((_, kind))) => kind.reason(),
            (None, None) if run.is_through(happened, stepped) => match run.mode {
                Mode::Goto(_) => Reason::Goto,
                _ => Reason::Step,
            },
            _ => return false,
        };
        self.stopped_at(run, reason, &why, ids);
        true
    }
}

impl Run<'_> {
    /// Records that a step made a transition.
    pub(super) fn note(&mut self, step: u64) {
        if self.transitions.last().is_none_or(|last| *last < step) {
            self.transitions.push(step);
        }
    }

    /// Whether a client's step is complete.
    fn is_through(&self, happened: &[Happened], stepped: bool) -> bool {
        let any =
            |plan| happened.iter().any(|what| is_transition(what, self.target.program(), plan));
        let ended = |plan| {
            happened.iter().any(|what| {
                what.event.component.id == plan
                    && matches!(
                        what.event.kind,
                        EventKind::Ended { .. } | EventKind::Interrupted | EventKind::Finished(_)
                    )
            })
        };
        match self.mode {
            Mode::Next(plan) => any(Some(plan)) || ended(plan),
            Mode::Into => any(None),
            Mode::Out(plan) => ended(plan),
            Mode::One => stepped,
            Mode::Goto(to) => is_there(happened, to),
            Mode::On | Mode::Seek { .. } | Mode::Held | Mode::Over => false,
        }
    }
}

/// Whether an element started or ended, in the given plan or in any plan.
pub(super) fn is_transition(what: &Happened, program: &Program, plan: Option<ComponentId>) -> bool {
    use afp_dsl::unfold::ComponentKind;
    let event = &what.event;
    let Some(unit) = program.unit(event.component.id) else { return false };
    let element = matches!(
        unit.kind,
        ComponentKind::Actor | ComponentKind::SubPlan | ComponentKind::Computation
    );
    let kind = matches!(
        event.kind,
        EventKind::Started
            | EventKind::Finished(_)
            | EventKind::Interrupted
            | EventKind::Diverted { .. }
            | EventKind::Suspended { .. }
            | EventKind::Returned { .. }
            | EventKind::Abandoned { .. }
    );
    kind && element && plan.is_none_or(|plan| unit.plan == plan)
}
