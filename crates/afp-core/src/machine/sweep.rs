//! Polling supervisors: who is due, who is late, whose event is taken.

use super::{Edge, Level, Stop, supervisor_id};
use crate::clock::Clock;
use crate::component::Environment;
use crate::fault::Fault;
use crate::machine::Flow;
use crate::rt::{Cx, ElementRow, Fired, Plan, PlanState, PlanTable, Slot, SupervisorRow, Target};
use crate::time::{Duration, Instant};
use crate::trace::{Author, Cause, DEADLINE_MISSED, Ending, Record, Sink, Verdict};

/// What a sweep over the supervisors brought.
pub(super) enum Seen {
    /// Nothing; none of them is due before this instant.
    Nothing(Instant),
    /// One that stops the activity.
    Something(Found),
}

/// A supervisor that stops the activity.
pub(super) struct Found {
    /// Which one.
    pub supervisor: u16,
    /// What it found.
    pub what: What,
}

/// What a supervisor found.
pub(super) enum What {
    /// An event to take, outputs staged, and where it leads.
    Event(u16, Target),
    /// It failed.
    Fault(Fault),
}

/// When a supervisor is polled, and what for.
#[derive(Clone, Copy)]
pub(super) struct Moment {
    /// The element that is active or being entered.
    pub element: u16,
    /// Whether it is being entered.
    pub look: bool,
}

/// The release that a poll serves.
struct Release {
    at: Instant,
    skipped: u64,
}

