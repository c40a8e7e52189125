// enums.rs

//! The enums of the plan files.

// **** Enums ****

/// The enum `Mood`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mood {
    /// `calm`
    #[default]
    Calm,
    /// `wild`
    Wild,
}

impl ::afp_core::rt::Choice for Mood {
    const NAMES: &'static [&'static str] = &["calm", "wild"];

    fn index(self) -> u16 {
        match self {
            Mood::Calm => 0,
            Mood::Wild => 1,
        }
    }

    fn from_index(index: u16) -> ::core::option::Option<Self> {
        match index {
            0 => ::core::option::Option::Some(Mood::Calm),
            1 => ::core::option::Option::Some(Mood::Wild),
            _ => ::core::option::Option::None,
        }
    }
}

impl ::afp_core::rt::Stored for Mood {
    fn as_value(&self) -> ::afp_core::ValueRef<'_> {
        ::afp_core::ValueRef::Choice(::afp_core::rt::Choice::index(*self))
    }
}

impl ::afp_core::rt::Any for Mood {}
impl ::afp_core::rt::Writable for Mood {
    fn from_value(
        value: &::afp_core::Value,
    ) -> ::core::result::Result<Self, ::afp_core::WriteError> {
        match value {
            ::afp_core::Value::Choice(index) => {
                ::afp_core::rt::Choice::from_index(*index)
                    .ok_or(::afp_core::WriteError::Type)
            }
            _ => ::core::result::Result::Err(::afp_core::WriteError::Type),
        }
    }
}

// units.rs

//! The units that a quantity may be written in.

use ::afp_core::rt::{Scale, Unit};

// **** Units ****

/// Units of `speed`.
pub static SPEED: [Unit<'static>; 30] = [
    Unit {
        name: "m/s",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "m/ms",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "m/us",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "m/ns",
        scale: Scale::Decimal(9),
    },
    Unit {
        name: "m/min",
        scale: Scale::fraction(1, 60, 0, 0),
    },
    Unit {
        name: "m/h",
        scale: Scale::fraction(1, 3600, 0, 0),
    },
    Unit {
        name: "km/s",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "km/ms",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "km/us",
        scale: Scale::Decimal(9),
    },
    Unit {
        name: "km/ns",
        scale: Scale::Decimal(12),
    },
    Unit {
        name: "km/min",
        scale: Scale::fraction(1, 60, 3, 0),
    },
    Unit {
        name: "km/h",
        scale: Scale::fraction(1, 3600, 3, 0),
    },
    Unit {
        name: "cm/s",
        scale: Scale::Decimal(-2),
    },
    Unit {
        name: "cm/ms",
        scale: Scale::Decimal(1),
    },
    Unit {
        name: "cm/us",
        scale: Scale::Decimal(4),
    },
    Unit {
        name: "cm/ns",
        scale: Scale::Decimal(7),
    },
    Unit {
        name: "cm/min",
        scale: Scale::fraction(1, 60, -2, 0),
    },
    Unit {
        name: "cm/h",
        scale: Scale::fraction(1, 3600, -2, 0),
    },
    Unit {
        name: "mm/s",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "mm/ms",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "mm/us",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "mm/ns",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "mm/min",
        scale: Scale::fraction(1, 60, -3, 0),
    },
    Unit {
        name: "mm/h",
        scale: Scale::fraction(1, 3600, -3, 0),
    },
    Unit {
        name: "um/s",
        scale: Scale::Decimal(-6),
    },
    Unit {
        name: "um/ms",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "um/us",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "um/ns",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "um/min",
        scale: Scale::fraction(1, 60, -6, 0),
    },
    Unit {
        name: "um/h",
        scale: Scale::fraction(1, 3600, -6, 0),
    },
];

/// Units of `length^2/duration`.
pub static LENGTH2_PER_DURATION: [Unit<'static>; 30] = [
    Unit {
        name: "m^2/s",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "m^2/ms",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "m^2/us",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "m^2/ns",
        scale: Scale::Decimal(9),
    },
    Unit {
        name: "m^2/min",
        scale: Scale::fraction(1, 60, 0, 0),
    },
    Unit {
        name: "m^2/h",
        scale: Scale::fraction(1, 3600, 0, 0),
    },
    Unit {
        name: "km^2/s",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "km^2/ms",
        scale: Scale::Decimal(9),
    },
    Unit {
        name: "km^2/us",
        scale: Scale::Decimal(12),
    },
    Unit {
        name: "km^2/ns",
        scale: Scale::Decimal(15),
    },
    Unit {
        name: "km^2/min",
        scale: Scale::fraction(1, 60, 6, 0),
    },
    Unit {
        name: "km^2/h",
        scale: Scale::fraction(1, 3600, 6, 0),
    },
    Unit {
        name: "cm^2/s",
        scale: Scale::Decimal(-4),
    },
    Unit {
        name: "cm^2/ms",
        scale: Scale::Decimal(-1),
    },
    Unit {
        name: "cm^2/us",
        scale: Scale::Decimal(2),
    },
    Unit {
        name: "cm^2/ns",
        scale: Scale::Decimal(5),
    },
    Unit {
        name: "cm^2/min",
        scale: Scale::fraction(1, 60, -4, 0),
    },
    Unit {
        name: "cm^2/h",
        scale: Scale::fraction(1, 3600, -4, 0),
    },
    Unit {
        name: "mm^2/s",
        scale: Scale::Decimal(-6),
    },
    Unit {
        name: "mm^2/ms",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "mm^2/us",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "mm^2/ns",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "mm^2/min",
        scale: Scale::fraction(1, 60, -6, 0),
    },
    Unit {
        name: "mm^2/h",
        scale: Scale::fraction(1, 3600, -6, 0),
    },
    Unit {
        name: "um^2/s",
        scale: Scale::Decimal(-12),
    },
    Unit {
        name: "um^2/ms",
        scale: Scale::Decimal(-9),
    },
    Unit {
        name: "um^2/us",
        scale: Scale::Decimal(-6),
    },
    Unit {
        name: "um^2/ns",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "um^2/min",
        scale: Scale::fraction(1, 60, -12, 0),
    },
    Unit {
        name: "um^2/h",
        scale: Scale::fraction(1, 3600, -12, 0),
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

/// Units of `length^2`.
pub static LENGTH2: [Unit<'static>; 5] = [
    Unit {
        name: "m^2",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "km^2",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "cm^2",
        scale: Scale::Decimal(-4),
    },
    Unit {
        name: "mm^2",
        scale: Scale::Decimal(-6),
    },
    Unit {
        name: "um^2",
        scale: Scale::Decimal(-12),
    },
];

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

// round.rs

//! The plan `Round`: A round of looking, with a loop inside.

use ::afp_core::{
    Clock, Duration, Environment, Events, Fault, Text, Value, ValueRef, WriteError,
};
use ::afp_core::quantity::{Angle, Length, Quantity, Speed};
use ::afp_core::rt::{
    Actor, AtElement, Child, Committer, ComponentRow, Cx, ElementKind, ElementRow, Entry,
    EntryRow, Fired, NameTable, NamedPlan, Object, Plan, PlanState, PlanTable, Polled,
    Range, Slot, Started, Supervisor, SupervisorRow, Tables, Target, Unit, finite, hold,
    int_add, int_mul, join, rem, set_input, stage_outside,
};
use ::afp_core::trace::{EntryKind, Kind, Sink};
use crate::kit::templates as kit;
use afp_std::templates as std_templates;

// **** Actors ****

const LOOP: u16 = 0;
const SEEK: u16 = 1;
const AREA: u16 = 2;

/// The element that is active.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // actor seek: Seek
    Seek(crate::kit::Seek),
}

/// Inputs of `loop`.
fn r#loop(config: &Config) -> Result<std_templates::count::Inputs, Fault> {
    Ok(std_templates::count::Inputs {
        value: config.i(),
        limit: config.rounds(),
    })
}

/// Outputs of `loop`.
fn loop_outputs(
    staged: &mut Staged,
    outcome: std_templates::count::State,
) -> Result<(), Fault> {
    match outcome {
        std_templates::count::State::Again { next } => {
            staged.i = Some(next);
        }
        std_templates::count::State::Done { next } => {
            staged.i = Some(next);
        }
    }
    Ok(())
}

