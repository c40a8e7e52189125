//! Polling supervisors: due polls, missed deadlines, the event that is taken.

use afp_types::{Duration, Instant};

use super::leave::after_fault;
use super::{Edge, Flow, Stepping, Stop};
use crate::clock::Clock;
use crate::fault::Fault;
use crate::rt::{Aside, ElementRow, Fired, Plan, Run, SupervisorRow, Tables, Target};
use crate::trace::{Author, Cause, Ending, Outcome, Record, Sink, Verdict};
use afp_types::{ElementId, SupervisorId};

/// Result of a sweep over the supervisors.
pub(super) enum Seen {
    /// Nothing found; no supervisor is due before this instant.
    Nothing(Instant),
    Something(Found),
}

/// A supervisor that stops the active element.
pub(super) struct Found {
    pub supervisor: SupervisorId,
    pub what: What,
}

pub(super) enum What {
    /// An event to take, its outputs staged, and its target.
    Event(Outcome, Target),
    /// An event that could have resumed, fully committed, and the edge that it leads to instead.
    Leads(Outcome, Result<Edge, Stop>),
    Fault(Fault),
}

/// Occasion of a poll.
#[derive(Clone, Copy)]
pub(super) struct Moment {
    /// The element that is active, held or being entered.
    pub element: ElementId,
    pub occasion: Occasion,
}

/// Why supervisors are polled.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Occasion {
    /// The element is active.
    Step,
    /// The element is being entered.
    Look,
    /// The element is held.
    Hold,
}

/// The release that a poll serves.
struct Release {
    at: Instant,
    /// The following release.
    next: Instant,
    /// Number of earlier releases without a poll.
    skipped: u64,
}

struct Poll {
    /// The earliest release that was not served.
    release: Instant,
    begin: Instant,
    end: Instant,
    fired: Fired,
}

impl<R: Run, P: Plan<R::Env>> Stepping<'_, '_, P, R> {
    /// Polls all due supervisors in order, up to the first that stops the active element.
    #[inline(always)]
    pub(super) fn sweep(&mut self, element: ElementId, row: &ElementRow) -> Seen {
        let moment = Moment { element, occasion: Occasion::Step };
        let mut seen = Seen::Nothing(Instant::MAX);
        let sweep = self.t.table().sweep(row);
        // Four at a time, so that the polls of a compiled plan are unrolled. The poll of a loaded
        // plan is the same code for all supervisors.
        let is_compiled = size_of::<P::Tables>() == 0;
        let (fours, rest) = if is_compiled { sweep.as_chunks::<4>() } else { (&[][..], sweep) };
        for &[a, b, c, d] in fours {
            if self.poll_in_sweep(a, moment, &mut seen)
                || self.poll_in_sweep(b, moment, &mut seen)
                || self.poll_in_sweep(c, moment, &mut seen)
                || self.poll_in_sweep(d, moment, &mut seen)
            {
                return seen;
            }
        }
        for &supervisor in rest {
            if self.poll_in_sweep(supervisor, moment, &mut seen) {
                return seen;
            }
        }
        seen
    }

    /// Polls one supervisor of a sweep; returns whether the sweep is over.
    #[inline(always)]
    fn poll_in_sweep(&mut self, row: u16, moment: Moment, seen: &mut Seen) -> bool {
        let Some(row) = self.t.table().supervisor(row) else { return false };
        match self.poll_if_due(row, moment) {
            Ok(next) => {
                if let Seen::Nothing(wake) = seen {
                    *wake = (*wake).min(next);
                }
                false
            }
            Err(what) => {
                *seen = Seen::Something(Found { supervisor: row.instance, what });
                true
            }
        }
    }

    /// Polls one supervisor if due, and returns its next due time.
    #[inline(always)]
    pub(super) fn poll_if_due(
        &mut self,
        row: &SupervisorRow,
        moment: Moment,
    ) -> Result<Instant, What> {
        let Some(slot) = self.level.slots.as_mut().get_mut(usize::from(row.slot)) else {
            return Err(What::Fault(Fault::INTERNAL));
        };
        let release = slot.next;
        if release > self.cx.now {
            return Ok(release);
        }
        let next = release + row.timing.period;
        slot.next = next;
        let begin = self.cx.step.clock;
        let supervisor = row.instance;
        let wanted = match moment.occasion {
            Occasion::Step => row.wanted,
            Occasion::Look => row.wanted_in_look,
            Occasion::Hold => self.wanted_in_hold(row),
        };
        let id = self.supervisor_id(supervisor);
        self.cx.calls(id);
        let fired = self.level.plan.poll_supervisor(supervisor, wanted, self.cx);
        let end = self.cx.clock.now(self.cx.now);
        self.cx.step.clock = end;
        if R::Sink::ENABLED {
            self.cx.trace(&Record::Polled { supervisor: id, verdict: fired.verdict() });
        }
        let on_time = next > self.cx.now && end <= release + row.timing.deadline;
        if on_time && fired.is_nothing() {
            return Ok(next);
        }
        self.seldom().judge(row, Poll { release, begin, end, fired }, moment)
    }

