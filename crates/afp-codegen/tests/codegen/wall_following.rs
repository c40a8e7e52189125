// units.rs

//! The units of quantities in strings.

use ::afp_core::rt::{Scale, Unit};

// **** Units ****

/// Units of `length`.
pub static LENGTH: [Unit<'static>; 5] = [
    Unit {
        name: "m",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "km",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "cm",
        scale: Scale::Decimal(-2),
    },
    Unit {
        name: "mm",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "um",
        scale: Scale::Decimal(-6),
    },
];

/// Units of `angle`.
pub static ANGLE: [Unit<'static>; 3] = [
    Unit {
        name: "rad",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "mrad",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "deg",
        scale: Scale::fraction(1, 1, 0, 1),
    },
];

// wall_following.rs

//! The plan `WallFollowing`: Find the next wall, then drive parallel to it until the escape button is pressed.

use ::afp_core::{
    Duration, Environment, Events, Fault, TypedEntry, Value, ValueRef, WriteError,
};
use ::afp_core::quantity::{Angle, AngularSpeed, Length, Speed};
use ::afp_core::rt::{
    Actor, AtElement, BadValue, Child, Committer, ComponentRow, Cx, ElementId,
    ElementKind, ElementRow, Entry, EntryRow, Fired, NameTable, NamedPlan, Plan,
    PlanState, PlanTable, Polled, PortRow, Range, Run, Slot, Started, Supervisor,
    SupervisorId, SupervisorRow, Tables, Target, Timing, Unit, finite, output, set_input,
    stage_outside,
};
use ::afp_core::trace::{ComponentKind, EntryKind, Sink};
use afp_carbot::templates as carbot;

// **** Actors ****

const SEARCH_FIRST_WALL: ElementId = ElementId(0);
const BACKUP_COLLISION: ElementId = ElementId(1);
const FIND_WALL_ANGLE: ElementId = ElementId(2);
const PARALLEL_TO_WALL: ElementId = ElementId(3);
const FOLLOW_WALL: ElementId = ElementId(4);
const TURN_AFTER_WALL_LOST: ElementId = ElementId(5);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // actor searchFirstWall: Forward
    SearchFirstWall(afp_carbot::Forward),
    // actor backupCollision: Forward
    BackupCollision(afp_carbot::Forward),
    // actor findWallAngle: SearchWall
    FindWallAngle(afp_carbot::SearchWall),
    // actor parallelToWall: Turn
    ParallelToWall(afp_carbot::Turn),
    // actor followWall: WallForward
    FollowWall(afp_carbot::WallForward),
    // actor turnAfterWallLost: Turn
    TurnAfterWallLost(afp_carbot::Turn),
}

/// Inputs of `searchFirstWall`.
fn search_first_wall_inputs() -> Result<carbot::forward::Inputs, BadValue> {
    Ok(carbot::forward::Inputs {
        distance: Length::from_si(100.0),
        speed: Speed::from_si(0.2),
    })
}

/// Inputs of `backupCollision`.
fn backup_collision_inputs(
    config: &Config,
) -> Result<carbot::forward::Inputs, BadValue> {
    Ok(carbot::forward::Inputs {
        distance: -config.walldist(),
        speed: Speed::from_si(0.2),
    })
}

/// Inputs of `findWallAngle`.
fn find_wall_angle_inputs() -> Result<carbot::search_wall::Inputs, BadValue> {
    Ok(carbot::search_wall::Inputs {
        sweep: Angle::from_deg(60.0),
        range: Length::from_si(1.5),
    })
}

/// Outputs of `findWallAngle`.
fn find_wall_angle_outputs(
    staged: &mut Staged,
    outcome: carbot::search_wall::State,
) -> Result<(), BadValue> {
    if let carbot::search_wall::State::WallFound { angle: value_0 } = outcome {
        staged.wallangle = Some(output(0, || finite(value_0))?);
    }
    Ok(())
}

/// Inputs of `parallelToWall`.
fn parallel_to_wall_inputs(config: &Config) -> Result<carbot::turn::Inputs, BadValue> {
    Ok(carbot::turn::Inputs {
        angle: config.wallangle(),
        speed: AngularSpeed::from_deg(45.0),
    })
}