/// Inputs of `seek`.
fn seek<'a>(
    config: &'a Config,
    text_1: &'a mut Text,
) -> Result<kit::seek::Inputs<'a>, Fault> {
    Ok(kit::seek::Inputs {
        name: hold(text_1, join(config.label(), Text::print(config.i())?.as_str())?),
        side: crate::kit::templates::Side::Left,
        r#where: config.here()?,
        tries: int_add(int_mul(2, config.i())?, 1)?,
    })
}

/// Live inputs of `seek`.
fn seek_live(config: &Config) -> Result<kit::seek::Live, Fault> {
    Ok(kit::seek::Live {
        speed: Speed::from_si(
            rem(Speed::from_si(2.0 * config.pace().si()).si(), Speed::from_si(1.0).si())?,
        ),
        r#loop: true,
    })
}

/// Outputs of `seek`.
fn seek_outputs(staged: &mut Staged, outcome: kit::seek::State) -> Result<(), Fault> {
    match outcome {
        kit::seek::State::Found { said, .. } => {
            staged.text = Some(said);
        }
        kit::seek::State::Lost { said, turn } => {
            staged.text = Some(said);
            staged.turned = Some(finite(turn)?);
        }
        _ => {}
    }
    Ok(())
}

/// Inputs of `area`.
fn area(config: &Config) -> Result<kit::area::Inputs, Fault> {
    Ok(kit::area::Inputs {
        width: config.wide() / 2.0,
        height: Length::from_si(2.0 * (config.wide() - Length::from_si(0.1)).si()) * 3.0,
    })
}

/// Outputs of `area`.
fn area_outputs(staged: &mut Staged, outcome: kit::area::State) -> Result<(), Fault> {
    match outcome {
        kit::area::State::Small { area } => {
            staged.size = Some(finite(area)?);
        }
        kit::area::State::Large { area } => {
            staged.size = Some(finite(area)?);
        }
    }
    Ok(())
}

// **** Supervisors ****

const SEEK_WATCH: u16 = 0;

/// The supervisors, each while it watches.
#[derive(Clone, Default)]
struct Supervisors {
    // local supervisor seek.watch: Watch
    seek_watch: Option<crate::kit::Watch<i64>>,
}

/// Inputs of `seek.watch`.
fn seek_watch<'a>() -> Result<kit::watch::Inputs<'a>, Fault> {
    Ok(kit::watch::Inputs {
        label: "i",
    })
}

/// Live inputs of `seek.watch`.
fn seek_watch_live(config: &Config) -> Result<kit::watch::Live<i64>, Fault> {
    Ok(kit::watch::Live {
        value: config.i(),
    })
}

/// Outputs of `seek.watch`.
fn seek_watch_outputs(
    staged: &mut Staged,
    outcome: kit::watch::Event<i64>,
) -> Result<(), Fault> {
    if let kit::watch::Event::Changed { seen, .. } = outcome {
        staged.i = Some(seen);
    }
    Ok(())
}

// **** Plan ****

/// A round of looking, with a loop inside.
#[derive(Clone, Default)]
pub struct Round {
    pub(super) config: Config,
    staged: Staged,
    active: Active,
    supervisors: Supervisors,
}

/// The configuration.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// How often.
    ///
    /// `in rounds: int`
    pub rounds: Entry<i64>,
    /// `in label: string`
    pub label: Entry<Text>,
    /// `in here: Place`
    pub here: Entry<Object<crate::kit::Place>>,
    /// `in pace: speed`
    pub pace: Entry<Speed>,
    /// `var i: int`
    pub i: Entry<i64>,
    /// `out turned: angle`
    pub turned: Entry<Angle>,
    /// `out size: length^2`
    pub size: Entry<Quantity<2, 0, 0, 0, 0, 0>>,
    /// `out text: string`
    pub text: Entry<Text>,
    /// `const wide: length`
    pub wide: Entry<Length>,
}

/// What the next commit writes.
#[derive(Clone, Default)]
struct Staged {
    rounds: Option<i64>,
    label: Option<Text>,
    pace: Option<Speed>,
    i: Option<i64>,
    turned: Option<Angle>,
    size: Option<Quantity<2, 0, 0, 0, 0, 0>>,
    text: Option<Text>,
}

impl Config {
    /// The value of `rounds`.
    #[inline]
    pub fn rounds(&self) -> i64 {
        *self.rounds.get()
    }

    /// The value of `label`.
    #[inline]
    pub fn label(&self) -> &str {
        self.label.get().as_str()
    }

    /// The value of `here`.
    #[inline]
    pub fn here(&self) -> Result<&crate::kit::Place, Fault> {
        self.here.get().get()
    }

    /// The value of `pace`.
    #[inline]
    pub fn pace(&self) -> Speed {
        *self.pace.get()
    }

    /// The value of `i`.
    #[inline]
    pub fn i(&self) -> i64 {
        *self.i.get()
    }

    /// The value of `wide`.
    #[inline]
    pub fn wide(&self) -> Length {
        *self.wide.get()
    }
}

impl Round {
    /// The plan, not yet started.
    pub fn new() -> Self {
        Self::default()
    }

    /// How often.
    ///
    /// `in rounds: int`
    ///
    /// `None` while nobody has written it.
    pub fn rounds(&self) -> Option<i64> {
        self.config.rounds.value().copied()
    }

    /// Sets `rounds` before the start.
    pub fn set_rounds(&mut self, value: i64) {
        self.config.rounds.set(value);
    }

    /// `in label: string`
    ///
    /// `None` while nobody has written it.
    pub fn label(&self) -> Option<&str> {
        self.config.label.value().map(|text| text.as_str())
    }

    /// Sets `label` before the start.
    pub fn set_label(&mut self, value: Text) {
        self.config.label.set(value);
    }

    /// `in here: Place`
    ///
    /// `None` while nobody has written it.
    pub fn here(&self) -> Option<&crate::kit::Place> {
        self.config.here.value().and_then(|object| object.get().ok())
    }

    /// Sets `here` before the start.
    pub fn set_here(&mut self, value: crate::kit::Place) {
        self.config.here.set(Object::new(value));
    }

    /// `in pace: speed`
    ///
    /// `None` while nobody has written it.
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

    /// `var i: int`
    ///
    /// `None` while nobody has written it.
    pub fn i(&self) -> Option<i64> {
        self.config.i.value().copied()
    }

    /// `out turned: angle`
    ///
    /// `None` while nobody has written it.
    pub fn turned(&self) -> Option<Angle> {
        self.config.turned.value().copied()
    }

    /// `out size: length^2`
    ///
    /// `None` while nobody has written it.
    pub fn size(&self) -> Option<Quantity<2, 0, 0, 0, 0, 0>> {
        self.config.size.value().copied()
    }

    /// `out text: string`
    ///
    /// `None` while nobody has written it.
    pub fn text(&self) -> Option<&str> {
        self.config.text.value().map(|text| text.as_str())
    }

    /// `const wide: length`
    ///
    /// `None` while nobody has written it.
    pub fn wide(&self) -> Option<Length> {
        self.config.wide.value().copied()
    }
}

impl PlanState for Round {
    type Tables = Rules;
    type Slots = [Slot; 1];

    #[inline]
    fn tables(&self) -> Rules {
        Rules
    }

    #[inline(always)]
    fn at_element<A: AtElement>(element: u16, run: A) -> A::Out {
        match element {
            SEEK => run.at::<{ SEEK }>(),
            _ => run.unknown(),
        }
    }

    fn try_clone(&self) -> Option<Self> {
        Some(self.clone())
    }

    fn slots(&self) -> [Slot; 1] {
        [Slot::default(); 1]
    }

    fn missing_input(&self) -> Option<u16> {
        if !self.config.rounds.is_set() {
            return Some(0);
        }
        if !self.config.here.is_set() {
            return Some(2);
        }
        if !self.config.pace.is_set() {
            return Some(3);
        }
        None
    }