    /// Handles a poll that was late or has a result.
    #[cold]
    #[inline(never)]
    fn judge(&mut self, row: &SupervisorRow, poll: Poll, moment: Moment) -> Result<Instant, What> {
        let supervisor = row.instance;
        let release = serve(poll.release, row.timing.period, self.cx.now);
        if let Some(slot) = self.level.slots.as_mut().get_mut(usize::from(row.slot)) {
            slot.next = release.next;
        }
        let deadline = release.at + row.timing.deadline;
        let (event, end) = match poll.fired.outcome() {
            Some(Outcome::Declared(event)) => (Some(event), poll.end),
            Some(_) => (None, poll.end.max(deadline + Duration::from_nanos(1))),
            None => (None, poll.end),
        };
        let late = end > deadline || release.skipped > 0;
        if late {
            self.trace_miss(row, &release, poll.begin, end);
        }
        if let Some(event) = event {
            let target = self.t.table().edge(row.events, event);
            let event = Outcome::Declared(event);
            if let Some(target) = self.taken(supervisor, (event, target), moment) {
                if let Some(fault) = poll.fired.fault {
                    return Err(What::Fault(fault));
                }
                let taken = self.take(supervisor, (event, target), moment);
                return taken.map(|()| release.next);
            }
            self.level.plan.discard();
        } else if let Some(fault) = poll.fired.fault {
            return Err(What::Fault(fault));
        }
        let raised = late && moment.occasion != Occasion::Look;
        let missed = (Outcome::DeadlineMissed, row.on_miss.filter(|_| raised));
        if let Some(target) = self.taken(supervisor, missed, moment) {
            let event = (Outcome::DeadlineMissed, target);
            return self.take(supervisor, event, moment).map(|()| release.next);
        }
        Ok(release.next)
    }

    /// Takes an event; the sweep continues only if the event resumes.
    fn take(
        &mut self,
        supervisor: SupervisorId,
        (event, target): (Outcome, Target),
        moment: Moment,
    ) -> Result<(), What> {
        match self.is_held(target) {
            true => self.hold(supervisor, (event, target), moment),
            false => Err(What::Event(event, target)),
        }
    }

    /// A supervisor stopped a started element.
    pub(super) fn interrupted(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        found: Found,
    ) -> Flow {
        let edge = self.stopped(element, row, found, None);
        self.follow(edge)
    }

    /// The edge of a finding that interrupts a started element or sets it aside. `away` is the time
    /// since the element was suspended, if it still is.
    pub(super) fn stopped(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        found: Found,
        away: Option<Duration>,
    ) -> Result<Edge, Stop> {
        self.trace_found(element, &found)?;
        if self.suspends(row, &found) {
            return self.suspend_active(element, row, found, away);
        }
        self.interrupt_active().map_err(Stop::Run)?;
        self.after_supervisor(row, found)
    }

    /// Traces an event that is taken, or a fault.
    ///
    /// # Errors
    /// The fault of a computation that ends the run.
    pub(super) fn trace_found(&mut self, element: ElementId, found: &Found) -> Result<(), Stop> {
        let supervisor = self.supervisor_id(found.supervisor);
        match found.what {
            What::Event(event, _) => {
                let element = self.component(element);
                self.cx.trace(&Record::Event { supervisor, event, element });
            }
            What::Leads(_, Err(Stop::Run(fault))) => return Err(Stop::Run(fault)),
            What::Leads(..) => {}
            What::Fault(fault) => {
                self.level.plan.discard();
                self.cx.failed(supervisor, fault);
            }
        }
        Ok(())
    }