/// Inputs of `followWall`.
fn follow_wall_inputs(
    config: &Config,
) -> Result<carbot::wall_forward::Inputs, BadValue> {
    Ok(carbot::wall_forward::Inputs {
        walldist: config.walldist(),
        lanedist: config.walldist(),
        gain: 1.0,
        tolerance: Length::from_si(0.2),
        absent: Length::from_si(0.15),
        step: Length::from_si(5.0),
        speed: Speed::from_si(0.2),
    })
}

/// Inputs of `turnAfterWallLost`.
fn turn_after_wall_lost_inputs() -> Result<carbot::turn::Inputs, BadValue> {
    Ok(carbot::turn::Inputs {
        angle: -Angle::from_deg(60.0),
        speed: AngularSpeed::from_deg(45.0),
    })
}

// **** Supervisors ****

const ESCAPE: SupervisorId = SupervisorId(0);
const SEARCH_FIRST_WALL_TOUCH: SupervisorId = SupervisorId(1);
const SEARCH_FIRST_WALL_CHECK_LANE: SupervisorId = SupervisorId(2);
const FOLLOW_WALL_WALL_TOUCH: SupervisorId = SupervisorId(3);

/// The supervisors, each while it watches.
#[derive(Clone, Default)]
struct Supervisors {
    // global supervisor escape: CheckEscapeButton
    escape: Option<afp_carbot::CheckEscapeButton>,
    // local supervisor searchFirstWall.touch: CheckTouchSensor
    search_first_wall_touch: Option<afp_carbot::CheckTouchSensor>,
    // local supervisor searchFirstWall.checkLane: CheckDrivingLane
    search_first_wall_check_lane: Option<afp_carbot::CheckDrivingLane>,
    // local supervisor followWall.wallTouch: CheckTouchSensor
    follow_wall_wall_touch: Option<afp_carbot::CheckTouchSensor>,
}

/// Inputs of `searchFirstWall.checkLane`.
fn search_first_wall_check_lane_inputs() -> Result<
    carbot::check_driving_lane::Inputs,
    BadValue,
> {
    Ok(carbot::check_driving_lane::Inputs {
        clearance: Length::from_si(0.1),
        margin: Length::from_si(0.1),
        halfwidth: Length::from_si(0.25),
    })
}

/// Live inputs of `searchFirstWall.checkLane`.
fn search_first_wall_check_lane_live(
    config: &Config,
) -> Result<carbot::check_driving_lane::Live, BadValue> {
    Ok(carbot::check_driving_lane::Live {
        distance: config.walldist(),
    })
}

// **** Plan ****

/// Find the next wall, then drive parallel to it until the escape button is pressed.
#[derive(Clone, Default)]
pub struct WallFollowing {
    pub(super) config: Config,
    staged: Staged,
    active: Active,
    supervisors: Supervisors,
}

/// The configuration.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// Distance to keep to the wall.
    ///
    /// `in walldist: length`
    pub walldist: Entry<Length>,
    /// `var wallangle: angle`
    pub wallangle: Entry<Angle>,
}

/// The values of the next commit.
#[derive(Clone, Default)]
struct Staged {
    walldist: Option<Length>,
    wallangle: Option<Angle>,
}

impl Config {
    /// The value of `walldist`.
    #[inline]
    pub fn walldist(&self) -> Length {
        *self.walldist.get()
    }

    /// The value of `wallangle`.
    #[inline]
    pub fn wallangle(&self) -> Angle {
        *self.wallangle.get()
    }
}

impl WallFollowing {
    /// The entry `walldist`, for `Scheduler::set`.
    pub const WALLDIST: TypedEntry<Self, Length> = TypedEntry::new(0);

    /// The entry `wallangle`, for `Scheduler::set`.
    pub const WALLANGLE: TypedEntry<Self, Angle> = TypedEntry::new(1);

    /// The plan, not yet started.
    pub fn new() -> Self {
        Self::default()
    }

    /// Distance to keep to the wall.
    ///
    /// `in walldist: length`
    ///
    /// `None` before the first write.
    pub fn walldist(&self) -> Option<Length> {
        self.config.walldist.value().copied()
    }

    /// Sets `walldist` before the start.
    ///
    /// # Errors
    /// [`WriteError::NotFinite`].
    pub fn set_walldist(&mut self, value: Length) -> Result<(), WriteError> {
        let value = finite(value).map_err(|_| WriteError::NotFinite)?;
        self.config.walldist.set(value);
        Ok(())
    }