    fn initialise(&mut self) -> Result<(), Fault> {
        let config = &mut self.config;
        config.i.clear();
        config.turned.clear();
        config.size.clear();
        config.text.clear();
        config.wide.clear();
        config.wide.set(Length::from_si(2.0));
        if !config.label.is_set() {
            config.label.set(Text::try_from("round")?);
        }
        config.i.set(0);
        let value = finite(
            <Quantity<
                2,
                0,
                0,
                0,
                0,
                0,
            >>::from_si(Length::from_si(1.0).si() * Length::from_si(1.0).si()),
        )?;
        config.size.set(value);
        let value = join(
            join(config.label(), " of ")?.as_str(),
            Text::print(config.rounds())?.as_str(),
        )?;
        config.text.set(value);
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.rounds.as_value(),
            1 => self.config.label.as_value(),
            2 => self.config.here.as_value(),
            3 => self.config.pace.as_value(),
            4 => self.config.i.as_value(),
            5 => self.config.turned.as_value(),
            6 => self.config.size.as_value(),
            7 => self.config.text.as_value(),
            8 => self.config.wide.as_value(),
            _ => ValueRef::Unset,
        }
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match entry {
            0 => WriteError::check::<i64>(value),
            1 => WriteError::check::<Text>(value),
            2 => Err(WriteError::Type),
            3 => WriteError::check::<Speed>(value),
            4 => WriteError::check::<i64>(value),
            5 => Err(WriteError::ReadOnly),
            6 => Err(WriteError::ReadOnly),
            7 => Err(WriteError::ReadOnly),
            8 => Err(WriteError::ReadOnly),
            _ => Err(WriteError::Unknown),
        }
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        match entry {
            0 => stage_outside(&mut self.staged.rounds, value),
            1 => stage_outside(&mut self.staged.label, value),
            3 => stage_outside(&mut self.staged.pace, value),
            4 => stage_outside(&mut self.staged.i, value),
            _ => {}
        }
    }

    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if let Some(value) = self.staged.rounds.take() {
            to.write(0, &mut self.config.rounds, value);
        }
        if let Some(value) = self.staged.label.take() {
            to.write(1, &mut self.config.label, value);
        }
        if let Some(value) = self.staged.pace.take() {
            to.write(3, &mut self.config.pace, value);
        }
        if let Some(value) = self.staged.i.take() {
            to.write(4, &mut self.config.i, value);
        }
        if let Some(value) = self.staged.turned.take() {
            to.write(5, &mut self.config.turned, value);
        }
        if let Some(value) = self.staged.size.take() {
            to.write(6, &mut self.config.size, value);
        }
        if let Some(value) = self.staged.text.take() {
            to.write(7, &mut self.config.text, value);
        }
    }

    #[inline]
    fn discard(&mut self) {
        self.staged = Staged::default();
    }
}