    /// The edge of a supervisor's finding, its outputs committed. The element has been left.
    pub(super) fn after_supervisor(
        &mut self,
        row: &ElementRow,
        found: Found,
    ) -> Result<Edge, Stop> {
        match found.what {
            What::Event(..) | What::Leads(..) => self.edge_of(found),
            What::Fault(fault) if self.t.table().is_global(found.supervisor) => {
                Err(Stop::Plan(Ending::Error(fault)))
            }
            What::Fault(fault) => after_fault(row, fault),
        }
    }

    /// The edge of an event, its outputs committed.
    pub(super) fn edge_of(&mut self, found: Found) -> Result<Edge, Stop> {
        match found.what {
            What::Event(_, target) => {
                let id = self.supervisor_id(found.supervisor);
                self.commit(Author::Component(id));
                Ok(Edge { target: Some(target), ending: Ending::Interrupted })
            }
            What::Leads(_, edge) => edge,
            What::Fault(_) => Err(Stop::Run(Fault::INTERNAL)),
        }
    }

    /// The target of an event, if it is taken now.
    fn taken(
        &mut self,
        supervisor: SupervisorId,
        (event, target): (Outcome, Option<Target>),
        moment: Moment,
    ) -> Option<Target> {
        let look = moment.occasion == Occasion::Look;
        match target? {
            Target::Ignore => None,
            target if moment.occasion == Occasion::Hold => ends(target).then_some(target),
            Target::Element(element) | Target::Suspend(element)
                if element == moment.element && (look || self.t.table().is_global(supervisor)) =>
            {
                if R::Sink::ENABLED {
                    let supervisor = self.supervisor_id(supervisor);
                    let element = self.component(element);
                    self.cx
                        .sink
                        .record(self.cx.now, &Record::AlreadyThere { supervisor, event, element });
                }
                None
            }
            // A handler takes time: its own events do not return from the look.
            target if look && self.returns(target) => {
                self.t.table().is_global(supervisor).then_some(target)
            }
            target => Some(target),
        }
    }

    /// Whether an edge returns, or leads to a computation that can.
    fn returns(&self, target: Target) -> bool {
        let row = |element| self.t.table().element(element);
        P::Aside::USED
            && match target {
                Target::Return => true,
                Target::Element(element) => row(element).is_some_and(|row| row.returns),
                _ => false,
            }
    }

    /// Whether an event with this target does not interrupt yet.
    fn is_held(&self, target: Target) -> bool {
        match target {
            Target::Resume => true,
            Target::Element(element) => {
                self.t.table().element(element).is_some_and(|row| row.resumes)
            }
            Target::Terminate
            | Target::Fail(_)
            | Target::Ignore
            | Target::Suspend(_)
            | Target::Return => false,
        }
    }

    /// Counts and traces a missed deadline with its cause: a poll that began too late for its
    /// budget is not the cause.
    #[cold]
    fn trace_miss(&mut self, row: &SupervisorRow, release: &Release, begin: Instant, end: Instant) {
        let deadline = release.at + row.timing.deadline;
        let missed = u64::from(end > deadline);
        self.cx.step.misses =
            self.cx.step.misses.saturating_add(missed).saturating_add(release.skipped);
        if R::Sink::ENABLED {
            let late = release.skipped > 0 || begin + row.timing.budget > deadline;
            let record = Record::Missed {
                supervisor: self.supervisor_id(row.instance),
                lateness: end - deadline,
                cause: if late { Cause::LateRelease } else { Cause::LongPoll },
                skipped: release.skipped,
            };
            self.cx.sink.record(self.cx.now, &record);
        }
    }
}

/// Whether an edge ends the plan.
pub(super) fn ends(target: Target) -> bool {
    matches!(target, Target::Terminate | Target::Fail(_))
}

impl Fired {
    #[inline]
    fn is_nothing(self) -> bool {
        self.event.is_none() && self.fault.is_none()
    }

    fn verdict(self) -> Verdict {
        match (self.outcome().filter(|event| *event != Outcome::DeadlineMissed), self.fault) {
            (Some(event), _) => Verdict::Event(event),
            (None, Some(fault)) => Verdict::Fault(fault),
            (None, None) => Verdict::Clear,
        }
    }
}

/// The latest release up to `now`; `first` is the earliest that is not served.
fn serve(first: Instant, period: Duration, now: Instant) -> Release {
    if first + period > now {
        return Release { at: first, next: first + period, skipped: 0 };
    }
    let span = period.max(Duration::from_nanos(1));
    let skipped = (now - first).periods(span);
    let at = first + span * skipped;
    Release { at, next: at + period, skipped }
}
