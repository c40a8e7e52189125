// inner.rs

const WAIT: ElementId = ElementId(0);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // actor wait: Wait
    Wait(afp_std::Wait),
}

/// Inputs of `wait`.
fn wait_inputs(config: &Config) -> Result<std_templates::wait::Inputs, BadValue> {
    Ok(std_templates::wait::Inputs {
        duration: Time::from_si(1.0) * (config.angle() / Angle::from_si(1.0)),
    })
}

/// The plan `Inner`.
#[derive(Clone, Default)]
pub struct Inner {
    pub(super) config: Config,
    staged: Staged,
    active: Active,
    supervisors: Supervisors,
}

/// The configuration.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// `in angle: angle`
    pub angle: Entry<Angle>,
    /// `out gap: float`
    pub gap: Entry<f64>,
}

/// The values of the next commit.
#[derive(Clone, Default)]
struct Staged {
    angle: Option<Angle>,
}

impl Config {
    /// The value of `angle`.
    #[inline]
    pub fn angle(&self) -> Angle {
        *self.angle.get()
    }
}

impl Inner {
    /// The entry `angle`, for `Scheduler::set`.
    pub const ANGLE: TypedEntry<Self, Angle> = TypedEntry::new(0);

    /// The plan, not yet started.
    pub fn new() -> Self {
        Self::default()
    }

    /// `in angle: angle`
    ///
    /// `None` before the first write.
    pub fn angle(&self) -> Option<Angle> {
        self.config.angle.value().copied()
    }

    /// Sets `angle` before the start.
    ///
    /// # Errors
    /// [`WriteError::NotFinite`] or [`WriteError::Range`].
    pub fn set_angle(&mut self, value: Angle) -> Result<(), WriteError> {
        let value = limited(value, -1.5707963267948966, 1.5707963267948966)
            .map_err(WriteError::of)?;
        self.config.angle.set(value);
        Ok(())
    }

    /// `out gap: float`
    ///
    /// `None` before the first write.
    pub fn gap(&self) -> Option<f64> {
        self.config.gap.value().copied()
    }
}

impl PlanState for Inner {
    type Tables = Rules;
    type Slots = [Slot; 0];
    type Aside = ();

    #[inline]
    fn tables(&self) -> Rules {
        Rules
    }

    #[inline(always)]
    fn at_element<A: AtElement>(element: ElementId, run: A) -> A::Out {
        match element {
            WAIT => run.at::<{ WAIT.0 }>(),
            _ => run.unknown(),
        }
    }

    fn try_clone(&self) -> Option<Self> {
        Some(Clone::clone(self))
    }

    fn slots(&self) -> [Slot; 0] {
        [Slot::default(); 0]
    }

    fn missing_input(&self) -> Option<u16> {
        if !self.config.angle.is_set() {
            return Some(0);
        }
        None
    }

    fn initialise(&mut self) -> Result<(), BadValue> {
        let config = &mut self.config;
        config.gap.clear();
        config.gap.set(0.5);
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.angle.as_value(),
            1 => self.config.gap.as_value(),
            _ => ValueRef::Unset,
        }
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match entry {
            0 => {
                WriteError::check_within::<
                    Angle,
                >(value, -1.5707963267948966, 1.5707963267948966)
            }
            1 => Err(WriteError::ReadOnly),
            _ => Err(WriteError::Unknown),
        }
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        PlanState::accepts(self, entry, value)?;
        match entry {
            0 => set_input(&mut self.config.angle, value),
            _ => Err(WriteError::NotStarted),
        }
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        match entry {
            0 => stage_outside(&mut self.staged.angle, value),
            _ => {}
        }
    }

    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if let Some(value) = self.staged.angle.take() {
            to.write(0, &mut self.config.angle, value);
        }
    }

    #[inline]
    fn discard(&mut self) {
        self.staged = Staged::default();
    }
}