impl<E> Plan<E> for Round
where
    E: Environment + ?Sized,
    crate::kit::Seek: Actor<kit::Seek, E>,
    crate::kit::Watch<i64>: Supervisor<kit::Watch<i64>, E>,
{
    fn start_supervisor<S: Sink, C: Clock>(
        &mut self,
        supervisor: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), Fault> {
        match supervisor {
            SEEK_WATCH => {
                let inputs = seek_watch();
                self.supervisors.seek_watch = cx
                    .start_supervisor(inputs, Events::from_bits(0b10))?;
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
            SEEK_WATCH => {
                let live = seek_watch_live(&self.config);
                let watch = &mut self.supervisors.seek_watch;
                Fired::supervisor(
                    cx.poll_supervisor(watch, live),
                    |outcome| seek_watch_outputs(&mut self.staged, outcome),
                )
            }
            _ => Fired::fault(Fault::INTERNAL),
        }
    }

    fn start_element<S: Sink, C: Clock>(
        &mut self,
        element: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Started {
        let started: Result<Active, Fault> = match element {
            LOOP => {
                let computed = cx
                    .compute::<
                        std_templates::Count,
                        afp_std::Count,
                    >(r#loop(&self.config));
                return Started::computed(
                    computed,
                    |outcome| loop_outputs(&mut self.staged, outcome),
                );
            }
            SEEK => {
                let mut text_1 = Text::new();
                cx.start_actor(seek(&self.config, &mut text_1)).map(Active::Seek)
            }
            AREA => {
                let computed = cx
                    .compute::<kit::Area, crate::kit::Area>(area(&self.config));
                return Started::computed(
                    computed,
                    |outcome| area_outputs(&mut self.staged, outcome),
                );
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
    fn poll_element<S: Sink, C: Clock>(
        &mut self,
        _: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Polled {
        match &mut self.active {
            Active::None => Polled::Failed(Fault::INTERNAL),
            Active::Seek(actor) => {
                let live = seek_live(&self.config);
                Polled::actor(
                    cx.poll_actor(actor, live),
                    |outcome| seek_outputs(&mut self.staged, outcome),
                )
            }
        }
    }

    fn interrupt_element<S: Sink, C: Clock>(
        &mut self,
        _: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), Fault> {
        match &mut self.active {
            Active::None => Err(Fault::INTERNAL),
            Active::Seek(actor) => cx.interrupt_actor(actor),
        }
    }

    fn leave(&mut self, element: u16) {
        self.active = Active::None;
        match element {
            SEEK => {
                self.supervisors.seek_watch = None;
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

/// Where the scheduler reads the rules of the plan.
#[derive(Clone, Copy, Debug)]
pub struct Rules;

impl Tables for Rules {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        PlanTable {
            start: LOOP,
            globals: 0,
            entries: 9,
            elements: &ELEMENTS,
            supervisors: &SUPERVISORS,
            edges: &EDGES,
            sweeps: &SWEEPS,
        }
    }
}

/// Where each state and event leads.
static EDGES: [Target; 9] = [
    // loop: Again -> seek
    Target::Element(SEEK),
    // loop: Done -> area
    Target::Element(AREA),
    // seek: Found -> loop
    Target::Element(LOOP),
    // seek: Lost -> terminate
    Target::Terminate,
    // seek: Bored -> loop
    Target::Element(LOOP),
    // area: Small -> terminate
    Target::Terminate,
    // area: Large -> loop
    Target::Element(LOOP),
    // seek.watch: Changed -> ignore
    Target::Ignore,
    // seek.watch: Same -> loop
    Target::Element(LOOP),
];

/// The elements.
static ELEMENTS: [ElementRow; 3] = [
    // computation loop: Count
    ElementRow {
        kind: ElementKind::Computation,
        period: Duration::ZERO,
        states: Range { first: 0, len: 2 },
        on_error: Target::None,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 0, len: 0 },
        child: Child { components: 0, entries: 0 },
    },
    // actor seek: Seek
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 2, len: 3 },
        on_error: Target::Terminate,
        locals: Range { first: 0, len: 1 },
        sweep: Range { first: 0, len: 1 },
        child: Child { components: 0, entries: 0 },
    },
    // computation area: Area
    ElementRow {
        kind: ElementKind::Computation,
        period: Duration::ZERO,
        states: Range { first: 5, len: 2 },
        on_error: Target::None,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 1, len: 0 },
        child: Child { components: 0, entries: 0 },
    },
];

/// The supervisors: global ones, then local ones.
static SUPERVISORS: [SupervisorRow; 1] = [
    // seek.watch: Watch
    SupervisorRow {
        period: Duration::from_millis(5),
        deadline: Duration::from_millis(5),
        budget: Duration::ZERO,
        slot: 0,
        events: Range { first: 7, len: 2 },
        on_miss: Target::Terminate,
        wanted: Events::from_bits(0b10),
    },
];

/// Who is polled while an element is active, in order.
static SWEEPS: [u16; 1] = [
    // while seek is active
    SEEK_WATCH,
];

// **** Names ****

/// The names behind the ids of a trace.
pub static NAMES: NameTable = NameTable {
    components: &[
        ComponentRow::new("Round", Kind::Plan, "Round", &[], "", &[]),
        ComponentRow::new(
            "loop",
            Kind::Computation,
            "Count",
            &[("Again", "seek"), ("Done", "area")],
            "",
            &["value", "limit"],
        ),
        ComponentRow::new(
            "seek",
            Kind::Actor,
            "Seek",
            &[("Found", "loop"), ("Lost", "terminate"), ("Bored", "loop")],
            "terminate",
            &["name", "side", "where", "speed", "loop", "tries"],
        ),
        ComponentRow::new(
            "area",
            Kind::Computation,
            "Area",
            &[("Small", "terminate"), ("Large", "loop")],
            "",
            &["width", "height"],
        ),
        ComponentRow::new(
            "seek.watch",
            Kind::Supervisor,
            "Watch",
            &[("Changed", "ignore"), ("Same", "loop")],
            "terminate",
            &["value", "label"],
        ),
    ],
    entries: &[
        EntryRow::new("rounds", EntryKind::In, "int", "", &[]),
        EntryRow::new("label", EntryKind::In, "string", "", &[]),
        EntryRow::new("here", EntryKind::In, "Place", "", &[]),
        EntryRow::new("pace", EntryKind::In, "speed", "m/s", &[]),
        EntryRow::new("i", EntryKind::Var, "int", "", &[]),
        EntryRow::new("turned", EntryKind::Out, "angle", "rad", &[]),
        EntryRow::new("size", EntryKind::Out, "length^2", "m^2", &[]),
        EntryRow::new("text", EntryKind::Out, "string", "", &[]),
        EntryRow::new("wide", EntryKind::Const, "length", "m", &[]),
    ],
};

impl NamedPlan for Round {
    type Names = NameTable;

    fn names(&self) -> NameTable {
        NAMES
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        self.accepts(entry, value)?;
        match entry {
            0 => set_input(&mut self.config.rounds, value),
            1 => set_input(&mut self.config.label, value),
            3 => set_input(&mut self.config.pace, value),
            _ => Err(WriteError::ReadOnly),
        }
    }

    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>> {
        let units: &[Unit<'static>] = match entry {
            3 => &super::units::SPEED,
            _ => &[],
        };
        units.iter().copied()
    }
}

// everything.rs

//! The plan `Everything`: Every kind of entry and formula.

use ::afp_core::{
    Clock, Duration, Environment, Events, Fault, Text, Value, ValueRef, WriteError,
};
use ::afp_core::quantity::{Angle, Length, Quantity, Speed};
use ::afp_core::rt::{
    Actor, AtElement, Child, Committer, ComponentRow, Cx, ElementKind, ElementRow, Entry,
    EntryRow, Fired, Machine, NameTable, NamedPlan, Object, Plan, PlanState, PlanTable,
    Polled, Range, Slot, Started, Supervisor, SupervisorRow, Tables, Target, Unit,
    bool_to_int, finite, hold, int_mul, int_neg, int_sub, join, parse_quantity,
    print_choice, print_quantity, set_input, stage_outside,
};
use ::afp_core::trace::{EntryKind, Kind, Sink};
use crate::kit::templates as kit;
use afp_std::templates as std_templates;

// **** Actors ****

const HERE: u16 = 0;
const FIRST: u16 = 1;
const ROUND: u16 = 2;
const ASSIGN: u16 = 3;
const COMPARE: u16 = 4;
const AGAIN: u16 = 5;
const SHOW: u16 = 6;

/// The element that is active.
#[derive(Clone, Default)]
enum Active {
    #[default]
    None,
    // actor first: Seek
    First(crate::kit::Seek),
    // subplan round: Round
    Round(Machine<super::round::Round>),
    // subplan again: Round
    Again(Machine<super::round::Round>),
}

/// Outputs of `here`.
fn here_outputs(staged: &mut Staged, outcome: kit::here::State) -> Result<(), Fault> {
    let kit::here::State::Done { place } = outcome;
    staged.place = Some(Object::new(place));
    Ok(())
}

/// Inputs of `first`.
fn first<'a>(config: &'a Config) -> Result<kit::seek::Inputs<'a>, Fault> {
    Ok(kit::seek::Inputs {
        name: "home",
        side: crate::kit::templates::Side::Right,
        r#where: config.place()?,
        tries: 3,
    })
}

/// Live inputs of `first`.
fn first_live(config: &Config) -> Result<kit::seek::Live, Fault> {
    Ok(kit::seek::Live {
        speed: Speed::from_si(0.1),
        r#loop: config.flag(),
    })
}

/// Outputs of `first`.
fn first_outputs(staged: &mut Staged, outcome: kit::seek::State) -> Result<(), Fault> {
    if let kit::seek::State::Found { place, .. } = outcome {
        staged.found = Some(Object::new(place));
    }
    Ok(())
}

/// Where the ids of `round` begin.
const ROUND_PLACE: Child = Child {
    components: 10,
    entries: 15,
};

/// Inputs of `round`.
fn round(config: &Config, to: &mut super::round::Config) -> Result<(), Fault> {
    to.rounds.set(int_sub(int_mul(config.count(), 2)?, int_neg(3)?)?);
    to.label.set(config.text.get().clone());
    to.here.set(config.place.get().clone());
    to.pace.set(finite(config.speed() * config.half())?);
    Ok(())
}

/// Results of `round`.
fn round_outputs(staged: &mut Staged, from: &super::round::Config) -> Result<(), Fault> {
    if let Some(value) = from.turned.value() {
        staged.turn = Some(finite(*value)?);
    }
    if let Some(value) = from.size.value() {
        staged.size = Some(finite(*value)?);
    }
    if let Some(value) = from.text.value() {
        staged.text = Some(value.clone());
    }
    Ok(())
}

/// Inputs of `assign`.
fn assign(config: &Config) -> Result<std_templates::assign::Inputs<f64>, Fault> {
    Ok(std_templates::assign::Inputs {
        value: config.turn() / Angle::from_si(1.0),
    })
}

/// Outputs of `assign`.
fn assign_outputs(
    staged: &mut Staged,
    outcome: std_templates::assign::State<f64>,
) -> Result<(), Fault> {
    let std_templates::assign::State::Done { result } = outcome;
    staged.turns = Some(finite(result)?);
    Ok(())
}

/// Inputs of `compare`.
fn compare(config: &Config) -> Result<std_templates::compare::Inputs<Length>, Fault> {
    Ok(std_templates::compare::Inputs {
        left: -config.dist(),
        right: Length::from_si(config.size().si() / config.dist().si()),
    })
}

/// Where the ids of `again` begin.
const AGAIN_PLACE: Child = Child {
    components: 14,
    entries: 24,
};

/// Inputs of `again`.
fn again(config: &Config, to: &mut super::round::Config) -> Result<(), Fault> {
    to.rounds.set(bool_to_int(config.flag()));
    to.label.set(Text::try_from("round")?);
    to.here.set(config.place.get().clone());
    to.pace
        .set(
            finite(
                Speed::from_si(
                    parse_quantity(
                        join(config.text(), "/s")?.as_str(),
                        super::units::SPEED.iter().copied(),
                    )?,
                ),
            )?,
        );
    Ok(())
}

/// Results of `again`.
fn again_outputs(staged: &mut Staged, from: &super::round::Config) -> Result<(), Fault> {
    if let Some(value) = from.turned.value() {
        staged.text = Some(print_quantity(value.si(), "rad")?);
    }
    if let Some(value) = from.size.value() {
        staged.text2 = Some(print_quantity(value.si(), "m^2")?);
    }
    Ok(())
}

/// Inputs of `show`.
fn show(config: &Config) -> Result<std_templates::log::Inputs<Text>, Fault> {
    Ok(std_templates::log::Inputs {
        value: join(
            join(
                    join(
                            join(
                                    join(
                                            "at ",
                                            print_quantity(config.dist().si(), "m")?.as_str(),
                                        )?
                                        .as_str(),
                                    ", ",
                                )?
                                .as_str(),
                            print_choice(config.side())?.as_str(),
                        )?
                        .as_str(),
                    Text::print(config.flag())?.as_str(),
                )?
                .as_str(),
            print_quantity(config.half(), "")?.as_str(),
        )?,
    })
}

// **** Supervisors ****

const WILD: u16 = 0;
const NEAR: u16 = 1;
const FIRST_WATCH: u16 = 2;

/// The supervisors, each while it watches.
#[derive(Clone, Default)]
struct Supervisors {
    // global supervisor wild: Watch
    wild: Option<crate::kit::Watch<super::enums::Mood>>,
    // global supervisor near: CheckValue
    near: Option<afp_std::CheckValue<Length>>,
    // local supervisor first.watch: Watch
    first_watch: Option<crate::kit::Watch<Text>>,
}

/// Inputs of `wild`.
fn wild<'a>(
    config: &'a Config,
    text_1: &'a mut Text,
) -> Result<kit::watch::Inputs<'a>, Fault> {
    Ok(kit::watch::Inputs {
        label: hold(text_1, join(config.text(), print_choice(config.mood())?.as_str())?),
    })
}

/// Live inputs of `wild`.
fn wild_live(config: &Config) -> Result<kit::watch::Live<super::enums::Mood>, Fault> {
    Ok(kit::watch::Live {
        value: config.mood(),
    })
}

/// Outputs of `wild`.
fn wild_outputs(
    staged: &mut Staged,
    outcome: kit::watch::Event<super::enums::Mood>,
) -> Result<(), Fault> {
    match outcome {
        kit::watch::Event::Changed { seen, side } => {
            staged.mood = Some(seen);
            staged.side = Some(side);
        }
        kit::watch::Event::Same { side } => {
            staged.side = Some(side);
        }
    }
    Ok(())
}

/// Live inputs of `near`.
fn near_live(
    config: &Config,
) -> Result<std_templates::check_value::Live<Length>, Fault> {
    Ok(std_templates::check_value::Live {
        value: config.dist(),
        limit: Length::from_si(
            parse_quantity(config.text(), super::units::LENGTH.iter().copied())?,
        ),
    })
}

/// Inputs of `first.watch`.
fn first_watch<'a>(config: &'a Config) -> Result<kit::watch::Inputs<'a>, Fault> {
    Ok(kit::watch::Inputs {
        label: config.text(),
    })
}