    /// `var wallangle: angle`
    ///
    /// `None` before the first write.
    pub fn wallangle(&self) -> Option<Angle> {
        self.config.wallangle.value().copied()
    }
}

impl PlanState for WallFollowing {
    type Tables = Rules;
    type Slots = [Slot; 3];
    type Aside = ();

    #[inline]
    fn tables(&self) -> Rules {
        Rules
    }

    #[inline(always)]
    fn at_element<A: AtElement>(element: ElementId, run: A) -> A::Out {
        match element {
            SEARCH_FIRST_WALL => run.at::<{ SEARCH_FIRST_WALL.0 }>(),
            BACKUP_COLLISION => run.at::<{ BACKUP_COLLISION.0 }>(),
            FIND_WALL_ANGLE => run.at::<{ FIND_WALL_ANGLE.0 }>(),
            PARALLEL_TO_WALL => run.at::<{ PARALLEL_TO_WALL.0 }>(),
            FOLLOW_WALL => run.at::<{ FOLLOW_WALL.0 }>(),
            TURN_AFTER_WALL_LOST => run.at::<{ TURN_AFTER_WALL_LOST.0 }>(),
            _ => run.unknown(),
        }
    }

    fn try_clone(&self) -> Option<Self> {
        Some(Clone::clone(self))
    }

    fn slots(&self) -> [Slot; 3] {
        [Slot::default(); 3]
    }

    fn missing_input(&self) -> Option<u16> {
        None
    }

    fn initialise(&mut self) -> Result<(), BadValue> {
        let config = &mut self.config;
        config.wallangle.clear();
        if !config.walldist.is_set() {
            config.walldist.set(Length::from_si(0.3));
        }
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.walldist.as_value(),
            1 => self.config.wallangle.as_value(),
            _ => ValueRef::Unset,
        }
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match entry {
            0 => WriteError::check::<Length>(value),
            1 => WriteError::check::<Angle>(value),
            _ => Err(WriteError::Unknown),
        }
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        PlanState::accepts(self, entry, value)?;
        match entry {
            0 => set_input(&mut self.config.walldist, value),
            _ => Err(WriteError::NotStarted),
        }
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        match entry {
            0 => stage_outside(&mut self.staged.walldist, value),
            1 => stage_outside(&mut self.staged.wallangle, value),
            _ => {}
        }
    }

    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if let Some(value) = self.staged.walldist.take() {
            to.write(0, &mut self.config.walldist, value);
        }
        if let Some(value) = self.staged.wallangle.take() {
            to.write(1, &mut self.config.wallangle, value);
        }
    }

    #[inline]
    fn discard(&mut self) {
        self.staged = Staged::default();
    }
}

