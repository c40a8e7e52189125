//! Polling supervisors: who is due, who is late, whose event is taken.

use afp_types::{Duration, Instant};

use super::{Edge, Flow, Level, Stop, component, supervisor_id};
use crate::clock::Clock;
use crate::fault::Fault;
use crate::rt::{Cx, ElementRow, Fired, Plan, PlanState, Run, SupervisorRow, Tables, Target};
use crate::trace::{Author, Cause, Ending, Outcome, Record, Sink, Verdict};
use afp_types::{ElementId, SupervisorId};

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
    pub supervisor: SupervisorId,
    /// What it found.
    pub what: What,
}

pub(super) enum What {
    /// An event to take, outputs staged, and where it leads.
    Event(Outcome, Target),
    /// An event that could have resumed, all of it committed, and the edge that it leads to instead.
    Leads(Outcome, Result<Edge, Stop>),
    /// It failed.
    Fault(Fault),
}

/// When a supervisor is polled, and what for.
#[derive(Clone, Copy)]
pub(super) struct Moment {
    /// The element that is active or being entered.
    pub element: ElementId,
    /// Whether it is being entered.
    pub look: bool,
}

/// The release that a poll serves.
struct Release {
    at: Instant,
    /// The one after it.
    next: Instant,
    /// Earlier ones that passed entirely.
    skipped: u64,
}

/// A poll of a supervisor.
struct Poll {
    /// The earliest release that was not served.
    release: Instant,
    begin: Instant,
    end: Instant,
    fired: Fired,
}