/// Live inputs of `first.watch`.
fn first_watch_live(config: &Config) -> Result<kit::watch::Live<Text>, Fault> {
    Ok(kit::watch::Live {
        value: config.text.get().clone(),
    })
}

/// Outputs of `first.watch`.
fn first_watch_outputs(
    staged: &mut Staged,
    outcome: kit::watch::Event<Text>,
) -> Result<(), Fault> {
    if let kit::watch::Event::Changed { seen, .. } = outcome {
        staged.text = Some(seen);
    }
    Ok(())
}

// **** Plan ****

/// Every kind of entry and formula.
#[derive(Clone, Default)]
pub struct Everything {
    pub(super) config: Config,
    staged: Staged,
    active: Active,
    supervisors: Supervisors,
}

/// The configuration.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// `var mood: Mood`
    pub mood: Entry<super::enums::Mood>,
    /// `in speed: speed`
    pub speed: Entry<Speed>,
    /// `in far: length^2/duration`
    pub far: Entry<Quantity<2, 0, -1, 0, 0, 0>>,
    /// `var place: Place`
    pub place: Entry<Object<crate::kit::Place>>,
    /// `var found: Place`
    pub found: Entry<Object<crate::kit::Place>>,
    /// `var side: Side`
    pub side: Entry<crate::kit::templates::Side>,
    /// `var turn: angle`
    pub turn: Entry<Angle>,
    /// `var turns: float`
    pub turns: Entry<f64>,
    /// `var size: length^2`
    pub size: Entry<Quantity<2, 0, 0, 0, 0, 0>>,
    /// `var text: string`
    pub text: Entry<Text>,
    /// `var text2: string`
    pub text2: Entry<Text>,
    /// `var dist: length`
    pub dist: Entry<Length>,
    /// `var flag: bool`
    pub flag: Entry<bool>,
    /// `var count: int`
    pub count: Entry<i64>,
    /// `const half: float`
    pub half: Entry<f64>,
}

/// What the next commit writes.
#[derive(Clone, Default)]
struct Staged {
    mood: Option<super::enums::Mood>,
    speed: Option<Speed>,
    far: Option<Quantity<2, 0, -1, 0, 0, 0>>,
    place: Option<Object<crate::kit::Place>>,
    found: Option<Object<crate::kit::Place>>,
    side: Option<crate::kit::templates::Side>,
    turn: Option<Angle>,
    turns: Option<f64>,
    size: Option<Quantity<2, 0, 0, 0, 0, 0>>,
    text: Option<Text>,
    text2: Option<Text>,
    dist: Option<Length>,
    flag: Option<bool>,
    count: Option<i64>,
}

impl Config {
    /// The value of `mood`.
    #[inline]
    pub fn mood(&self) -> super::enums::Mood {
        *self.mood.get()
    }

    /// The value of `speed`.
    #[inline]
    pub fn speed(&self) -> Speed {
        *self.speed.get()
    }

    /// The value of `place`.
    #[inline]
    pub fn place(&self) -> Result<&crate::kit::Place, Fault> {
        self.place.get().get()
    }

    /// The value of `side`.
    #[inline]
    pub fn side(&self) -> crate::kit::templates::Side {
        *self.side.get()
    }

    /// The value of `turn`.
    #[inline]
    pub fn turn(&self) -> Angle {
        *self.turn.get()
    }

    /// The value of `size`.
    #[inline]
    pub fn size(&self) -> Quantity<2, 0, 0, 0, 0, 0> {
        *self.size.get()
    }

    /// The value of `text`.
    #[inline]
    pub fn text(&self) -> &str {
        self.text.get().as_str()
    }

    /// The value of `dist`.
    #[inline]
    pub fn dist(&self) -> Length {
        *self.dist.get()
    }

    /// The value of `flag`.
    #[inline]
    pub fn flag(&self) -> bool {
        *self.flag.get()
    }

    /// The value of `count`.
    #[inline]
    pub fn count(&self) -> i64 {
        *self.count.get()
    }

    /// The value of `half`.
    #[inline]
    pub fn half(&self) -> f64 {
        *self.half.get()
    }
}

impl Everything {
    /// The plan, not yet started.
    pub fn new() -> Self {
        Self::default()
    }

    /// `var mood: Mood`
    ///
    /// `None` while nobody has written it.
    pub fn mood(&self) -> Option<super::enums::Mood> {
        self.config.mood.value().copied()
    }

    /// `in speed: speed`
    ///
    /// `None` while nobody has written it.
    pub fn speed(&self) -> Option<Speed> {
        self.config.speed.value().copied()
    }

    /// Sets `speed` before the start.
    ///
    /// # Errors
    /// [`WriteError::NotFinite`].
    pub fn set_speed(&mut self, value: Speed) -> Result<(), WriteError> {
        let value = finite(value).map_err(|_| WriteError::NotFinite)?;
        self.config.speed.set(value);
        Ok(())
    }

    /// `in far: length^2/duration`
    ///
    /// `None` while nobody has written it.
    pub fn far(&self) -> Option<Quantity<2, 0, -1, 0, 0, 0>> {
        self.config.far.value().copied()
    }

    /// Sets `far` before the start.
    ///
    /// # Errors
    /// [`WriteError::NotFinite`].
    pub fn set_far(
        &mut self,
        value: Quantity<2, 0, -1, 0, 0, 0>,
    ) -> Result<(), WriteError> {
        let value = finite(value).map_err(|_| WriteError::NotFinite)?;
        self.config.far.set(value);
        Ok(())
    }

    /// `var place: Place`
    ///
    /// `None` while nobody has written it.
    pub fn place(&self) -> Option<&crate::kit::Place> {
        self.config.place.value().and_then(|object| object.get().ok())
    }

    /// `var found: Place`
    ///
    /// `None` while nobody has written it.
    pub fn found(&self) -> Option<&crate::kit::Place> {
        self.config.found.value().and_then(|object| object.get().ok())
    }

    /// `var side: Side`
    ///
    /// `None` while nobody has written it.
    pub fn side(&self) -> Option<crate::kit::templates::Side> {
        self.config.side.value().copied()
    }

    /// `var turn: angle`
    ///
    /// `None` while nobody has written it.
    pub fn turn(&self) -> Option<Angle> {
        self.config.turn.value().copied()
    }

    /// `var turns: float`
    ///
    /// `None` while nobody has written it.
    pub fn turns(&self) -> Option<f64> {
        self.config.turns.value().copied()
    }

    /// `var size: length^2`
    ///
    /// `None` while nobody has written it.
    pub fn size(&self) -> Option<Quantity<2, 0, 0, 0, 0, 0>> {
        self.config.size.value().copied()
    }

    /// `var text: string`
    ///
    /// `None` while nobody has written it.
    pub fn text(&self) -> Option<&str> {
        self.config.text.value().map(|text| text.as_str())
    }

    /// `var text2: string`
    ///
    /// `None` while nobody has written it.
    pub fn text2(&self) -> Option<&str> {
        self.config.text2.value().map(|text| text.as_str())
    }

    /// `var dist: length`
    ///
    /// `None` while nobody has written it.
    pub fn dist(&self) -> Option<Length> {
        self.config.dist.value().copied()
    }

    /// `var flag: bool`
    ///
    /// `None` while nobody has written it.
    pub fn flag(&self) -> Option<bool> {
        self.config.flag.value().copied()
    }

