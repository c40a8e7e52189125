//! A robot that rolls along a line, with a bumper and two things that break.

use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use afp::load::{LoadedPlan, Registry};
use afp_core::devices::{
    AmountRow, ControlId, ControlRow, DeviceRow, Devices, FaultId, FaultRow, SignalId, SignalRow,
    SignalType, faults,
};
use afp_core::{
    Actor, Duration, Environment, Events, Fault, Instant, Platform, Poll, StillClock, Supervisor,
};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_session::{
    Active, Figure, FigureValue, Hardware, Pose2, Refused, Robot, SampleRef, Samples, Settings,
    Transform,
};
use afp_syntax::source::Source;

mod templates {
    afp_macros::toolbox!("tests/toy.afp", robot: super::Rolls);
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToyFault {
    Lost,
    Slip(f64),
}

pub struct ToyDevices;

pub const POSITION: SignalId = SignalId(0);
pub const TOUCHED: SignalId = SignalId(1);

impl Devices for ToyDevices {
    const TABLE: &'static [DeviceRow] = &[
        DeviceRow {
            name: "motor",
            help: "the only one",
            controls: &[],
            faults: &[FaultRow {
                name: "slip",
                amount: Some(AmountRow {
                    name: "share",
                    unit: "",
                    default: 0.5,
                    from: 0.0,
                    to: 1.0,
                }),
                help: "this share of the way is left",
            }],
            signals: &[SignalRow { name: "pose", ty: SignalType::Pose, truth: true, help: "" }],
        },
        DeviceRow {
            name: "bumper",
            help: "in front",
            controls: &[ControlRow { name: "front", help: "", stops: false }],
            faults: &[FaultRow { name: "lost", amount: None, help: "it is never touched" }],
            signals: &[SignalRow { name: "touched", ty: SignalType::Bool, truth: false, help: "" }],
        },
        DeviceRow {
            name: "horn",
            help: "others have one",
            controls: &[ControlRow { name: "honk", help: "", stops: false }],
            faults: &[],
            signals: &[],
        },
    ];
    type Control = ();
    type Fault = ToyFault;

    fn control(id: ControlId) -> Option<()> {
        (id == ControlId(0)).then_some(())
    }

    fn fault(id: FaultId, amount: Option<f64>) -> Option<ToyFault> {
        let (_, _, row) = faults(Self::TABLE).find(|(known, ..)| *known == id)?;
        match row.amount {
            Some(of) => of.checked(amount).map(ToyFault::Slip),
            None => Some(ToyFault::Lost),
        }
    }
}

#[derive(Default)]
pub struct Toy {
    now: Instant,
    speed: f64,
    pub position: f64,
    pressed: bool,
    lost: bool,
    grip: f64,
    /// The time at which its clock stops.
    pub stuck_from: Option<Instant>,
    /// The first `advance` to this instant or later takes longer by the duration.
    pub held_up: Option<(Instant, Duration)>,
    /// From this time on, it gives a text for the bumper signal.
    pub wordy_from: Option<Instant>,
    /// Counts emergency stops; shared, to be read after the robot is dropped.
    pub stops: Arc<AtomicU64>,
}

impl Toy {
    pub fn new() -> Self {
        Toy { grip: 1.0, ..Toy::default() }
    }

    /// Whether the bumper is pressed.
    pub fn is_pressed(&self) -> bool {
        self.pressed
    }

    /// A robot whose time does not begin at zero.
    pub fn at(now: Instant) -> Self {
        Toy { now, ..Toy::new() }
    }
}

impl Environment for Toy {
    fn stop(&mut self, _: Instant) {
        self.speed = 0.0;
    }

    fn emergency_stop(&mut self) {
        self.speed = 0.0;
        self.stops.fetch_add(1, Ordering::Relaxed);
    }
}

impl Platform for Toy {
    type Clock = StillClock;

