//! The plan, written by hand in the shape of generated code.

use std::hint::black_box;

use afp_core::quantity::Length;
use afp_core::rt::{
    Actor, AtElement, Child, Committer, Cx, ElementKind, ElementRow, Entry, Events, Fired, Plan,
    PlanState, PlanTable, Poll, Polled, Ports, Range, Slot, Started, Supervisor, SupervisorRow,
    Tables, Target,
};
use afp_core::trace::{NoTrace, Sink};
use afp_core::{
    Clock, Duration, Environment, Fault, Instant, Scheduler, StillClock, Value, ValueRef,
    WriteError,
};

use super::PERIOD;
use super::board::Board;
use super::components::*;

#[derive(Default)]
struct Config {
    walldist: Entry<Length>,
    driven: Entry<Length>,
}

#[derive(Default)]
struct Staged {
    walldist: Option<Length>,
    driven: Option<Length>,
}

enum Active {
    None,
    Drive(Drive),
    Back(Drive),
}

pub struct StepPlan {
    config: Config,
    staged: Staged,
    active: Active,
    button: Option<CheckButton>,
    battery: Option<CheckBattery>,
    touch: Option<CheckTouch>,
    range: Option<CheckRange>,
}

#[derive(Clone, Copy)]
pub struct StepTables;

const ROWS: PlanTable<'static> = PlanTable {
    start: 0,
    globals: 2,
    entries: 2,
    elements: &[
        ElementRow {
            kind: ElementKind::Actor,
            period: Duration::from_millis(10),
            states: Range { first: 0, len: 1 },
            on_error: Target::None,
            locals: Range { first: 2, len: 2 },
            sweep: Range { first: 0, len: 4 },
            child: Child { components: 0, entries: 0 },
        },
        ElementRow {
            kind: ElementKind::Actor,
            period: Duration::from_millis(10),
            states: Range { first: 1, len: 1 },
            on_error: Target::None,
            locals: Range { first: 0, len: 0 },
            sweep: Range { first: 4, len: 2 },
            child: Child { components: 0, entries: 0 },
        },
    ],
    supervisors: &[row(0, 2), row(1, 3), row(2, 4), row(3, 5)],
    edges: &[
        Target::Element(1),
        Target::Element(0),
        Target::Terminate,
        Target::Terminate,
        Target::Element(1),
        Target::Element(1),
    ],
    sweeps: &[0, 1, 2, 3, 0, 1],
};

const fn row(slot: u16, first: u16) -> SupervisorRow {
    SupervisorRow {
        period: Duration::from_millis(10),
        deadline: Duration::from_millis(10),
        budget: Duration::ZERO,
        slot,
        events: Range { first, len: 1 },
        on_miss: Target::None,
        wanted: Events::from_bits(1),
    }
}

impl Tables for StepTables {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        ROWS
    }
}

impl StepPlan {
    pub fn new() -> Self {
        StepPlan {
            config: Config::default(),
            staged: Staged::default(),
            active: Active::None,
            button: None,
            battery: None,
            touch: None,
            range: None,
        }
    }
}

impl PlanState for StepPlan {
    type Tables = StepTables;
    type Slots = [Slot; 4];

    #[inline(always)]
    fn at_element<A: AtElement>(element: u16, run: A) -> A::Out {
        match element {
            0 => run.at::<0>(),
            1 => run.at::<1>(),
            _ => run.unknown(),
        }
    }
    fn tables(&self) -> StepTables {
        StepTables
    }
    fn slots(&self) -> [Slot; 4] {
        Default::default()
    }
    fn missing_input(&self) -> Option<u16> {
        None
    }
    fn initialise(&mut self) -> Result<(), Fault> {
        self.config.driven.clear();
        self.config.walldist.set(Length::from_si(0.3));
        Ok(())
    }
    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.walldist.as_value(),
            1 => self.config.driven.as_value(),
            _ => ValueRef::Unset,
        }
    }
    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match (entry, value) {
            (0, Value::Float(v)) if v.is_finite() => Ok(()),
            _ => Err(WriteError::Type),
        }
    }
    fn stage(&mut self, entry: u16, value: &Value) {
        if let (0, Value::Float(v)) = (entry, value) {
            self.staged.walldist = Some(Length::from_si(*v));
        }
    }
    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if let Some(value) = self.staged.walldist.take() {
            to.write(0, &mut self.config.walldist, value);
        }
        if let Some(value) = self.staged.driven.take() {
            to.write(1, &mut self.config.driven, value);
        }
    }
    #[inline]
    fn discard(&mut self) {
        self.staged = Staged::default();
    }
}