impl<E> Plan<E> for WallFollowing
where
    E: Environment + ?Sized,
    afp_carbot::Forward: Actor<carbot::Forward, E>,
    afp_carbot::SearchWall: Actor<carbot::SearchWall, E>,
    afp_carbot::Turn: Actor<carbot::Turn, E>,
    afp_carbot::WallForward: Actor<carbot::WallForward, E>,
    afp_carbot::CheckEscapeButton: Supervisor<carbot::CheckEscapeButton, E>,
    afp_carbot::CheckTouchSensor: Supervisor<carbot::CheckTouchSensor, E>,
    afp_carbot::CheckDrivingLane: Supervisor<carbot::CheckDrivingLane, E>,
{
    fn start_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        match supervisor {
            ESCAPE => {
                let inputs = Ok(carbot::check_escape_button::Inputs {});
                self.supervisors.escape = cx.start_supervisor(inputs)?;
            }
            SEARCH_FIRST_WALL_TOUCH => {
                let inputs = Ok(carbot::check_touch_sensor::Inputs {});
                self.supervisors.search_first_wall_touch = cx.start_supervisor(inputs)?;
            }
            SEARCH_FIRST_WALL_CHECK_LANE => {
                let inputs = search_first_wall_check_lane_inputs();
                self.supervisors.search_first_wall_check_lane = cx
                    .start_supervisor(inputs)?;
            }
            FOLLOW_WALL_WALL_TOUCH => {
                let inputs = Ok(carbot::check_touch_sensor::Inputs {});
                self.supervisors.follow_wall_wall_touch = cx.start_supervisor(inputs)?;
            }
            _ => return Err(Fault::INTERNAL),
        }
        Ok(())
    }

    #[inline]
    fn poll_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        wanted: Events,
        cx: &mut Cx<'_, R>,
    ) -> Fired {
        match supervisor {
            ESCAPE => {
                let live = Ok(carbot::check_escape_button::Live {});
                let watch = &mut self.supervisors.escape;
                Fired::supervisor(
                    cx.poll_supervisor(watch, live, wanted),
                    |_| Ok(()),
                    cx,
                )
            }
            SEARCH_FIRST_WALL_TOUCH => {
                let live = Ok(carbot::check_touch_sensor::Live {});
                let watch = &mut self.supervisors.search_first_wall_touch;
                Fired::supervisor(
                    cx.poll_supervisor(watch, live, wanted),
                    |_| Ok(()),
                    cx,
                )
            }
            SEARCH_FIRST_WALL_CHECK_LANE => {
                let live = search_first_wall_check_lane_live(&self.config);
                let watch = &mut self.supervisors.search_first_wall_check_lane;
                Fired::supervisor(
                    cx.poll_supervisor(watch, live, wanted),
                    |_| Ok(()),
                    cx,
                )
            }
            FOLLOW_WALL_WALL_TOUCH => {
                let live = Ok(carbot::check_touch_sensor::Live {});
                let watch = &mut self.supervisors.follow_wall_wall_touch;
                Fired::supervisor(
                    cx.poll_supervisor(watch, live, wanted),
                    |_| Ok(()),
                    cx,
                )
            }
            _ => Fired::fault(Fault::INTERNAL),
        }
    }

    fn start_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Started {
        let started: Result<Active, Fault> = match element {
            SEARCH_FIRST_WALL => {
                cx.start_actor(search_first_wall_inputs()).map(Active::SearchFirstWall)
            }
            BACKUP_COLLISION => {
                cx.start_actor(backup_collision_inputs(&self.config))
                    .map(Active::BackupCollision)
            }
            FIND_WALL_ANGLE => {
                cx.start_actor(find_wall_angle_inputs()).map(Active::FindWallAngle)
            }
            PARALLEL_TO_WALL => {
                cx.start_actor(parallel_to_wall_inputs(&self.config))
                    .map(Active::ParallelToWall)
            }
            FOLLOW_WALL => {
                cx.start_actor(follow_wall_inputs(&self.config)).map(Active::FollowWall)
            }
            TURN_AFTER_WALL_LOST => {
                cx.start_actor(turn_after_wall_lost_inputs())
                    .map(Active::TurnAfterWallLost)
            }
            _ => Err(Fault::INTERNAL),
        };
        match started {
            Ok(active) => {
                self.active = active;
                Started::Running
            }
            Err(fault) => Started::Failed(fault),
        }
    }

    #[inline]
    fn poll_element<R: Run<Env = E>>(
        &mut self,
        _: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Polled {
        match &mut self.active {
            Active::None => Polled::Failed(Fault::INTERNAL),
            Active::SearchFirstWall(actor) => {
                let live = Ok(carbot::forward::Live {});
                Polled::actor(cx.poll_actor(actor, live), |_| Ok(()), cx)
            }
            Active::BackupCollision(actor) => {
                let live = Ok(carbot::forward::Live {});
                Polled::actor(cx.poll_actor(actor, live), |_| Ok(()), cx)
            }
            Active::FindWallAngle(actor) => {
                let live = Ok(carbot::search_wall::Live {});
                Polled::actor(
                    cx.poll_actor(actor, live),
                    |outcome| find_wall_angle_outputs(&mut self.staged, outcome),
                    cx,
                )
            }
            Active::ParallelToWall(actor) => {
                let live = Ok(carbot::turn::Live {});
                Polled::actor(cx.poll_actor(actor, live), |_| Ok(()), cx)
            }
            Active::FollowWall(actor) => {
                let live = Ok(carbot::wall_forward::Live {});
                Polled::actor(cx.poll_actor(actor, live), |_| Ok(()), cx)
            }
            Active::TurnAfterWallLost(actor) => {
                let live = Ok(carbot::turn::Live {});
                Polled::actor(cx.poll_actor(actor, live), |_| Ok(()), cx)
            }
        }
    }

    fn interrupt_element<R: Run<Env = E>>(
        &mut self,
        _: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        match &mut self.active {
            Active::None => Err(Fault::INTERNAL),
            Active::SearchFirstWall(actor) => cx.interrupt_actor(actor),
            Active::BackupCollision(actor) => cx.interrupt_actor(actor),
            Active::FindWallAngle(actor) => cx.interrupt_actor(actor),
            Active::ParallelToWall(actor) => cx.interrupt_actor(actor),
            Active::FollowWall(actor) => cx.interrupt_actor(actor),
            Active::TurnAfterWallLost(actor) => cx.interrupt_actor(actor),
        }
    }

    fn leave(&mut self, element: ElementId) {
        self.active = Active::None;
        match element {
            SEARCH_FIRST_WALL => {
                self.supervisors.search_first_wall_touch = None;
                self.supervisors.search_first_wall_check_lane = None;
            }
            FOLLOW_WALL => {
                self.supervisors.follow_wall_wall_touch = None;
            }
            _ => {}
        }
    }

    fn end(&mut self) {
        self.active = Active::None;
        self.supervisors = Supervisors::default();
    }
}