    fn clock(&self) -> StillClock {
        StillClock
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn advance(&mut self, to: Instant) {
        if self.stuck_from.is_some_and(|from| self.now >= from) {
            return;
        }
        self.position += self.speed * self.grip * to.since(self.now).as_secs_f64();
        self.now = self.now.max(to);
        if let Some((_, late)) = self.held_up.take_if(|(from, _)| *from <= to) {
            self.now += late;
        }
    }
}

impl Robot for Toy {
    type Devices = ToyDevices;
    const LACKS: &'static [&'static str] = &["horn"];

    fn press(&mut self, (): (), held: bool) -> Result<(), Refused> {
        self.pressed = held;
        Ok(())
    }

    fn set_faults(&mut self, active: &Active<'_, ToyFault>) -> Result<(), Refused> {
        self.lost = active.any(|fault| fault == ToyFault::Lost);
        let slip =
            active.find(|fault| if let ToyFault::Slip(share) = fault { Some(share) } else { None });
        self.grip = slip.unwrap_or(1.0);
        Ok(())
    }

    fn sample(&self, to: &mut Samples<'_, '_>) {
        let pose = Pose2 { x: self.position, ..Pose2::default() };
        let pose = Transform { parent: "world", child: "base_link", pose, height: 0.0 };
        to.put(POSITION, SampleRef::Pose(pose));
        match self.wordy_from {
            Some(from) if self.now >= from => to.put(TOUCHED, SampleRef::Text("oh")),
            _ => to.put(TOUCHED, SampleRef::Bool(self.pressed)),
        }
    }

    fn figures(&self) -> Vec<Figure> {
        let value = FigureValue::Numbers(vec![("way_m", self.position)]);
        vec![Figure { name: "way", value, text: String::new() }]
    }
}

impl Hardware for Toy {
    type Error = Infallible;

    fn open(_: &Settings) -> Result<Self, Infallible> {
        Ok(Toy::new())
    }
}

/// The interface for templates.
pub trait Rolls: Environment {
    fn roll(&mut self, speed: f64);
    fn touched(&self) -> bool;
}

impl Rolls for Toy {
    fn roll(&mut self, speed: f64) {
        self.speed = speed;
    }

    fn touched(&self) -> bool {
        self.pressed && !self.lost
    }
}

#[derive(Clone)]
pub struct Roll {
    since: Instant,
    fragile: bool,
}

impl<E: Rolls + ?Sized> Actor<templates::Roll, E> for Roll {
    fn start(inputs: templates::roll::Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.roll(inputs.speed.si());
        Ok(Roll { since: now, fragile: inputs.fragile })
    }

    fn poll(
        &mut self,
        _: templates::roll::Live,
        _: &mut E,
        now: Instant,
    ) -> Result<Poll<templates::roll::State>, Fault> {
        assert!(!self.fragile || now.since(self.since) < Duration::from_secs(1), "it broke");
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.roll(0.0);
        Ok(())
    }
}

#[derive(Clone)]
pub struct CheckBumper;

impl<E: Rolls + ?Sized> Supervisor<templates::CheckBumper, E> for CheckBumper {
    fn start(_: templates::check_bumper::Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(CheckBumper)
    }

    fn poll(
        &mut self,
        _: templates::check_bumper::Live,
        _: Events,
        env: &mut E,
        _: Instant,
    ) -> Result<Option<templates::check_bumper::Event>, Fault> {
        Ok(env.touched().then_some(templates::check_bumper::Event::Pressed))
    }
}

/// A plan of the toy.
pub fn plan(text: &str) -> LoadedPlan<Toy> {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    toolboxes.add(Source::new("toy.afp", templates::SOURCE), "toy");
    let compiled = compile(&Source::new("plan.afp", text), &toolboxes, &Texts::default());
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let mut registry = Registry::new();
    afp_std::templates::register(&mut registry);
    templates::register(&mut registry);
    LoadedPlan::new(graph, &registry).unwrap()
}