impl<P: PlanState> Level<P> {
    /// Polls all due supervisors in their order, up to the first one that stops the activity.
    #[inline]
    pub(super) fn sweep<E, S, C>(
        &mut self,
        t: PlanTable<'_>,
        element: u16,
        row: &ElementRow,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Seen
    where
        E: ?Sized,
        S: Sink,
        C: Clock,
        P: Plan<E>,
    {
        let mut wake = Instant::MAX;
        let moment = Moment { element, look: false };
        for &supervisor in t.sweep(row) {
            let Some(row) = t.supervisor(supervisor) else { continue };
            match self.poll_if_due(t, supervisor, row, moment, cx) {
                Ok(next) => wake = wake.min(next),
                Err(what) => return Seen::Something(Found { supervisor, what }),
            }
        }
        Seen::Nothing(wake)
    }

    /// Polls one supervisor, if due, and says when it is due again.
    #[inline]
    pub(super) fn poll_if_due<E, S, C>(
        &mut self,
        t: PlanTable<'_>,
        supervisor: u16,
        row: &SupervisorRow,
        moment: Moment,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<Instant, What>
    where
        E: ?Sized,
        S: Sink,
        C: Clock,
        P: Plan<E>,
    {
        let Some(slot) = self.slots.as_mut().get_mut(usize::from(row.slot)) else {
            return Err(What::Fault(Fault::INTERNAL));
        };
        if slot.next > cx.now {
            return Ok(slot.next);
        }
        let release = serve(slot, row.period, cx.now);
        let next = slot.next;
        let begin = cx.step.clock;
        let fired = self.plan.poll_supervisor(supervisor, cx);
        let end = cx.clock.now(cx.now);
        cx.step.clock = end;
        if S::ENABLED {
            let verdict = fired.verdict();
            cx.trace(&Record::Polled { supervisor: supervisor_id(t, cx, supervisor), verdict });
        }
        let late = end > release.at + row.deadline || release.skipped > 0;
        if late {
            trace_miss(t, (supervisor, row), &release, begin, end, cx);
        }
        if !late && fired.event.is_none() && fired.fault.is_none() {
            return Ok(next);
        }
        self.judge(t, (supervisor, row), fired, late, moment, cx).map(|()| next)
    }

    /// Decides what a poll that brought anything means.
    fn judge<E, S, C>(
        &mut self,
        t: PlanTable<'_>,
        (supervisor, row): (u16, &SupervisorRow),
        fired: Fired,
        late: bool,
        moment: Moment,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), What>
    where
        E: ?Sized,
        S: Sink,
        P: Plan<E>,
    {
        if let Some(event) = fired.event {
            let target = t.edge(row.events, event);
            if takes(t, supervisor, event, target, moment, cx) {
                return Err(fired.fault.map_or(What::Event(event, target), What::Fault));
            }
            self.plan.discard();
        } else if let Some(fault) = fired.fault {
            return Err(What::Fault(fault));
        }
        let missed = late && !moment.look;
        if missed && takes(t, supervisor, DEADLINE_MISSED, row.on_miss, moment, cx) {
            return Err(What::Event(DEADLINE_MISSED, row.on_miss));
        }
        Ok(())
    }

    /// A supervisor stopped the activity of a started element.
    pub(super) fn interrupted<E, S, C>(
        &mut self,
        t: PlanTable<'_>,
        element: u16,
        row: &ElementRow,
        found: Found,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Flow
    where
        E: Environment + ?Sized,
        S: Sink,
        C: Clock,
        P: Plan<E>,
    {
        let id = supervisor_id(t, cx, found.supervisor);
        match found.what {
            What::Event(event, _) => cx.trace(&Record::Event { supervisor: id, event }),
            What::Fault(fault) => {
                self.plan.discard();
                cx.trace(&Record::Faulted { component: id, fault });
            }
        }
        if let Err(fault) = self.interrupt_active(t, cx) {
            return Flow::Fatal(fault);
        }
        match self.after_supervisor(t, element, row, found, cx) {
            Ok(edge) => self.follow(t, edge, cx),
            Err(stop) => self.stop(stop, cx),
        }
    }

    /// The edge that a supervisor's finding leads to, its outputs committed. The element is not
    /// active any more.
    pub(super) fn after_supervisor<E, S, C>(
        &mut self,
        t: PlanTable<'_>,
        element: u16,
        row: &ElementRow,
        found: Found,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<Edge, Stop>
    where
        E: ?Sized,
        S: Sink,
        P: Plan<E>,
    {
        match found.what {
            What::Event(_, target) => {
                self.commit(Author::Component(supervisor_id(t, cx, found.supervisor)), cx);
                self.plan.leave(element);
                Ok(Edge { target, ending: Ending::Interrupted })
            }
            What::Fault(fault) if found.supervisor < t.globals => {
                self.plan.leave(element);
                Err(Stop::Plan(Ending::Error(fault)))
            }
            What::Fault(fault) => self.error_edge(element, row, fault),
        }
    }
}

impl Fired {
    fn verdict(self) -> Verdict {
        match (self.event, self.fault) {
            (Some(event), _) => Verdict::Event(event),
            (None, Some(fault)) => Verdict::Fault(fault),
            (None, None) => Verdict::Clear,
        }
    }
}

/// The latest release up to `now`; the slot moves on to the one after.
#[inline]
fn serve(slot: &mut Slot, period: Duration, now: Instant) -> Release {
    let at = slot.next;
    slot.next = at + period;
    if slot.next > now { Release { at, skipped: 0 } } else { serve_late(slot, at, period, now) }
}

#[cold]
fn serve_late(slot: &mut Slot, first: Instant, period: Duration, now: Instant) -> Release {
    let period = period.as_nanos().max(1);
    let skipped = (now - first).as_nanos() / period;
    let at = Instant::from_nanos(first.as_nanos().saturating_add(skipped.saturating_mul(period)));
    slot.next = at + Duration::from_nanos(period);
    Release { at, skipped }
}

/// Whether an event is taken at this moment.
fn takes<E: ?Sized, S: Sink, C>(
    t: PlanTable<'_>,
    supervisor: u16,
    event: u16,
    target: Target,
    moment: Moment,
    cx: &mut Cx<'_, E, S, C>,
) -> bool {
    match target {
        Target::Ignore | Target::None => false,
        Target::Terminate => true,
        Target::Element(element) => {
            let global = supervisor < t.globals;
            let there = element == moment.element && (global || moment.look);
            if there && S::ENABLED {
                let supervisor = supervisor_id(t, cx, supervisor);
                cx.sink.record(cx.now, &Record::AlreadyThere { supervisor, event });
            }
            !there
        }
    }
}

/// Counts and traces a missed deadline, with its cause: a poll that began too late for its
/// declared budget is not itself to blame.
#[cold]
fn trace_miss<E: ?Sized, S: Sink, C>(
    t: PlanTable<'_>,
    (supervisor, row): (u16, &SupervisorRow),
    release: &Release,
    begin: Instant,
    end: Instant,
    cx: &mut Cx<'_, E, S, C>,
) {
    let deadline = release.at + row.deadline;
    let missed = u64::from(end > deadline);
    cx.step.misses = cx.step.misses.saturating_add(missed).saturating_add(release.skipped);
    if S::ENABLED {
        let late = release.skipped > 0 || begin + row.budget > deadline;
        let record = Record::Missed {
            supervisor: supervisor_id(t, cx, supervisor),
            lateness: end - deadline,
            cause: if late { Cause::LateRelease } else { Cause::LongPoll },
            skipped: release.skipped,
        };
        cx.sink.record(cx.now, &record);
    }
}
