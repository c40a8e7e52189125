//! Seeking to a different time: back, and ahead without breakpoints.

use std::time::Duration as Wall;

use afp_core::{Duration, Instant};
use dapts::{SteppingGranularity, StoppedEventReason as Reason};
use serde::Deserialize;

use super::mode::{BATCH, Mode, Pace};
use super::steer::{Step, is_transition};
use super::{Adapter, Answer, Run};
use crate::breakpoints::Hits;
use crate::target::{Advance, Position};

#[derive(Deserialize)]
pub(super) struct Seek {
    at: f64,
}

impl Adapter<'_> {
    /// Goes back to before the last transition, or the last step.
    pub(super) fn back(&mut self, step: Step) -> Answer<()> {
        let run = self.run()?;
        let now = run.target.steps();
        let to = match step.granularity {
            Some(SteppingGranularity::Instruction) => now.saturating_sub(1),
            _ => run.transitions.iter().rfind(|step| **step < now).copied().unwrap_or(0),
        };
        self.go_back(Position::Step(to))?;
        let reason = if to == 0 { Reason::Entry } else { Reason::Step };
        self.stopped(reason, "stepped back", Vec::new());
        Ok(())
    }

    /// Goes back to the last breakpoint hit, or the start.
    pub(super) fn reverse(&mut self) -> Answer<()> {
        let (run, breakpoints) = (self.run.as_mut(), &mut self.breakpoints);
        let run = run.ok_or("nothing runs yet: send 'launch' first")?;
        let end = run.target.steps();
        let program = run.target.program().clone();
        run.target.seek(Position::Step(0))?;
        breakpoints.go_back(0);
        let mut last = None;
        while run.target.steps() + 1 < end {
            let before = run.target.steps();
            let mut hit = Hits::default();
            let advance = run.target.advance(Instant::MAX, &mut |happened, state| {
                let hits = breakpoints.hits(&happened.event, before, &program, state);
                hit.stop.extend(hits.stop);
                hit.exception = hit.exception.or(hits.exception);
            })?;
            if !hit.stop.is_empty() || hit.exception.is_some() {
                last = Some((run.target.steps(), hit.stop));
            }
            if advance == Advance::Ended {
                break;
            }
        }
        let (to, hits) = last.unwrap_or_default();
        self.go_back(Position::Step(to))?;
        let reason = if to == 0 { Reason::Entry } else { Reason::Breakpoint };
        let ids = hits.into_iter().map(|(id, _)| id).collect();
        self.stopped(reason, "went back", ids);
        Ok(())
    }

    /// Seeks to an instant. The past is restored from a keyframe, and the steps after it run again.
    /// The future runs as fast as possible until `pause`.
    pub(super) fn seek(&mut self, seek: Seek) -> Answer<()> {
        if !(seek.at >= 0.0 && seek.at < 1e9) {
            return Err("'at' is a time in seconds from the start".into());
        }
        let at = Instant::ZERO + Duration::from_secs_f64(seek.at);
        let run = self.run()?;
        let now = run.target.now();
        match run.mode {
            // The end is the last position.
            Mode::Over if at >= now => return Ok(()),
            _ if at > now => {
                run.forces.clear();
                run.mode = Mode::Seek { to: at, goes_on: false };
                return Ok(());
            }
            _ if at < now => self.go_back(Position::At(at))?,
            _ => run.forces.clear(),
        }
        self.stopped(Reason::Goto, "went to another time", Vec::new());
        Ok(())
    }

    /// Moves the run back and forgets everything later.
    fn go_back(&mut self, to: Position) -> Answer<()> {
        let run = self.run()?;
        run.forces.clear();
        run.target.seek(to)?;
        let steps = run.target.steps();
        run.transitions.retain(|step| *step <= steps);
        self.breakpoints.go_back(steps);
        Ok(())
    }

    /// Advances to the requested instant, or the end of the run. Then the run stops or goes on.
    pub(super) fn seek_on(&mut self, run: &mut Run<'_>, at: Instant, goes_on: bool, now: Wall) {
        let limit = at.min(run.end);
        let program = run.target.program().clone();
        for _ in 0..BATCH {
            let (mut happened, before) = (Vec::new(), run.target.steps());
            let breakpoints = &mut self.breakpoints;
            let advance = run.target.advance(limit, &mut |what, state| {
                // Hits during a seek count but do not stop the run.
                breakpoints.hits(&what.event, before, &program, state);
                happened.push(what.clone());
            });
            run.keep_trace(&happened);
            if happened.iter().any(|what| is_transition(what, &program, None)) {
                run.note(run.target.steps());
            }
            match advance {
                Ok(Advance::On) => {}
                Ok(Advance::Limit) if goes_on && limit < run.end => {
                    run.pace = Pace::new(run.pace.factor, run.target.now(), now);
                    run.mode = Mode::On;
                    self.send_state_of(run);
                    return;
                }
                Ok(Advance::Limit) => {
                    return self.stopped_at(run, Reason::Goto, "went to another time", Vec::new());
                }
                Ok(Advance::Ended) => {
                    return self.stopped_at(run, Reason::Goto, "went to the end", Vec::new());
                }
                Err(why) => return self.failed(run, &why),
            }
        }
    }
}