    /// `var count: int`
    ///
    /// `None` while nobody has written it.
    pub fn count(&self) -> Option<i64> {
        self.config.count.value().copied()
    }

    /// `const half: float`
    ///
    /// `None` while nobody has written it.
    pub fn half(&self) -> Option<f64> {
        self.config.half.value().copied()
    }
}

impl PlanState for Everything {
    type Tables = Rules;
    type Slots = [Slot; 3];

    #[inline]
    fn tables(&self) -> Rules {
        Rules
    }

    #[inline(always)]
    fn at_element<A: AtElement>(element: u16, run: A) -> A::Out {
        match element {
            FIRST => run.at::<{ FIRST }>(),
            ROUND => run.at::<{ ROUND }>(),
            AGAIN => run.at::<{ AGAIN }>(),
            _ => run.unknown(),
        }
    }

    fn try_clone(&self) -> Option<Self> {
        Some(self.clone())
    }

    fn slots(&self) -> [Slot; 3] {
        [Slot::default(); 3]
    }

    fn missing_input(&self) -> Option<u16> {
        if !self.config.speed.is_set() {
            return Some(1);
        }
        None
    }

    fn initialise(&mut self) -> Result<(), Fault> {
        let config = &mut self.config;
        config.mood.clear();
        config.place.clear();
        config.found.clear();
        config.side.clear();
        config.turn.clear();
        config.turns.clear();
        config.size.clear();
        config.text.clear();
        config.text2.clear();
        config.dist.clear();
        config.flag.clear();
        config.count.clear();
        config.half.clear();
        let value = finite(1.0 / 2.0)?;
        config.half.set(value);
        if !config.far.is_set() {
            config.far.set(<Quantity<2, 0, -1, 0, 0, 0>>::from_si(1.0));
        }
        config.mood.set(super::enums::Mood::Wild);
        config.side.set(crate::kit::templates::Side::Left);
        config.turn.set(Angle::from_deg(0.0));
        let value = finite(
            <Quantity<
                2,
                0,
                0,
                0,
                0,
                0,
            >>::from_si(Length::from_si(0.0).si() * Length::from_si(1.0).si()),
        )?;
        config.size.set(value);
        config.text.set(Text::try_from("12 cm")?);
        config.dist.set(Length::from_si(3.0));
        config.flag.set(true);
        config.count.set(0);
        Ok(())
    }

    fn entry(&self, entry: u16) -> ValueRef<'_> {
        match entry {
            0 => self.config.mood.as_value(),
            1 => self.config.speed.as_value(),
            2 => self.config.far.as_value(),
            3 => self.config.place.as_value(),
            4 => self.config.found.as_value(),
            5 => self.config.side.as_value(),
            6 => self.config.turn.as_value(),
            7 => self.config.turns.as_value(),
            8 => self.config.size.as_value(),
            9 => self.config.text.as_value(),
            10 => self.config.text2.as_value(),
            11 => self.config.dist.as_value(),
            12 => self.config.flag.as_value(),
            13 => self.config.count.as_value(),
            14 => self.config.half.as_value(),
            _ => ValueRef::Unset,
        }
    }

    fn accepts(&self, entry: u16, value: &Value) -> Result<(), WriteError> {
        match entry {
            0 => WriteError::check::<super::enums::Mood>(value),
            1 => WriteError::check::<Speed>(value),
            2 => WriteError::check::<Quantity<2, 0, -1, 0, 0, 0>>(value),
            3 => Err(WriteError::Type),
            4 => Err(WriteError::Type),
            5 => WriteError::check::<crate::kit::templates::Side>(value),
            6 => WriteError::check::<Angle>(value),
            7 => WriteError::check::<f64>(value),
            8 => WriteError::check::<Quantity<2, 0, 0, 0, 0, 0>>(value),
            9 => WriteError::check::<Text>(value),
            10 => WriteError::check::<Text>(value),
            11 => WriteError::check::<Length>(value),
            12 => WriteError::check::<bool>(value),
            13 => WriteError::check::<i64>(value),
            14 => Err(WriteError::ReadOnly),
            _ => Err(WriteError::Unknown),
        }
    }

    fn stage(&mut self, entry: u16, value: &Value) {
        match entry {
            0 => stage_outside(&mut self.staged.mood, value),
            1 => stage_outside(&mut self.staged.speed, value),
            2 => stage_outside(&mut self.staged.far, value),
            5 => stage_outside(&mut self.staged.side, value),
            6 => stage_outside(&mut self.staged.turn, value),
            7 => stage_outside(&mut self.staged.turns, value),
            8 => stage_outside(&mut self.staged.size, value),
            9 => stage_outside(&mut self.staged.text, value),
            10 => stage_outside(&mut self.staged.text2, value),
            11 => stage_outside(&mut self.staged.dist, value),
            12 => stage_outside(&mut self.staged.flag, value),
            13 => stage_outside(&mut self.staged.count, value),
            _ => {}
        }
    }

    #[inline]
    fn commit<S: Sink>(&mut self, to: &mut Committer<'_, S>) {
        if let Some(value) = self.staged.mood.take() {
            to.write(0, &mut self.config.mood, value);
        }
        if let Some(value) = self.staged.speed.take() {
            to.write(1, &mut self.config.speed, value);
        }
        if let Some(value) = self.staged.far.take() {
            to.write(2, &mut self.config.far, value);
        }
        if let Some(value) = self.staged.place.take() {
            to.write(3, &mut self.config.place, value);
        }
        if let Some(value) = self.staged.found.take() {
            to.write(4, &mut self.config.found, value);
        }
        if let Some(value) = self.staged.side.take() {
            to.write(5, &mut self.config.side, value);
        }
        if let Some(value) = self.staged.turn.take() {
            to.write(6, &mut self.config.turn, value);
        }
        if let Some(value) = self.staged.turns.take() {
            to.write(7, &mut self.config.turns, value);
        }
        if let Some(value) = self.staged.size.take() {
            to.write(8, &mut self.config.size, value);
        }
        if let Some(value) = self.staged.text.take() {
            to.write(9, &mut self.config.text, value);
        }
        if let Some(value) = self.staged.text2.take() {
            to.write(10, &mut self.config.text2, value);
        }
        if let Some(value) = self.staged.dist.take() {
            to.write(11, &mut self.config.dist, value);
        }
        if let Some(value) = self.staged.flag.take() {
            to.write(12, &mut self.config.flag, value);
        }
        if let Some(value) = self.staged.count.take() {
            to.write(13, &mut self.config.count, value);
        }
    }

    #[inline]
    fn discard(&mut self) {
        self.staged = Staged::default();
    }
}