impl<E: Environment + ?Sized> Plan<E> for StepPlan
where
    CheckButton: Supervisor<templates::CheckButton, E>,
    CheckTouch: Supervisor<templates::CheckTouch, E>,
    CheckRange: Supervisor<templates::CheckRange, E>,
    CheckBattery: Supervisor<templates::CheckBattery, E>,
    Drive: Actor<templates::Drive, E>,
{
    fn start_supervisor<S: Sink, C: Clock>(
        &mut self,
        supervisor: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), Fault> {
        let wanted = Events::from_bits(1);
        match supervisor {
            0 => {
                let inputs = cx.read(NoPorts {})?;
                self.button = Some(Supervisor::<templates::CheckButton, E>::start(
                    inputs, wanted, cx.env, cx.now,
                )?);
            }
            1 => {
                let inputs = cx.read(BatteryInputs { low: 10.0 })?;
                self.battery = Some(Supervisor::<templates::CheckBattery, E>::start(
                    inputs, wanted, cx.env, cx.now,
                )?);
            }
            2 => {
                let inputs = cx.read(NoPorts {})?;
                self.touch = Some(Supervisor::<templates::CheckTouch, E>::start(
                    inputs, wanted, cx.env, cx.now,
                )?);
            }
            3 => {
                let inputs = cx.read(NoPorts {})?;
                self.range = Some(Supervisor::<templates::CheckRange, E>::start(
                    inputs, wanted, cx.env, cx.now,
                )?);
            }
            _ => return Err(Fault::INTERNAL),
        }
        Ok(())
    }

    #[inline]
    fn poll_supervisor<S: Sink, C: Clock>(
        &mut self,
        supervisor: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Fired {
        match supervisor {
            0 => {
                let Some(button) = &mut self.button else { return Fired::fault(Fault::INTERNAL) };
                match Supervisor::<templates::CheckButton, E>::poll(
                    button,
                    NoPorts {},
                    cx.env,
                    cx.now,
                ) {
                    Ok(None) => Fired::NOTHING,
                    Ok(Some(Alarm::Raised)) => Fired::event(0, Ok(())),
                    Err(fault) => Fired::fault(fault),
                }
            }
            1 => {
                let Some(battery) = &mut self.battery else { return Fired::fault(Fault::INTERNAL) };
                match Supervisor::<templates::CheckBattery, E>::poll(
                    battery,
                    NoPorts {},
                    cx.env,
                    cx.now,
                ) {
                    Ok(None) => Fired::NOTHING,
                    Ok(Some(Alarm::Raised)) => Fired::event(0, Ok(())),
                    Err(fault) => Fired::fault(fault),
                }
            }
            2 => {
                let Some(touch) = &mut self.touch else { return Fired::fault(Fault::INTERNAL) };
                match Supervisor::<templates::CheckTouch, E>::poll(
                    touch,
                    NoPorts {},
                    cx.env,
                    cx.now,
                ) {
                    Ok(None) => Fired::NOTHING,
                    Ok(Some(Alarm::Raised)) => Fired::event(0, Ok(())),
                    Err(fault) => Fired::fault(fault),
                }
            }
            3 => {
                let Some(range) = &mut self.range else { return Fired::fault(Fault::INTERNAL) };
                let live = RangeLive { limit: *self.config.walldist.get() };
                if let Err(fault) = live.check() {
                    return Fired::fault(fault);
                }
                match Supervisor::<templates::CheckRange, E>::poll(range, live, cx.env, cx.now) {
                    Ok(None) => Fired::NOTHING,
                    Ok(Some(Alarm::Raised)) => Fired::event(0, Ok(())),
                    Err(fault) => Fired::fault(fault),
                }
            }
            _ => Fired::fault(Fault::INTERNAL),
        }
    }

    fn start_element<S: Sink, C: Clock>(
        &mut self,
        element: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Started {
        let distance = if element == 0 { 100.0 } else { -self.config.walldist.get().si() };
        let inputs = match cx.read(DriveInputs { distance, gain: 0.5 }) {
            Ok(inputs) => inputs,
            Err(fault) => return Started::Failed(fault),
        };
        match Actor::<templates::Drive, E>::start(inputs, cx.env, cx.now) {
            Ok(drive) if element == 0 => self.active = Active::Drive(drive),
            Ok(drive) => self.active = Active::Back(drive),
            Err(fault) => return Started::Failed(fault),
        }
        Started::Running
    }

    #[inline]
    fn poll_element<S: Sink, C: Clock>(
        &mut self,
        element: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Polled {
        match (element, &mut self.active) {
            (0, Active::Drive(drive)) => {
                match Actor::<templates::Drive, E>::poll(drive, NoPorts {}, cx.env, cx.now) {
                    Ok(Poll::Pending) => Polled::Pending,
                    Ok(Poll::Ready(DriveState::Arrived { driven })) => {
                        self.staged.driven = Some(driven);
                        Polled::Done(0)
                    }
                    Err(fault) => Polled::Failed(fault),
                }
            }
            (1, Active::Back(back)) => {
                match Actor::<templates::Drive, E>::poll(back, NoPorts {}, cx.env, cx.now) {
                    Ok(Poll::Pending) => Polled::Pending,
                    Ok(Poll::Ready(DriveState::Arrived { .. })) => Polled::Done(0),
                    Err(fault) => Polled::Failed(fault),
                }
            }
            _ => Polled::Failed(Fault::INTERNAL),
        }
    }

    fn interrupt_element<S: Sink, C: Clock>(
        &mut self,
        _: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), Fault> {
        match &mut self.active {
            Active::Drive(drive) | Active::Back(drive) => {
                Actor::<templates::Drive, E>::interrupt(drive, cx.env, cx.now)
            }
            Active::None => Ok(()),
        }
    }

    fn leave(&mut self, element: u16) {
        self.active = Active::None;
        if element == 0 {
            self.touch = None;
            self.range = None;
        }
    }

    fn end(&mut self) {
        self.button = None;
        self.battery = None;
        self.touch = None;
        self.range = None;
        self.active = Active::None;
    }
}

/// Repeats a step.
pub fn case() -> impl FnMut(u64) {
    let mut board = Board::quiet();
    let mut plan = Scheduler::new(StepPlan::new());
    let mut now = Instant::ZERO;
    plan.start(&mut board, &mut NoTrace, &StillClock, now).expect("no inputs to set");
    move |count| {
        let mut at = now.as_nanos();
        for _ in 0..count {
            at += PERIOD;
            let (plan, board) = (black_box(&mut plan), black_box(&mut board));
            let now = Instant::from_nanos(black_box(at));
            black_box(plan.step(board, &mut NoTrace, &StillClock, now));
        }
        now = Instant::from_nanos(at);
    }
}