impl<E> Plan<E> for Inner
where
    E: Environment + ?Sized,
    afp_std::Wait: Actor<std_templates::Wait, E>,
{
    fn start_supervisor<R: Run<Env = E>>(
        &mut self,
        _: SupervisorId,
        _: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        Err(Fault::INTERNAL)
    }

    #[inline]
    fn poll_supervisor<R: Run<Env = E>>(
        &mut self,
        _: SupervisorId,
        _: Events,
        _: &mut Cx<'_, R>,
    ) -> Fired {
        Fired::fault(Fault::INTERNAL)
    }

    fn start_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Started {
        let started: Result<Active, Fault> = match element {
            WAIT => cx.start_actor(wait_inputs(&self.config)).map(Active::Wait),
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
            Active::Wait(actor) => {
                let live = Ok(std_templates::wait::Live {});
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
            Active::Wait(actor) => cx.interrupt_actor(actor),
        }
    }

    fn leave(&mut self, _: ElementId) {
        self.active = Active::None;
    }

    fn end(&mut self) {
        self.active = Active::None;
        self.supervisors = Supervisors::default();
    }
}

/// The names of the ids of a trace.
pub static NAMES: NameTable = NameTable {
    components: &[
        ComponentRow::new("Inner", ComponentKind::Plan, "Inner", &[], "", &[]),
        ComponentRow::new(
            "wait",
            ComponentKind::Actor,
            "Wait",
            &[("Elapsed", "terminate")],
            "",
            &[PortRow::new("duration", "s").within(0.0, 3600.0).at("ranges.afp", 19, 33)],
        ),
    ],
    entries: &[
        EntryRow::new("angle", EntryKind::In, "angle", "rad", &[])
            .within(-1.5707963267948966, 1.5707963267948966),
        EntryRow::new("gap", EntryKind::Out, "float", "", &[])
            .within(0.0, 1.0)
            .at("ranges.afp", 18, 22),
    ],
};

impl NamedPlan for Inner {
    type Names = NameTable;

    fn names(&self) -> NameTable {
        NAMES
    }

    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>> {
        let units: &[Unit<'static>] = match entry {
            0 => &super::units::ANGLE,
            _ => &[],
        };
        units.iter().copied()
    }
}

// p.rs

const COUNT: ElementId = ElementId(0);
const INNER: ElementId = ElementId(1);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // subplan inner: Inner
    Inner(Machine<super::inner::Inner>),
}

/// Inputs of `count`.
fn count_inputs(config: &Config) -> Result<std_templates::count::Inputs, BadValue> {
    Ok(std_templates::count::Inputs {
        value: config.turns(),
        limit: config.often(),
    })
}

/// Outputs of `count`.
fn count_outputs(
    staged: &mut Staged,
    outcome: std_templates::count::State,
) -> Result<(), BadValue> {
    match outcome {
        std_templates::count::State::Again { next: value_0 } => {
            staged.turns = Some(output(0, || limited(value_0, 0.0, 10.0))?);
        }
        std_templates::count::State::Done { next: value_0 } => {
            staged.turns = Some(output(0, || limited(value_0, 0.0, 10.0))?);
        }
    }
    Ok(())
}

/// The first ids of `inner` begin.
const INNER_PLACE: Child = Child { components: 2, entries: 4 };

/// Inputs of `inner`.
fn inner_inputs(config: &Config, to: &mut super::inner::Config) -> Result<(), BadValue> {
    to.angle
        .set(
            input(
                0,
                || limited(
                    Angle::from_si(
                        (config.pace() / Speed::from_si(1.0)) * Angle::from_si(1.0).si(),
                    ),
                    -1.5707963267948966,
                    1.5707963267948966,
                ),
            )?,
        );
    Ok(())
}

/// Results of `inner`.
fn inner_outputs(
    staged: &mut Staged,
    from: &super::inner::Config,
) -> Result<(), BadValue> {
    if let Some(value) = from.gap.value() {
        staged.share = Some(output(0, || limited(finite(*value)?, 0.5, 1.0))?);
    }
    Ok(())
}

/// Ranges of entries: outputs, writers from outside, initial values, inputs of sub-plans.
#[derive(Clone, Default)]
pub struct P {
    pub(super) config: Config,
    staged: Staged,
    active: Active,
    supervisors: Supervisors,
}

/// The configuration.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// How fast.
    ///
    /// `in pace: speed`
    pub pace: Entry<Speed>,
    /// `in often: int`
    pub often: Entry<i64>,
    /// `var turns: int`
    pub turns: Entry<i64>,
    /// `var share: float`
    pub share: Entry<f64>,
}

/// The values of the next commit.
#[derive(Clone, Default)]
struct Staged {
    pace: Option<Speed>,
    often: Option<i64>,
    turns: Option<i64>,
    share: Option<f64>,
}

impl Config {
    /// The value of `pace`.
    #[inline]
    pub fn pace(&self) -> Speed {
        *self.pace.get()
    }

    /// The value of `often`.
    #[inline]
    pub fn often(&self) -> i64 {
        *self.often.get()
    }

    /// The value of `turns`.
    #[inline]
    pub fn turns(&self) -> i64 {
        *self.turns.get()
    }
}

impl P {
    /// The entry `pace`, for `Scheduler::set`.
    pub const PACE: TypedEntry<Self, Speed> = TypedEntry::new(0);

    /// The entry `often`, for `Scheduler::set`.
    pub const OFTEN: TypedEntry<Self, i64> = TypedEntry::new(1);

    /// The entry `turns`, for `Scheduler::set`.
    pub const TURNS: TypedEntry<Self, i64> = TypedEntry::new(2);