// **** Rules ****

/// The rules of the plan, for the scheduler.
#[derive(Clone, Copy, Debug)]
pub struct Rules;

impl Tables for Rules {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        PlanTable {
            start: SEARCH_FIRST_WALL,
            globals: 1,
            entries: 2,
            elements: &ELEMENTS,
            supervisors: &SUPERVISORS,
            reasons: &[],
            edges: &EDGES,
            sweeps: &SWEEPS,
        }
    }
}

/// The target of each state and event.
static EDGES: [Option<Target>; 13] = [
    // searchFirstWall: ForwardSuccessful -> searchFirstWall
    Some(Target::Element(SEARCH_FIRST_WALL)),
    // backupCollision: ForwardSuccessful -> findWallAngle
    Some(Target::Element(FIND_WALL_ANGLE)),
    // findWallAngle: WallFound -> parallelToWall
    Some(Target::Element(PARALLEL_TO_WALL)),
    // findWallAngle: NoWallFound -> turnAfterWallLost
    Some(Target::Element(TURN_AFTER_WALL_LOST)),
    // parallelToWall: TurnSuccessful -> followWall
    Some(Target::Element(FOLLOW_WALL)),
    // followWall: ForwardSuccessful -> followWall
    Some(Target::Element(FOLLOW_WALL)),
    // followWall: LaneNotFree -> findWallAngle
    Some(Target::Element(FIND_WALL_ANGLE)),
    // followWall: WallLost -> turnAfterWallLost
    Some(Target::Element(TURN_AFTER_WALL_LOST)),
    // turnAfterWallLost: TurnSuccessful -> searchFirstWall
    Some(Target::Element(SEARCH_FIRST_WALL)),
    // escape: EscapeButtonPressed -> terminate
    Some(Target::Terminate),
    // searchFirstWall.touch: TouchSensorPressed -> backupCollision
    Some(Target::Element(BACKUP_COLLISION)),
    // searchFirstWall.checkLane: LaneNotFree -> findWallAngle
    Some(Target::Element(FIND_WALL_ANGLE)),
    // followWall.wallTouch: TouchSensorPressed -> backupCollision
    Some(Target::Element(BACKUP_COLLISION)),
];

/// The elements.
static ELEMENTS: [ElementRow; 6] = [
    // actor searchFirstWall: Forward
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 0, len: 1 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 1, len: 2 },
        sweep: Range { first: 0, len: 3 },
        child: Child { components: 0, entries: 0 },
    },
    // actor backupCollision: Forward
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 1, len: 1 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 3, len: 1 },
        child: Child { components: 0, entries: 0 },
    },
    // actor findWallAngle: SearchWall
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 2, len: 2 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 4, len: 1 },
        child: Child { components: 0, entries: 0 },
    },
    // actor parallelToWall: Turn
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 4, len: 1 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 5, len: 1 },
        child: Child { components: 0, entries: 0 },
    },
    // actor followWall: WallForward
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 5, len: 3 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 3, len: 1 },
        sweep: Range { first: 6, len: 2 },
        child: Child { components: 0, entries: 0 },
    },
    // actor turnAfterWallLost: Turn
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 8, len: 1 },
        on_error: None,
        resumes: false,
        returns: false,
        handler: false,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 8, len: 1 },
        child: Child { components: 0, entries: 0 },
    },
];

