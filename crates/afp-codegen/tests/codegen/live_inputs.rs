// inner.rs

const WAIT: ElementId = ElementId(0);
const LOG: ElementId = ElementId(1);

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
        duration: Time::from_si(Length::from_si(1.0).si() / config.twice().si())
            * int_to_float(config.fixed()) * int_to_float(config.size()),
    })
}

/// Inputs of `log`.
fn log_inputs(config: &Config) -> Result<std_templates::log::Inputs<Text>, BadValue> {
    Ok(std_templates::log::Inputs {
        value: config.label.get().clone(),
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
    /// `in twice: speed`
    pub twice: Entry<Speed>,
    /// `in fixed: int`
    pub fixed: Entry<i64>,
    /// `in size: int`
    pub size: Entry<i64>,
    /// `in label: string`
    pub label: Entry<Text>,
}

/// The values of the next commit.
#[derive(Clone, Default)]
struct Staged {
    twice: Option<Speed>,
    fixed: Option<i64>,
    size: Option<i64>,
    label: Option<Text>,
}

impl Config {
    /// The value of `twice`.
    #[inline]
    pub fn twice(&self) -> Speed {
        *self.twice.get()
    }

    /// The value of `fixed`.
    #[inline]
    pub fn fixed(&self) -> i64 {
        *self.fixed.get()
    }

    /// The value of `size`.
    #[inline]
    pub fn size(&self) -> i64 {
        *self.size.get()
    }

    /// The value of `label`.
    #[inline]
    pub fn label(&self) -> &str {
        self.label.get().as_str()
    }
}

impl Inner {
    /// The entry `twice`, for `Scheduler::set`.
    pub const TWICE: TypedEntry<Self, Speed> = TypedEntry::new(0);

    /// The entry `fixed`, for `Scheduler::set`.
    pub const FIXED: TypedEntry<Self, i64> = TypedEntry::new(1);

    /// The entry `size`, for `Scheduler::set`.
    pub const SIZE: TypedEntry<Self, i64> = TypedEntry::new(2);

    /// The entry `label`, for `Scheduler::set`.
    pub const LABEL: TypedEntry<Self, Text> = TypedEntry::new(3);

    /// The plan, not yet started.
    pub fn new() -> Self {
        Self::default()
    }

    /// `in twice: speed`
    ///
    /// `None` before the first write.
    pub fn twice(&self) -> Option<Speed> {
        self.config.twice.value().copied()
    }

    /// Sets `twice` before the start.
    ///
    /// # Errors
    /// [`WriteError::NotFinite`] or [`WriteError::Range`].
    pub fn set_twice(&mut self, value: Speed) -> Result<(), WriteError> {
        let value = limited(value, 0.0, 5.0).map_err(WriteError::of)?;
        self.config.twice.set(value);
        Ok(())
    }

    /// `in fixed: int`
    ///
    /// `None` before the first write.
    pub fn fixed(&self) -> Option<i64> {
        self.config.fixed.value().copied()
    }

    /// Sets `fixed` before the start.
    pub fn set_fixed(&mut self, value: i64) {
        self.config.fixed.set(value);
    }

    /// `in size: int`
    ///
    /// `None` before the first write.
    pub fn size(&self) -> Option<i64> {
        self.config.size.value().copied()
    }

    /// Sets `size` before the start.
    pub fn set_size(&mut self, value: i64) {
        self.config.size.set(value);
    }

    /// `in label: string`
    ///
    /// `None` before the first write.
    pub fn label(&self) -> Option<&str> {
        self.config.label.value().map(|text| text.as_str())
    }

    /// Sets `label` before the start.
    pub fn set_label(&mut self, value: Text) {
        self.config.label.set(value);
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
        if !self.config.twice.is_set() {
            return Some(0);
        }
        if !self.config.fixed.is_set() {
            return Some(1);
        }
        if !self.config.size.is_set() {
            return Some(2);
        }
        if !self.config.label.is_set() {
            return Some(3);
        }
        None
    }

    fn initialise(&mut self) -> Result<(), BadValue> {
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.twice.as_value(),
            1 => self.config.fixed.as_value(),
            2 => self.config.size.as_value(),
            3 => self.config.label.as_value(),
            _ => ValueRef::Unset,
        }
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match entry {
            0 => WriteError::check_within::<Speed>(value, 0.0, 5.0),
            1 => WriteError::check::<i64>(value),
            2 => WriteError::check::<i64>(value),
            3 => WriteError::check::<Text>(value),
            _ => Err(WriteError::Unknown),
        }
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        PlanState::accepts(self, entry, value)?;
        match entry {
            0 => set_input(&mut self.config.twice, value),
            1 => set_input(&mut self.config.fixed, value),
            2 => set_input(&mut self.config.size, value),
            3 => set_input(&mut self.config.label, value),
            _ => Err(WriteError::NotStarted),
        }
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        match entry {
            0 => stage_outside(&mut self.staged.twice, value),
            1 => stage_outside(&mut self.staged.fixed, value),
            2 => stage_outside(&mut self.staged.size, value),
            3 => stage_outside(&mut self.staged.label, value),
            _ => {}
        }
    }

    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if let Some(value) = self.staged.twice.take() {
            to.write(0, &mut self.config.twice, value);
        }
        if let Some(value) = self.staged.fixed.take() {
            to.write(1, &mut self.config.fixed, value);
        }
        if let Some(value) = self.staged.size.take() {
            to.write(2, &mut self.config.size, value);
        }
        if let Some(value) = self.staged.label.take() {
            to.write(3, &mut self.config.label, value);
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
            LOG => {
                let computed = cx
                    .compute::<
                        std_templates::Log<Text>,
                        std_templates::Log<Text>,
                    >(log_inputs(&self.config));
                return Started::computed(computed, |_| Ok(()), cx);
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

// p.rs

const INNER: ElementId = ElementId(0);

/// The active element.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // subplan inner: Inner
    Inner(Machine<super::inner::Inner>),
}

/// The first ids of `inner` begin.
const INNER_PLACE: Child = Child { components: 1, entries: 2 };

/// Inputs of `inner`.
fn inner_inputs(config: &Config, to: &mut super::inner::Config) -> Result<(), BadValue> {
    to.twice.set(input(0, || limited(config.pace() * 2.0, 0.0, 5.0))?);
    to.fixed.set(3);
    to.size.set(2);
    to.label.set(config.name.get().clone());
    Ok(())
}

/// Live inputs of `inner`.
fn inner_live(config: &Config) -> Result<(Speed, Text), BadValue> {
    Ok((input(0, || limited(config.pace() * 2.0, 0.0, 5.0))?, config.name.get().clone()))
}

/// Sub-plans whose inputs are read again at each step.
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
    /// `in pace: speed`
    pub pace: Entry<Speed>,
    /// `var name: string`
    pub name: Entry<Text>,
}

/// The values of the next commit.
#[derive(Clone, Default)]
struct Staged {
    pace: Option<Speed>,
    name: Option<Text>,
}

impl Config {
    /// The value of `pace`.
    #[inline]
    pub fn pace(&self) -> Speed {
        *self.pace.get()
    }
}

impl P {
    /// The entry `pace`, for `Scheduler::set`.
    pub const PACE: TypedEntry<Self, Speed> = TypedEntry::new(0);

    /// The entry `name`, for `Scheduler::set`.
    pub const NAME: TypedEntry<Self, Text> = TypedEntry::new(1);

    /// The plan, not yet started.
    pub fn new() -> Self {
        Self::default()
    }

    /// `in pace: speed`
    ///
    /// `None` before the first write.
    pub fn pace(&self) -> Option<Speed> {
        self.config.pace.value().copied()
    }

    /// Sets `pace` before the start.
    ///
    /// # Errors
    /// [`WriteError::NotFinite`].
    pub fn set_pace(&mut self, value: Speed) -> Result<(), WriteError> {
        let value = finite(value).map_err(|_| WriteError::NotFinite)?;
        self.config.pace.set(value);
        Ok(())
    }

    /// `var name: string`
    ///
    /// `None` before the first write.
    pub fn name(&self) -> Option<&str> {
        self.config.name.value().map(|text| text.as_str())
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
        None
    }

    fn initialise(&mut self) -> Result<(), BadValue> {
        let config = &mut self.config;
        config.name.clear();
        if !config.pace.is_set() {
            config.pace.set(Speed::from_si(1.0));
        }
        config.name.set(Text::try_from("a")?);
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.pace.as_value(),
            1 => self.config.name.as_value(),
            _ => ValueRef::Unset,
        }
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match entry {
            0 => WriteError::check::<Speed>(value),
            1 => WriteError::check::<Text>(value),
            _ => Err(WriteError::Unknown),
        }
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        PlanState::accepts(self, entry, value)?;
        match entry {
            0 => set_input(&mut self.config.pace, value),
            _ => Err(WriteError::NotStarted),
        }
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        match entry {
            0 => stage_outside(&mut self.staged.pace, value),
            1 => stage_outside(&mut self.staged.name, value),
            _ => {}
        }
    }

    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if let Some(value) = self.staged.pace.take() {
            to.write(0, &mut self.config.pace, value);
        }
        if let Some(value) = self.staged.name.take() {
            to.write(1, &mut self.config.name, value);
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
            INNER => {
                let mut plan = super::inner::Inner::new();
                if let Err(fault) = cx
                    .noted(inner_inputs(&self.config, &mut plan.config))
                {
                    return Started::Failed(fault);
                }
                let mut machine = Machine::new(plan);
                let flow = cx.start_sub_plan(INNER_PLACE, &mut machine);
                let started = Started::sub_plan(flow, || Ok(()), cx);
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
                let live = match cx.noted(inner_live(&self.config)) {
                    Ok(live) => live,
                    Err(fault) => return Polled::Failed(fault),
                };
                cx.pass_live(
                    INNER_PLACE,
                    machine,
                    |plan, to| {
                        let mut changed = false;
                        changed |= to.update(0, &mut plan.config.twice, live.0);
                        changed |= to.update(3, &mut plan.config.label, live.1);
                        changed
                    },
                );
                let flow = cx.inside(INNER_PLACE, |cx| machine.step(cx));
                Polled::sub_plan(flow, || Ok(()), cx)
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