impl<P: PlanState> Level<P> {
    /// Polls all due supervisors in their order, up to the first one that stops the activity.
    #[inline(always)]
    pub(super) fn sweep<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        cx: &mut Cx<'_, R>,
    ) -> Seen
    where
        P: Plan<R::Env>,
    {
        let moment = Moment { element, look: false };
        let mut seen = Seen::Nothing(Instant::MAX);
        // Four at a time: the polls of a compiled plan then stand in a row.
        let (fours, rest) = t.table().sweep(row).as_chunks::<4>();
        for &[a, b, c, d] in fours {
            if self.poll_in_sweep(t, a, moment, &mut seen, cx)
                || self.poll_in_sweep(t, b, moment, &mut seen, cx)
                || self.poll_in_sweep(t, c, moment, &mut seen, cx)
                || self.poll_in_sweep(t, d, moment, &mut seen, cx)
            {
                return seen;
            }
        }
        for &supervisor in rest {
            if self.poll_in_sweep(t, supervisor, moment, &mut seen, cx) {
                return seen;
            }
        }
        seen
    }

    /// Polls one supervisor of a sweep; whether the sweep is over.
    #[inline(always)]
    fn poll_in_sweep<R: Run>(
        &mut self,
        t: &P::Tables,
        row: u16,
        moment: Moment,
        seen: &mut Seen,
        cx: &mut Cx<'_, R>,
    ) -> bool
    where
        P: Plan<R::Env>,
    {
        let Some(row) = t.table().supervisor(row) else { return false };
        match self.poll_if_due(t, row, moment, cx) {
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

    /// Polls one supervisor, if due, and says when it is due again.
    #[inline(always)]
    pub(super) fn poll_if_due<R: Run>(
        &mut self,
        t: &P::Tables,
        row: &SupervisorRow,
        moment: Moment,
        cx: &mut Cx<'_, R>,
    ) -> Result<Instant, What>
    where
        P: Plan<R::Env>,
    {
        let Some(slot) = self.slots.as_mut().get_mut(usize::from(row.slot)) else {
            return Err(What::Fault(Fault::INTERNAL));
        };
        let release = slot.next;
        if release > cx.now {
            return Ok(release);
        }
        let next = release + row.timing.period;
        slot.next = next;
        let begin = cx.step.clock;
        let supervisor = row.instance;
        let wanted = if moment.look { row.wanted_in_look } else { row.wanted };
        let id = supervisor_id(t, cx, supervisor);
        let fired = cx.call(id, |cx| self.plan.poll_supervisor(supervisor, wanted, cx));
        let end = cx.clock.now(cx.now);
        cx.step.clock = end;
        if R::Sink::ENABLED {
            cx.trace(&Record::Polled { supervisor: id, verdict: fired.verdict() });
        }
        let on_time = next > cx.now && end <= release + row.timing.deadline;
        if on_time && fired.is_nothing() {
            return Ok(next);
        }
        self.judge(t, row, Poll { release, begin, end, fired }, moment, cx)
    }

    /// Decides what a poll means that was late or brought something.
    #[cold]
    #[inline(never)]
    fn judge<R: Run>(
        &mut self,
        t: &P::Tables,
        row: &SupervisorRow,
        poll: Poll,
        moment: Moment,
        cx: &mut Cx<'_, R>,
    ) -> Result<Instant, What>
    where
        P: Plan<R::Env>,
    {
        let supervisor = row.instance;
        let release = serve(poll.release, row.timing.period, cx.now);
        if let Some(slot) = self.slots.as_mut().get_mut(usize::from(row.slot)) {
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
            trace_miss(t, row, &release, poll.begin, end, cx);
        }
        if let Some(event) = event {
            let target = t.table().edge(row.events, event);
            let event = Outcome::Declared(event);
            if let Some(target) = taken(t, supervisor, (event, target), moment, cx) {
                if let Some(fault) = poll.fired.fault {
                    return Err(What::Fault(fault));
                }
                let taken = self.take(t, supervisor, (event, target), moment, cx);
                return taken.map(|()| release.next);
            }
            self.plan.discard();
        } else if let Some(fault) = poll.fired.fault {
            return Err(What::Fault(fault));
        }
        let missed = (Outcome::DeadlineMissed, row.on_miss.filter(|_| late && !moment.look));
        if let Some(target) = taken(t, supervisor, missed, moment, cx) {
            let event = (Outcome::DeadlineMissed, target);
            return self.take(t, supervisor, event, moment, cx).map(|()| release.next);
        }
        Ok(release.next)
    }

    /// Takes an event: the sweep goes on only where that resumes.
    fn take<R: Run>(
        &mut self,
        t: &P::Tables,
        supervisor: SupervisorId,
        (event, target): (Outcome, Target),
        moment: Moment,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), What>
    where
        P: Plan<R::Env>,
    {
        match is_held(t, target) {
            true => self.hold(t, supervisor, (event, target), moment, cx),
            false => Err(What::Event(event, target)),
        }
    }

    /// A supervisor stopped the activity of a started element.
    pub(super) fn interrupted<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        found: Found,
        cx: &mut Cx<'_, R>,
    ) -> Flow
    where
        P: Plan<R::Env>,
    {
        let id = supervisor_id(t, cx, found.supervisor);
        match found.what {
            What::Event(event, _) => {
                let element = component(cx, element);
                cx.trace(&Record::Event { supervisor: id, event, element });
            }
            What::Leads(_, Err(Stop::Run(fault))) => return Flow::Fatal(fault),
            What::Leads(..) => {}
            What::Fault(fault) => {
                self.plan.discard();
                cx.failed(id, fault);
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
    pub(super) fn after_supervisor<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        found: Found,
        cx: &mut Cx<'_, R>,
    ) -> Result<Edge, Stop>
    where
        P: Plan<R::Env>,
    {
        match found.what {
            What::Event(_, target) => {
                self.commit(Author::Component(supervisor_id(t, cx, found.supervisor)), cx);
                self.plan.leave(element);
                Ok(Edge { target: Some(target), ending: Ending::Interrupted })
            }
            What::Leads(_, edge) => {
                self.plan.leave(element);
                edge
            }
            What::Fault(fault) if t.table().is_global(found.supervisor) => {
                self.plan.leave(element);
                Err(Stop::Plan(Ending::Error(fault)))
            }
            What::Fault(fault) => self.error_edge(element, row, fault),
        }
    }
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

/// The latest release up to `now`, where `first` is the earliest that is not served.
fn serve(first: Instant, period: Duration, now: Instant) -> Release {
    if first + period > now {
        return Release { at: first, next: first + period, skipped: 0 };
    }
    let span = period.max(Duration::from_nanos(1));
    let skipped = (now - first).periods(span);
    let at = first + span * skipped;
    Release { at, next: at + period, skipped }
}

/// Where an event leads, if it is taken at this moment.
fn taken<R: Run>(
    t: &impl Tables,
    supervisor: SupervisorId,
    (event, target): (Outcome, Option<Target>),
    moment: Moment,
    cx: &mut Cx<'_, R>,
) -> Option<Target> {
    match target? {
        Target::Ignore => None,
        Target::Element(element)
            if element == moment.element && (moment.look || t.table().is_global(supervisor)) =>
        {
            if R::Sink::ENABLED {
                let supervisor = supervisor_id(t, cx, supervisor);
                let element = component(cx, element);
                cx.sink.record(cx.now, &Record::AlreadyThere { supervisor, event, element });
            }
            None
        }
        target => Some(target),
    }
}

/// Whether an event with this target interrupts nothing yet.
fn is_held(t: &impl Tables, target: Target) -> bool {
    match target {
        Target::Resume => true,
        Target::Element(element) => t.table().element(element).is_some_and(|row| row.resumes),
        Target::Terminate | Target::Fail(_) | Target::Ignore => false,
    }
}

/// Counts and traces a missed deadline, with its cause: a poll that began too late for its
/// declared budget is not itself to blame.
#[cold]
fn trace_miss<R: Run>(
    t: &impl Tables,
    row: &SupervisorRow,
    release: &Release,
    begin: Instant,
    end: Instant,
    cx: &mut Cx<'_, R>,
) {
    let deadline = release.at + row.timing.deadline;
    let missed = u64::from(end > deadline);
    cx.step.misses = cx.step.misses.saturating_add(missed).saturating_add(release.skipped);
    if R::Sink::ENABLED {
        let late = release.skipped > 0 || begin + row.timing.budget > deadline;
        let record = Record::Missed {
            supervisor: supervisor_id(t, cx, row.instance),
            lateness: end - deadline,
            cause: if late { Cause::LateRelease } else { Cause::LongPoll },
            skipped: release.skipped,
        };
        cx.sink.record(cx.now, &record);
    }
}