impl<E> Plan<E> for Everything
where
    E: Environment + ?Sized,
    crate::kit::Seek: Actor<kit::Seek, E>,
    super::round::Round: Plan<E>,
    crate::kit::Watch<super::enums::Mood>: Supervisor<kit::Watch<super::enums::Mood>, E>,
    afp_std::CheckValue<Length>: Supervisor<std_templates::CheckValue<Length>, E>,
    crate::kit::Watch<Text>: Supervisor<kit::Watch<Text>, E>,
{
    fn start_supervisor<S: Sink, C: Clock>(
        &mut self,
        supervisor: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), Fault> {
        match supervisor {
            WILD => {
                let mut text_1 = Text::new();
                let inputs = wild(&self.config, &mut text_1);
                self.supervisors.wild = cx
                    .start_supervisor(inputs, Events::from_bits(0b1))?;
            }
            NEAR => {
                let inputs = Ok(std_templates::check_value::Inputs {});
                self.supervisors.near = cx
                    .start_supervisor(inputs, Events::from_bits(0b1))?;
            }
            FIRST_WATCH => {
                let inputs = first_watch(&self.config);
                self.supervisors.first_watch = cx
                    .start_supervisor(inputs, Events::from_bits(0b1))?;
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
            WILD => {
                let live = wild_live(&self.config);
                let watch = &mut self.supervisors.wild;
                Fired::supervisor(
                    cx.poll_supervisor(watch, live),
                    |outcome| wild_outputs(&mut self.staged, outcome),
                )
            }
            NEAR => {
                let live = near_live(&self.config);
                let watch = &mut self.supervisors.near;
                Fired::supervisor(cx.poll_supervisor(watch, live), |_| Ok(()))
            }
            FIRST_WATCH => {
                let live = first_watch_live(&self.config);
                let watch = &mut self.supervisors.first_watch;
                Fired::supervisor(
                    cx.poll_supervisor(watch, live),
                    |outcome| first_watch_outputs(&mut self.staged, outcome),
                )
            }
            _ => Fired::fault(Fault::INTERNAL),
        }
    }

    fn start_element<S: Sink, C: Clock>(
        &mut self,
        element: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Started {
        let started: Result<Active, Fault> = match element {
            HERE => {
                let computed = cx
                    .compute::<kit::Here, crate::kit::Here>(Ok(kit::here::Inputs {}));
                return Started::computed(
                    computed,
                    |outcome| here_outputs(&mut self.staged, outcome),
                );
            }
            FIRST => cx.start_actor(first(&self.config)).map(Active::First),
            ROUND => {
                let mut plan = super::round::Round::new();
                if let Err(fault) = round(&self.config, &mut plan.config) {
                    return Started::Failed(fault);
                }
                let mut machine = Machine::new(plan);
                let flow = cx.start_sub_plan(ROUND_PLACE, &mut machine);
                let started = Started::sub_plan(
                    flow,
                    || round_outputs(&mut self.staged, &machine.plan().config),
                );
                self.active = Active::Round(machine);
                return started;
            }
            ASSIGN => {
                let computed = cx
                    .compute::<
                        std_templates::Assign<f64>,
                        afp_std::Assign<f64>,
                    >(assign(&self.config));
                return Started::computed(
                    computed,
                    |outcome| assign_outputs(&mut self.staged, outcome),
                );
            }
            COMPARE => {
                let computed = cx
                    .compute::<
                        std_templates::Compare<Length>,
                        afp_std::Compare<Length>,
                    >(compare(&self.config));
                return Started::computed(computed, |_| Ok(()));
            }
            AGAIN => {
                let mut plan = super::round::Round::new();
                if let Err(fault) = again(&self.config, &mut plan.config) {
                    return Started::Failed(fault);
                }
                let mut machine = Machine::new(plan);
                let flow = cx.start_sub_plan(AGAIN_PLACE, &mut machine);
                let started = Started::sub_plan(
                    flow,
                    || again_outputs(&mut self.staged, &machine.plan().config),
                );
                self.active = Active::Again(machine);
                return started;
            }
            SHOW => {
                let computed = cx
                    .compute::<
                        std_templates::Log<Text>,
                        afp_std::Log<Text>,
                    >(show(&self.config));
                return Started::computed(computed, |_| Ok(()));
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
    fn poll_element<S: Sink, C: Clock>(
        &mut self,
        _: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Polled {
        match &mut self.active {
            Active::None => Polled::Failed(Fault::INTERNAL),
            Active::First(actor) => {
                let live = first_live(&self.config);
                Polled::actor(
                    cx.poll_actor(actor, live),
                    |outcome| first_outputs(&mut self.staged, outcome),
                )
            }
            Active::Round(machine) => {
                let flow = cx.inside(ROUND_PLACE, |cx| machine.step(cx));
                Polled::sub_plan(
                    flow,
                    || round_outputs(&mut self.staged, &machine.plan().config),
                )
            }
            Active::Again(machine) => {
                let flow = cx.inside(AGAIN_PLACE, |cx| machine.step(cx));
                Polled::sub_plan(
                    flow,
                    || again_outputs(&mut self.staged, &machine.plan().config),
                )
            }
        }
    }

    fn interrupt_element<S: Sink, C: Clock>(
        &mut self,
        _: u16,
        cx: &mut Cx<'_, E, S, C>,
    ) -> Result<(), Fault> {
        match &mut self.active {
            Active::None => Err(Fault::INTERNAL),
            Active::First(actor) => cx.interrupt_actor(actor),
            Active::Round(machine) => cx.inside(ROUND_PLACE, |cx| machine.interrupt(cx)),
            Active::Again(machine) => cx.inside(AGAIN_PLACE, |cx| machine.interrupt(cx)),
        }
    }

    fn leave(&mut self, element: u16) {
        self.active = Active::None;
        match element {
            FIRST => {
                self.supervisors.first_watch = None;
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

/// Where the scheduler reads the rules of the plan.
#[derive(Clone, Copy, Debug)]
pub struct Rules;

impl Tables for Rules {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        PlanTable {
            start: HERE,
            globals: 2,
            entries: 15,
            elements: &ELEMENTS,
            supervisors: &SUPERVISORS,
            edges: &EDGES,
            sweeps: &SWEEPS,
        }
    }
}

/// Where each state and event leads.
static EDGES: [Target; 19] = [
    // here: Done -> first
    Target::Element(FIRST),
    // first: Found -> round
    Target::Element(ROUND),
    // first: Lost -> first
    Target::Element(FIRST),
    // first: Bored -> assign
    Target::Element(ASSIGN),
    // round: OK -> assign
    Target::Element(ASSIGN),
    // round: Interrupted -> compare
    Target::Element(COMPARE),
    // assign: Done -> compare
    Target::Element(COMPARE),
    // compare: Less -> again
    Target::Element(AGAIN),
    // compare: Equal -> first
    Target::Element(FIRST),
    // compare: Greater -> show
    Target::Element(SHOW),
    // again: OK -> show
    Target::Element(SHOW),
    // again: Interrupted -> terminate
    Target::Terminate,
    // show: Done -> first
    Target::Element(FIRST),
    // wild: Changed -> terminate
    Target::Terminate,
    // wild: Same -> ignore
    Target::Ignore,
    // near: Below -> terminate
    Target::Terminate,
    // near: Above -> ignore
    Target::Ignore,
    // first.watch: Changed -> round
    Target::Element(ROUND),
    // first.watch: Same -> ignore
    Target::Ignore,
];

/// The elements.
static ELEMENTS: [ElementRow; 7] = [
    // computation here: Here
    ElementRow {
        kind: ElementKind::Computation,
        period: Duration::ZERO,
        states: Range { first: 0, len: 1 },
        on_error: Target::None,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 0, len: 0 },
        child: Child { components: 0, entries: 0 },
    },
    // actor first: Seek
    ElementRow {
        kind: ElementKind::Actor,
        period: Duration::from_millis(10),
        states: Range { first: 1, len: 3 },
        on_error: Target::None,
        locals: Range { first: 2, len: 1 },
        sweep: Range { first: 0, len: 3 },
        child: Child { components: 0, entries: 0 },
    },
    // subplan round: Round
    ElementRow {
        kind: ElementKind::SubPlan,
        period: Duration::ZERO,
        states: Range { first: 4, len: 2 },
        on_error: Target::Element(FIRST),
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 3, len: 2 },
        child: ROUND_PLACE,
    },
    // computation assign: Assign
    ElementRow {
        kind: ElementKind::Computation,
        period: Duration::ZERO,
        states: Range { first: 6, len: 1 },
        on_error: Target::None,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 5, len: 0 },
        child: Child { components: 0, entries: 0 },
    },
    // computation compare: Compare
    ElementRow {
        kind: ElementKind::Computation,
        period: Duration::ZERO,
        states: Range { first: 7, len: 3 },
        on_error: Target::None,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 5, len: 0 },
        child: Child { components: 0, entries: 0 },
    },
    // subplan again: Round
    ElementRow {
        kind: ElementKind::SubPlan,
        period: Duration::ZERO,
        states: Range { first: 10, len: 2 },
        on_error: Target::None,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 5, len: 2 },
        child: AGAIN_PLACE,
    },
    // computation show: Log
    ElementRow {
        kind: ElementKind::Computation,
        period: Duration::ZERO,
        states: Range { first: 12, len: 1 },
        on_error: Target::None,
        locals: Range { first: 0, len: 0 },
        sweep: Range { first: 7, len: 0 },
        child: Child { components: 0, entries: 0 },
    },
];

/// The supervisors: global ones, then local ones.
static SUPERVISORS: [SupervisorRow; 3] = [
    // wild: Watch
    SupervisorRow {
        period: Duration::from_millis(5),
        deadline: Duration::from_millis(5),
        budget: Duration::ZERO,
        slot: 0,
        events: Range { first: 13, len: 2 },
        on_miss: Target::None,
        wanted: Events::from_bits(0b1),
    },
    // near: CheckValue
    SupervisorRow {
        period: Duration::from_millis(3),
        deadline: Duration::from_micros(1500),
        budget: Duration::from_micros(5),
        slot: 1,
        events: Range { first: 15, len: 2 },
        on_miss: Target::None,
        wanted: Events::from_bits(0b1),
    },
    // first.watch: Watch
    SupervisorRow {
        period: Duration::from_millis(5),
        deadline: Duration::from_millis(5),
        budget: Duration::ZERO,
        slot: 2,
        events: Range { first: 17, len: 2 },
        on_miss: Target::None,
        wanted: Events::from_bits(0b1),
    },
];

/// Who is polled while an element is active, in order.
static SWEEPS: [u16; 7] = [
    // while first is active
    NEAR,
    WILD,
    FIRST_WATCH,
    // while round is active
    NEAR,
    WILD,
    // while again is active
    NEAR,
    WILD,
];

// **** Names ****

/// The names behind the ids of a trace.
pub static NAMES: NameTable = NameTable {
    components: &[
        ComponentRow::new("Everything", Kind::Plan, "Everything", &[], "", &[]),
        ComponentRow::new(
            "here",
            Kind::Computation,
            "Here",
            &[("Done", "first")],
            "",
            &[],
        ),
        ComponentRow::new(
            "first",
            Kind::Actor,
            "Seek",
            &[("Found", "round"), ("Lost", "first"), ("Bored", "assign")],
            "",
            &["name", "side", "where", "speed", "loop", "tries"],
        ),
        ComponentRow::new(
            "round",
            Kind::SubPlan,
            "Round",
            &[("OK", "assign"), ("Interrupted", "compare")],
            "first",
            &["rounds", "label", "here", "pace"],
        ),
        ComponentRow::new(
            "assign",
            Kind::Computation,
            "Assign",
            &[("Done", "compare")],
            "",
            &["value"],
        ),
        ComponentRow::new(
            "compare",
            Kind::Computation,
            "Compare",
            &[("Less", "again"), ("Equal", "first"), ("Greater", "show")],
            "",
            &["left", "right"],
        ),
        ComponentRow::new(
            "again",
            Kind::SubPlan,
            "Round",
            &[("OK", "show"), ("Interrupted", "terminate")],
            "",
            &["rounds", "label", "here", "pace"],
        ),
        ComponentRow::new(
            "show",
            Kind::Computation,
            "Log",
            &[("Done", "first")],
            "",
            &["value"],
        ),
        ComponentRow::new(
            "wild",
            Kind::Supervisor,
            "Watch",
            &[("Changed", "terminate"), ("Same", "ignore")],
            "",
            &["value", "label"],
        ),
        ComponentRow::new(
            "near",
            Kind::Supervisor,
            "CheckValue",
            &[("Below", "terminate"), ("Above", "ignore")],
            "",
            &["value", "limit"],
        ),
        ComponentRow::new(
            "first.watch",
            Kind::Supervisor,
            "Watch",
            &[("Changed", "round"), ("Same", "ignore")],
            "",
            &["value", "label"],
        ),
        ComponentRow::new(
            "round.loop",
            Kind::Computation,
            "Count",
            &[("Again", "seek"), ("Done", "area")],
            "",
            &["value", "limit"],
        ),
        ComponentRow::new(
            "round.seek",
            Kind::Actor,
            "Seek",
            &[("Found", "loop"), ("Lost", "terminate"), ("Bored", "loop")],
            "terminate",
            &["name", "side", "where", "speed", "loop", "tries"],
        ),
        ComponentRow::new(
            "round.area",
            Kind::Computation,
            "Area",
            &[("Small", "terminate"), ("Large", "loop")],
            "",
            &["width", "height"],
        ),
        ComponentRow::new(
            "round.seek.watch",
            Kind::Supervisor,
            "Watch",
            &[("Changed", "ignore"), ("Same", "loop")],
            "terminate",
            &["value", "label"],
        ),
        ComponentRow::new(
            "again.loop",
            Kind::Computation,
            "Count",
            &[("Again", "seek"), ("Done", "area")],
            "",
            &["value", "limit"],
        ),
        ComponentRow::new(
            "again.seek",
            Kind::Actor,
            "Seek",
            &[("Found", "loop"), ("Lost", "terminate"), ("Bored", "loop")],
            "terminate",
            &["name", "side", "where", "speed", "loop", "tries"],
        ),
        ComponentRow::new(
            "again.area",
            Kind::Computation,
            "Area",
            &[("Small", "terminate"), ("Large", "loop")],
            "",
            &["width", "height"],
        ),
        ComponentRow::new(
            "again.seek.watch",
            Kind::Supervisor,
            "Watch",
            &[("Changed", "ignore"), ("Same", "loop")],
            "terminate",
            &["value", "label"],
        ),
    ],
    entries: &[
        EntryRow::new("mood", EntryKind::Var, "Mood", "", &["calm", "wild"]),
        EntryRow::new("speed", EntryKind::In, "speed", "m/s", &[]),
        EntryRow::new("far", EntryKind::In, "length^2/duration", "m^2/s", &[]),
        EntryRow::new("place", EntryKind::Var, "Place", "", &[]),
        EntryRow::new("found", EntryKind::Var, "Place", "", &[]),
        EntryRow::new("side", EntryKind::Var, "Side", "", &["left", "right"]),
        EntryRow::new("turn", EntryKind::Var, "angle", "rad", &[]),
        EntryRow::new("turns", EntryKind::Var, "float", "", &[]),
        EntryRow::new("size", EntryKind::Var, "length^2", "m^2", &[]),
        EntryRow::new("text", EntryKind::Var, "string", "", &[]),
        EntryRow::new("text2", EntryKind::Var, "string", "", &[]),
        EntryRow::new("dist", EntryKind::Var, "length", "m", &[]),
        EntryRow::new("flag", EntryKind::Var, "bool", "", &[]),
        EntryRow::new("count", EntryKind::Var, "int", "", &[]),
        EntryRow::new("half", EntryKind::Const, "float", "", &[]),
        EntryRow::new("round.rounds", EntryKind::In, "int", "", &[]),
        EntryRow::new("round.label", EntryKind::In, "string", "", &[]),
        EntryRow::new("round.here", EntryKind::In, "Place", "", &[]),
        EntryRow::new("round.pace", EntryKind::In, "speed", "m/s", &[]),
        EntryRow::new("round.i", EntryKind::Var, "int", "", &[]),
        EntryRow::new("round.turned", EntryKind::Out, "angle", "rad", &[]),
        EntryRow::new("round.size", EntryKind::Out, "length^2", "m^2", &[]),
        EntryRow::new("round.text", EntryKind::Out, "string", "", &[]),
        EntryRow::new("round.wide", EntryKind::Const, "length", "m", &[]),
        EntryRow::new("again.rounds", EntryKind::In, "int", "", &[]),
        EntryRow::new("again.label", EntryKind::In, "string", "", &[]),
        EntryRow::new("again.here", EntryKind::In, "Place", "", &[]),
        EntryRow::new("again.pace", EntryKind::In, "speed", "m/s", &[]),
        EntryRow::new("again.i", EntryKind::Var, "int", "", &[]),
        EntryRow::new("again.turned", EntryKind::Out, "angle", "rad", &[]),
        EntryRow::new("again.size", EntryKind::Out, "length^2", "m^2", &[]),
        EntryRow::new("again.text", EntryKind::Out, "string", "", &[]),
        EntryRow::new("again.wide", EntryKind::Const, "length", "m", &[]),
    ],
};

impl NamedPlan for Everything {
    type Names = NameTable;

    fn names(&self) -> NameTable {
        NAMES
    }

    fn set_input(&mut self, entry: u16, value: &Value) -> Result<(), WriteError> {
        self.accepts(entry, value)?;
        match entry {
            1 => set_input(&mut self.config.speed, value),
            2 => set_input(&mut self.config.far, value),
            _ => Err(WriteError::ReadOnly),
        }
    }

    fn units(&self, entry: u16) -> impl Iterator<Item = Unit<'_>> {
        let units: &[Unit<'static>] = match entry {
            1 => &super::units::SPEED,
            2 => &super::units::LENGTH2_PER_DURATION,
            6 => &super::units::ANGLE,
            8 => &super::units::LENGTH2,
            11 => &super::units::LENGTH,
            _ => &[],
        };
        units.iter().copied()
    }
}