    /// The entry `share`, for `Scheduler::set`.
    pub const SHARE: TypedEntry<Self, f64> = TypedEntry::new(3);

    /// The plan, not yet started.
    pub fn new() -> Self {
        Self::default()
    }

    /// How fast.
    ///
    /// `in pace: speed`
    ///
    /// `None` before the first write.
    pub fn pace(&self) -> Option<Speed> {
        self.config.pace.value().copied()
    }

    /// Sets `pace` before the start.
    ///
    /// # Errors
    /// [`WriteError::NotFinite`] or [`WriteError::Range`].
    pub fn set_pace(&mut self, value: Speed) -> Result<(), WriteError> {
        let value = limited(value, 0.0, 2.0).map_err(WriteError::of)?;
        self.config.pace.set(value);
        Ok(())
    }

    /// `in often: int`
    ///
    /// `None` before the first write.
    pub fn often(&self) -> Option<i64> {
        self.config.often.value().copied()
    }

    /// Sets `often` before the start.
    ///
    /// # Errors
    /// [`WriteError::NotFinite`] or [`WriteError::Range`].
    pub fn set_often(&mut self, value: i64) -> Result<(), WriteError> {
        let value = limited(value, 1.0, 3.0).map_err(WriteError::of)?;
        self.config.often.set(value);
        Ok(())
    }

    /// `var turns: int`
    ///
    /// `None` before the first write.
    pub fn turns(&self) -> Option<i64> {
        self.config.turns.value().copied()
    }

    /// `var share: float`
    ///
    /// `None` before the first write.
    pub fn share(&self) -> Option<f64> {
        self.config.share.value().copied()
    }
}

impl PlanState for P {
    type Tables = Rules;
    type Slots = [Slot; 0];
    type Aside = ();

    #[inline]
    fn tables(&self) -> Rules {
        Rules
    }

    #[inline(always)]
    fn at_element<A: AtElement>(element: ElementId, run: A) -> A::Out {
        match element {
            INNER => run.at::<{ INNER.0 }>(),
            _ => run.unknown(),
        }
    }

    fn try_clone(&self) -> Option<Self> {
        Some(Clone::clone(self))
    }

    fn slots(&self) -> [Slot; 0] {
        [Slot::default(); 0]
    }

    fn missing_input(&self) -> Option<u16> {
        if !self.config.often.is_set() {
            return Some(1);
        }
        None
    }

    fn initialise(&mut self) -> Result<(), BadValue> {
        let config = &mut self.config;
        config.turns.clear();
        config.share.clear();
        if !config.pace.is_set() {
            config.pace.set(Speed::from_si(1.0));
        }
        let value = initial(2, || limited(int_mul(config.often(), 2)?, 0.0, 10.0))?;
        config.turns.set(value);
        let value = initial(
            3,
            || limited(1.0 / int_to_float(config.often()), 0.5, 1.0),
        )?;
        config.share.set(value);
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.pace.as_value(),
            1 => self.config.often.as_value(),
            2 => self.config.turns.as_value(),
            3 => self.config.share.as_value(),
            _ => ValueRef::Unset,
        }
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match entry {
            0 => WriteError::check_within::<Speed>(value, 0.0, 2.0),
            1 => WriteError::check_within::<i64>(value, 1.0, 3.0),
            2 => WriteError::check_within::<i64>(value, 0.0, 10.0),
            3 => WriteError::check_within::<f64>(value, 0.5, 1.0),
            _ => Err(WriteError::Unknown),
        }
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        PlanState::accepts(self, entry, value)?;
        match entry {
            0 => set_input(&mut self.config.pace, value),
            1 => set_input(&mut self.config.often, value),
            _ => Err(WriteError::NotStarted),
        }
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        match entry {
            0 => stage_outside(&mut self.staged.pace, value),
            1 => stage_outside(&mut self.staged.often, value),
            2 => stage_outside(&mut self.staged.turns, value),
            3 => stage_outside(&mut self.staged.share, value),
            _ => {}
        }
    }

    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if let Some(value) = self.staged.pace.take() {
            to.write(0, &mut self.config.pace, value);
        }
        if let Some(value) = self.staged.often.take() {
            to.write(1, &mut self.config.often, value);
        }
        if let Some(value) = self.staged.turns.take() {
            to.write(2, &mut self.config.turns, value);
        }
        if let Some(value) = self.staged.share.take() {
            to.write(3, &mut self.config.share, value);
        }
    }

    #[inline]
    fn discard(&mut self) {
        self.staged = Staged::default();
    }
}