/// The supervisors: global, local, then global with an element's own edges.
static SUPERVISORS: [SupervisorRow; 4] = [
    // escape: CheckEscapeButton
    SupervisorRow {
        instance: ESCAPE,
        timing: Timing {
            period: Duration::from_millis(50),
            deadline: Duration::from_millis(10),
            budget: Duration::from_micros(10),
        },
        slot: 0,
        events: Range { first: 9, len: 1 },
        on_miss: None,
        wanted: Events::from_bits(0b1),
        wanted_in_look: Events::from_bits(0b1),
    },
    // searchFirstWall.touch: CheckTouchSensor
    SupervisorRow {
        instance: SEARCH_FIRST_WALL_TOUCH,
        timing: Timing {
            period: Duration::from_millis(1),
            deadline: Duration::from_millis(1),
            budget: Duration::from_micros(10),
        },
        slot: 1,
        events: Range { first: 10, len: 1 },
        on_miss: None,
        wanted: Events::from_bits(0b1),
        wanted_in_look: Events::from_bits(0b1),
    },
    // searchFirstWall.checkLane: CheckDrivingLane
    SupervisorRow {
        instance: SEARCH_FIRST_WALL_CHECK_LANE,
        timing: Timing {
            period: Duration::from_millis(20),
            deadline: Duration::from_millis(5),
            budget: Duration::from_micros(100),
        },
        slot: 2,
        events: Range { first: 11, len: 1 },
        on_miss: None,
        wanted: Events::from_bits(0b1),
        wanted_in_look: Events::from_bits(0b1),
    },
    // followWall.wallTouch: CheckTouchSensor
    SupervisorRow {
        instance: FOLLOW_WALL_WALL_TOUCH,
        timing: Timing {
            period: Duration::from_millis(5),
            deadline: Duration::from_millis(2),
            budget: Duration::from_micros(10),
        },
        slot: 1,
        events: Range { first: 12, len: 1 },
        on_miss: None,
        wanted: Events::from_bits(0b1),
        wanted_in_look: Events::from_bits(0b1),
    },
];

/// The supervisors of each active element, in polling order.
static SWEEPS: [u16; 9] = [
    // while searchFirstWall is active
    SEARCH_FIRST_WALL_TOUCH.0,
    SEARCH_FIRST_WALL_CHECK_LANE.0,
    ESCAPE.0,
    // while backupCollision is active
    ESCAPE.0,
    // while findWallAngle is active
    ESCAPE.0,
    // while parallelToWall is active
    ESCAPE.0,
    // while followWall is active
    FOLLOW_WALL_WALL_TOUCH.0,
    ESCAPE.0,
    // while turnAfterWallLost is active
    ESCAPE.0,
];

// **** Names ****

