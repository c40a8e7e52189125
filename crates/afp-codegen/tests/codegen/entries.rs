// p.rs

/// Every kind and type of entry.
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
    /// `in often: int`
    pub often: Entry<i64>,
    /// `var flag: bool`
    pub flag: Entry<bool>,
    /// `var text: string`
    pub text: Entry<Text>,
    /// `out size: length^2`
    pub size: Entry<Quantity<2, 0, 0, 0, 0, 0>>,
    /// `const half: float`
    pub half: Entry<f64>,
}

/// The values of the next commit.
#[derive(Clone, Default)]
struct Staged {
    pace: Option<Speed>,
    often: Option<i64>,
    flag: Option<bool>,
    text: Option<Text>,
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

    /// The value of `flag`.
    #[inline]
    pub fn flag(&self) -> bool {
        *self.flag.get()
    }

    /// The value of `text`.
    #[inline]
    pub fn text(&self) -> &str {
        self.text.get().as_str()
    }

    /// The value of `size`.
    #[inline]
    pub fn size(&self) -> Quantity<2, 0, 0, 0, 0, 0> {
        *self.size.get()
    }

    /// The value of `half`.
    #[inline]
    pub fn half(&self) -> f64 {
        *self.half.get()
    }
}

impl P {
    /// The entry `pace`, for `Scheduler::set`.
    pub const PACE: TypedEntry<Self, Speed> = TypedEntry::new(0);

    /// The entry `often`, for `Scheduler::set`.
    pub const OFTEN: TypedEntry<Self, i64> = TypedEntry::new(1);

    /// The entry `flag`, for `Scheduler::set`.
    pub const FLAG: TypedEntry<Self, bool> = TypedEntry::new(2);

    /// The entry `text`, for `Scheduler::set`.
    pub const TEXT: TypedEntry<Self, Text> = TypedEntry::new(3);

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

    /// `in often: int`
    ///
    /// `None` before the first write.
    pub fn often(&self) -> Option<i64> {
        self.config.often.value().copied()
    }

    /// Sets `often` before the start.
    pub fn set_often(&mut self, value: i64) {
        self.config.often.set(value);
    }

    /// `var flag: bool`
    ///
    /// `None` before the first write.
    pub fn flag(&self) -> Option<bool> {
        self.config.flag.value().copied()
    }

    /// `var text: string`
    ///
    /// `None` before the first write.
    pub fn text(&self) -> Option<&str> {
        self.config.text.value().map(|text| text.as_str())
    }

    /// `out size: length^2`
    ///
    /// `None` before the first write.
    pub fn size(&self) -> Option<Quantity<2, 0, 0, 0, 0, 0>> {
        self.config.size.value().copied()
    }

    /// `const half: float`
    ///
    /// `None` before the first write.
    pub fn half(&self) -> Option<f64> {
        self.config.half.value().copied()
    }
}

impl PlanState for P {
    type Tables = Rules;
    type Slots = [Slot; 2];
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

    fn slots(&self) -> [Slot; 2] {
        [Slot::default(); 2]
    }

    fn missing_input(&self) -> Option<u16> {
        if !self.config.pace.is_set() {
            return Some(0);
        }
        None
    }

    fn initialise(&mut self) -> Result<(), BadValue> {
        let config = &mut self.config;
        config.flag.clear();
        config.text.clear();
        config.size.clear();
        config.half.clear();
        let value = initial(5, || finite(1.0 / 2.0))?;
        config.half.set(value);
        if !config.often.is_set() {
            config.often.set(3);
        }
        config.flag.set(true);
        let value = initial(
            3,
            || Ok(join("a", Text::print(config.often())?.as_str())?),
        )?;
        config.text.set(value);
        let value = initial(
            4,
            || finite(
                <Quantity<
                    2,
                    0,
                    0,
                    0,
                    0,
                    0,
                >>::from_si(Length::from_si(2.0).si() * Length::from_si(3.0).si()),
            ),
        )?;
        config.size.set(value);
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.pace.as_value(),
            1 => self.config.often.as_value(),
            2 => self.config.flag.as_value(),
            3 => self.config.text.as_value(),
            4 => self.config.size.as_value(),
            5 => self.config.half.as_value(),
            _ => ValueRef::Unset,
        }
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match entry {
            0 => WriteError::check::<Speed>(value),
            1 => WriteError::check::<i64>(value),
            2 => WriteError::check::<bool>(value),
            3 => WriteError::check::<Text>(value),
            4 => Err(WriteError::ReadOnly),
            5 => Err(WriteError::ReadOnly),
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
            2 => stage_outside(&mut self.staged.flag, value),
            3 => stage_outside(&mut self.staged.text, value),
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
        if let Some(value) = self.staged.flag.take() {
            to.write(2, &mut self.config.flag, value);
        }
        if let Some(value) = self.staged.text.take() {
            to.write(3, &mut self.config.text, value);
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
    afp_std::Wait: Actor<std_templates::Wait, E>,
    afp_std::CheckValue<
        Quantity<2, 0, 0, 0, 0, 0>,
    >: Supervisor<std_templates::CheckValue<Quantity<2, 0, 0, 0, 0, 0>>, E>,
    afp_std::CheckValue<i64>: Supervisor<std_templates::CheckValue<i64>, E>,
{
    fn start_supervisor<R: Run<Env = E>>(
        &mut self,
        supervisor: SupervisorId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault> {
        match supervisor {
            WAIT_MORE => {
                let inputs = Ok(std_templates::check_value::Inputs {});
                self.supervisors.wait_more = cx.start_supervisor(inputs)?;
            }
            WAIT_SAME => {
                let inputs = Ok(std_templates::check_value::Inputs {});
                self.supervisors.wait_same = cx.start_supervisor(inputs)?;
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
            WAIT_MORE => {
                let live = wait_more_live(&self.config);
                let watch = &mut self.supervisors.wait_more;
                Fired::supervisor(
                    cx.poll_supervisor(watch, live, wanted),
                    |_| Ok(()),
                    cx,
                )
            }
            WAIT_SAME => {
                let live = wait_same_live(&self.config);
                let watch = &mut self.supervisors.wait_same;
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

    fn leave(&mut self, element: ElementId) {
        self.active = Active::None;
        match element {
            WAIT => {
                self.supervisors.wait_more = None;
                self.supervisors.wait_same = None;
            }
            _ => {}
        }
    }

    fn end(&mut self) {
        self.active = Active::None;
        self.supervisors = Supervisors::default();
    }
}