impl<E> Plan<E> for P
where
    E: Environment + ?Sized,
    super::inner::Inner: Plan<E>,
{
    fn start_supervisor<R: Run<Env = E>>(
        &mut self,
        _: SupervisorId,
        _: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        Err(Fault::INTERNAL)
    }

    #[inline]
    fn poll_supervisor<R: Run<Env = E>>(
        &mut self,
        _: SupervisorId,
        _: Events,
        _: &mut Cx<'_, R>,
    ) -> Fired {
        Fired::fault(Fault::INTERNAL)
    }

    fn start_element<R: Run<Env = E>>(
        &mut self,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Started {
        let started: Result<Active, Fault> = match element {
            COUNT => {
                let computed = cx
                    .compute::<
                        std_templates::Count,
                        std_templates::Count,
                    >(count_inputs(&self.config));
                return Started::computed(
                    computed,
                    |outcome| count_outputs(&mut self.staged, outcome),
                    cx,
                );
            }
            INNER => {
                let mut plan = super::inner::Inner::new();
                if let Err(fault) = cx
                    .noted(inner_inputs(&self.config, &mut plan.config))
                {
                    return Started::Failed(fault);
                }
                let mut machine = Machine::new(plan);
                let flow = cx.start_sub_plan(INNER_PLACE, &mut machine);
                let started = Started::sub_plan(
                    flow,
                    || inner_outputs(&mut self.staged, &machine.plan().config),
                    cx,
                );
                self.active = Active::Inner(machine);
                return started;
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
            Active::Inner(machine) => {
                let flow = cx.inside(INNER_PLACE, |cx| machine.step(cx));
                Polled::sub_plan(
                    flow,
                    || inner_outputs(&mut self.staged, &machine.plan().config),
                    cx,
                )
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
            Active::Inner(machine) => cx.inside(INNER_PLACE, |cx| machine.interrupt(cx)),
        }
    }

    fn leave(&mut self, _: ElementId) {
        self.active = Active::None;
    }

    fn end(&mut self) {
        self.active = Active::None;
        self.supervisors = Supervisors::default();
    }
}

/// The names of the ids of a trace.
pub static NAMES: NameTable = NameTable {
    components: &[
        ComponentRow::new("P", ComponentKind::Plan, "P", &[], "", &[]),
        ComponentRow::new(
                "count",
                ComponentKind::Computation,
                "Count",
                &[("Again", "inner"), ("Done", "terminate")],
                "",
                &[
                    PortRow::new("value", "").at("ranges.afp", 12, 38),
                    PortRow::new("limit", "").at("ranges.afp", 12, 53),
                ],
            )
            .writing(
                &[
                    PortRow::new("next", "")
                        .within(0.0, 10.0)
                        .at("ranges.afp", 12, 68)
                        .into(0, "turns"),
                ],
            ),
        ComponentRow::new(
                "inner",
                ComponentKind::SubPlan,
                "Inner",
                &[("OK", "count"), ("Interrupted", "")],
                "",
                &[
                    PortRow::new("angle", "rad")
                        .within(-1.5707963267948966, 1.5707963267948966)
                        .at("ranges.afp", 13, 34),
                ],
            )
            .writing(
                &[
                    PortRow::new("gap", "")
                        .within(0.5, 1.0)
                        .at("ranges.afp", 13, 65)
                        .into(0, "share"),
                ],
            ),
        ComponentRow::new(
            "inner.wait",
            ComponentKind::Actor,
            "Wait",
            &[("Elapsed", "terminate")],
            "",
            &[PortRow::new("duration", "s").within(0.0, 3600.0).at("ranges.afp", 19, 33)],
        ),
    ],
    entries: &[
        EntryRow::new("pace", EntryKind::In, "speed", "m/s", &[])
            .within(0.0, 2.0)
            .at("ranges.afp", 8, 22),
        EntryRow::new("often", EntryKind::In, "int", "", &[]).within(1.0, 3.0),
        EntryRow::new("turns", EntryKind::Var, "int", "", &[])
            .within(0.0, 10.0)
            .at("ranges.afp", 10, 22),
        EntryRow::new("share", EntryKind::Var, "float", "", &[])
            .within(0.5, 1.0)
            .at("ranges.afp", 11, 24),
        EntryRow::new("inner.angle", EntryKind::In, "angle", "rad", &[])
            .within(-1.5707963267948966, 1.5707963267948966),
        EntryRow::new("inner.gap", EntryKind::Out, "float", "", &[])
            .within(0.0, 1.0)
            .at("ranges.afp", 18, 22),
    ],
};

impl NamedPlan for P {
    type Names = NameTable;

    fn names(&self) -> NameTable {
        NAMES
    }

    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>> {
        let units: &[Unit<'static>] = match entry {
            0 => &super::units::SPEED,
            _ => &[],
        };
        units.iter().copied()
    }
}