/// The names of the ids of a trace.
pub static NAMES: NameTable = NameTable {
    components: &[
        ComponentRow::new(
            "WallFollowing",
            ComponentKind::Plan,
            "WallFollowing",
            &[],
            "",
            &[],
        ),
        ComponentRow::new(
            "searchFirstWall",
            ComponentKind::Actor,
            "Forward",
            &[("ForwardSuccessful", "searchFirstWall")],
            "",
            &[
                PortRow::new("distance", "m")
                    .within(-1000.0, 1000.0)
                    .at("wall_following.afp", 15, 47),
                PortRow::new("speed", "m/s").within(0.01, 0.31),
            ],
        ),
        ComponentRow::new(
            "backupCollision",
            ComponentKind::Actor,
            "Forward",
            &[("ForwardSuccessful", "findWallAngle")],
            "",
            &[
                PortRow::new("distance", "m")
                    .within(-1000.0, 1000.0)
                    .at("wall_following.afp", 25, 47),
                PortRow::new("speed", "m/s").within(0.01, 0.31),
            ],
        ),
        ComponentRow::new(
                "findWallAngle",
                ComponentKind::Actor,
                "SearchWall",
                &[("WallFound", "parallelToWall"), ("NoWallFound", "turnAfterWallLost")],
                "",
                &[
                    PortRow::new("sweep", "rad")
                        .within(0.08726646259971647, 2.0943951023931953),
                    PortRow::new("range", "m").within(0.1, 4.0),
                ],
            )
            .writing(
                &[
                    PortRow::new("angle", "rad")
                        .at("wall_following.afp", 29, 46)
                        .into(0, "wallangle"),
                ],
            ),
        ComponentRow::new(
            "parallelToWall",
            ComponentKind::Actor,
            "Turn",
            &[("TurnSuccessful", "followWall")],
            "",
            &[
                PortRow::new("angle", "rad")
                    .within(-62.83185307179586, 62.83185307179586)
                    .at("wall_following.afp", 34, 40),
                PortRow::new("speed", "rad/s")
                    .within(0.017453292519943295, 1.5707963267948966),
            ],
        ),
        ComponentRow::new(
            "followWall",
            ComponentKind::Actor,
            "WallForward",
            &[
                ("ForwardSuccessful", "followWall"),
                ("LaneNotFree", "findWallAngle"),
                ("WallLost", "turnAfterWallLost"),
            ],
            "",
            &[
                PortRow::new("walldist", "m")
                    .within(0.05, 2.0)
                    .at("wall_following.afp", 38, 46),
                PortRow::new("lanedist", "m")
                    .within(0.05, 2.0)
                    .at("wall_following.afp", 38, 67),
                PortRow::new("gain", "")
                    .within(0.0, 10.0)
                    .at("wall_following.afp", 38, 84),
                PortRow::new("tolerance", "m")
                    .within(0.01, 2.0)
                    .at("wall_following.afp", 38, 99),
                PortRow::new("absent", "m").within(0.01, 2.0),
                PortRow::new("step", "m")
                    .within(0.01, 1000.0)
                    .at("wall_following.afp", 38, 113),
                PortRow::new("speed", "m/s").within(0.01, 0.31),
            ],
        ),
        ComponentRow::new(
            "turnAfterWallLost",
            ComponentKind::Actor,
            "Turn",
            &[("TurnSuccessful", "searchFirstWall")],
            "",
            &[
                PortRow::new("angle", "rad")
                    .within(-62.83185307179586, 62.83185307179586)
                    .at("wall_following.afp", 45, 43),
                PortRow::new("speed", "rad/s")
                    .within(0.017453292519943295, 1.5707963267948966),
            ],
        ),
        ComponentRow::new(
            "escape",
            ComponentKind::Supervisor,
            "CheckEscapeButton",
            &[("EscapeButtonPressed", "terminate")],
            "",
            &[],
        ),
        ComponentRow::new(
            "searchFirstWall.touch",
            ComponentKind::Supervisor,
            "CheckTouchSensor",
            &[("TouchSensorPressed", "backupCollision")],
            "",
            &[],
        ),
        ComponentRow::new(
            "searchFirstWall.checkLane",
            ComponentKind::Supervisor,
            "CheckDrivingLane",
            &[("LaneNotFree", "findWallAngle")],
            "",
            &[
                PortRow::new("distance", "m")
                    .within(0.0, 4.0)
                    .at("wall_following.afp", 19, 58),
                PortRow::new("clearance", "m")
                    .within(0.0, 1.0)
                    .at("wall_following.afp", 19, 80),
                PortRow::new("margin", "m")
                    .within(0.0, 1.0)
                    .at("wall_following.afp", 19, 96),
                PortRow::new("halfwidth", "m")
                    .within(0.01, 2.0)
                    .at("wall_following.afp", 19, 115),
            ],
        ),
        ComponentRow::new(
            "followWall.wallTouch",
            ComponentKind::Supervisor,
            "CheckTouchSensor",
            &[("TouchSensorPressed", "backupCollision")],
            "",
            &[],
        ),
    ],
    entries: &[
        EntryRow::new("walldist", EntryKind::In, "length", "m", &[])
            .at("wall_following.afp", 6, 29),
        EntryRow::new("wallangle", EntryKind::Var, "angle", "rad", &[]),
    ],
};

impl NamedPlan for WallFollowing {
    type Names = NameTable;

    fn names(&self) -> NameTable {
        NAMES
    }

    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>> {
        let units: &[Unit<'static>] = match entry {
            0 => &super::units::LENGTH,
            1 => &super::units::ANGLE,
            _ => &[],
        };
        units.iter().copied()
    }
}
