//! A plan with every kind of port, entry and formula, compiled and run; and the golden cases of the
//! code generator, compiled.

mod kit {
    //! The toolbox of the golden cases, with scripted components.

    use std::collections::VecDeque;
    use std::marker::PhantomData;

    use afp_core::quantity::Angle;
    use afp_core::{
        Actor, Computation, Environment, Events, Fault, Instant, Poll, Supervisor, Text,
    };

    pub mod templates {
        afp_macros::toolbox!("../afp-codegen/tests/codegen/toolbox.afp", robot = super::Script);
    }

    /// The results of the next polls, and the history.
    #[derive(Default)]
    pub struct Script {
        /// The results of the next polls of `Seek`.
        pub seek: VecDeque<Option<templates::seek::State>>,
        /// The history of the components.
        pub told: Vec<String>,
    }

    impl Environment for Script {
        fn stop(&mut self, _: Instant) {
            self.told.push("stop".into());
        }
        fn emergency_stop(&mut self) {
            self.told.push("emergency stop".into());
        }
    }

    /// An object.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Place(pub u8);

    #[derive(Clone)]
    pub struct Seek;

    impl Actor<templates::Seek, Script> for Seek {
        fn start(
            inputs: templates::seek::Inputs<'_>,
            env: &mut Script,
            _: Instant,
        ) -> Result<Self, Fault> {
            let templates::seek::Inputs { name, side, r#where, tries } = inputs;
            env.told.push(format!("seek {name} {side:?} {} {tries}", r#where.0));
            Ok(Seek)
        }

        fn poll(
            &mut self,
            live: templates::seek::Live,
            env: &mut Script,
            _: Instant,
        ) -> Result<Poll<templates::seek::State>, Fault> {
            env.told.push(format!("seek {} {}", live.speed.si(), live.r#loop));
            Ok(match env.seek.pop_front().flatten() {
                Some(state) => Poll::Ready(state),
                None => Poll::Pending,
            })
        }

        fn interrupt(&mut self, env: &mut Script, _: Instant) -> Result<(), Fault> {
            env.told.push("interrupt".into());
            Ok(())
        }
    }

    #[derive(Clone)]
    pub struct Watch<V>(PhantomData<V>);

    impl<V: afp_core::rt::Any> Supervisor<templates::Watch<V>, Script> for Watch<V> {
        fn start(
            inputs: templates::watch::Inputs<'_>,
            env: &mut Script,
            _: Instant,
        ) -> Result<Self, Fault> {
            env.told.push(format!("watch {}", inputs.label));
            Ok(Watch(PhantomData))
        }

        fn poll(
            &mut self,
            _: templates::watch::Live<V>,
            _: Events,
            _: &mut Script,
            _: Instant,
        ) -> Result<Option<templates::watch::Event<V>>, Fault> {
            Ok(None)
        }
    }

    pub struct Area;

    impl Computation<templates::Area> for Area {
        fn compute(inputs: templates::area::Inputs) -> Result<templates::area::State, Fault> {
            let area = inputs.width.si() * inputs.height.si();
            let area = afp_core::quantity::Quantity::from_si(area);
            Ok(templates::area::State::Small { area })
        }
    }

    pub struct Here;

    impl Computation<templates::Here> for Here {
        fn compute(_: templates::here::Inputs) -> Result<templates::here::State, Fault> {
            Ok(templates::here::State::Done { place: Place(1) })
        }
    }

    /// Lost, with its outputs.
    pub fn lost(said: &str, radians: f64) -> templates::seek::State {
        let said = Text::try_from(said).unwrap();
        templates::seek::State::Lost { said, turn: Angle::from_si(radians) }
    }
}

mod plan {
    afp::plan!(
        "tests/everything.afp",
        toolboxes = { "../afp-codegen/tests/codegen/toolbox.afp" => crate::kit }
    );
}

mod vacuum {
    //! A toolbox with only devices.

    afp_macros::toolbox!("../afp-codegen/tests/codegen/devices.afp");
}

mod golden {
    //! The golden cases of the code generator, except the paper's plan: its users compile it.

    macro_rules! cases {
        ($($name:ident $file:literal)*) => {
            pub const ALL: &[&str] = &[$($file),*];
            $(mod $name {
                afp::plan!(
                    $file,
                    toolboxes = { "../afp-codegen/tests/codegen/toolbox.afp" => crate::kit }
                );
            })*
        };
    }

    cases! {
        actor "../afp-codegen/tests/codegen/actor.afp"
        computation "../afp-codegen/tests/codegen/computation.afp"
        conversions "../afp-codegen/tests/codegen/conversions.afp"
        edges "../afp-codegen/tests/codegen/edges.afp"
        entries "../afp-codegen/tests/codegen/entries.afp"
        enums "../afp-codegen/tests/codegen/enums.afp"
        formulas "../afp-codegen/tests/codegen/formulas.afp"
        live_inputs "../afp-codegen/tests/codegen/live_inputs.afp"
        names "../afp-codegen/tests/codegen/names.afp"
        objects "../afp-codegen/tests/codegen/objects.afp"
        on "../afp-codegen/tests/codegen/on.afp"
        ranges "../afp-codegen/tests/codegen/ranges.afp"
        sub_plan "../afp-codegen/tests/codegen/sub_plan.afp"
        supervisors "../afp-codegen/tests/codegen/supervisors.afp"
        units "../afp-codegen/tests/codegen/units.afp"
    }
}

use afp::load::{LoadedPlan, Registry};
use afp_core::quantity::Speed;
use afp_core::rt::{NamedPlan, Plan, PlanState};
use afp_core::trace::{Line, Names, NoTrace, Record, Sink};
use afp_core::{Instant, Scheduler, StillClock, Value, Wake};
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_syntax::source::Source;
use kit::templates::seek::State;
use kit::{Place, Script};
use plan::Everything;

/// A trace as text.
struct Lines<N> {
    names: N,
    lines: Vec<String>,
}

impl<N: Names> Sink for Lines<N> {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.lines.push(Line { at, record, names: &self.names }.to_string());
    }
}

/// The trace of a plan with this script, and the history of its components.
fn story<P: Plan<Script> + NamedPlan>(
    mut plan: P,
    seek: &[Option<State>],
) -> (Vec<String>, Vec<String>) {
    let mut script = Script { seek: seek.iter().cloned().collect(), ..Script::default() };
    let speed = plan.entry_named("speed").unwrap();
    plan.set_input(speed.0, &Value::Float(0.5)).unwrap();
    let mut sink = Lines { names: plan.names(), lines: Vec::new() };
    let mut scheduler = Scheduler::new(plan);
    let mut wake = scheduler.start((&mut script, &mut sink, &StillClock), Instant::ZERO).unwrap();
    for _ in 0..60 {
        match wake {
            Wake::At(at) => wake = scheduler.step((&mut script, &mut sink, &StillClock), at),
            Wake::Ended(_) | Wake::NotStarted => break,
        }
    }
    (sink.lines, script.told)
}

fn loaded() -> LoadedPlan<Script> {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    toolboxes.add(Source::new("toolbox.afp", kit::templates::SOURCE), "crate::kit");
    let text = include_str!("everything.afp");
    let compiled =
        afp_dsl::compile(&Source::new("everything.afp", text), &toolboxes, &Texts::default());
    let mut registry = Registry::new();
    afp_std::templates::register(&mut registry);
    kit::templates::register(&mut registry);
    LoadedPlan::new(&compiled.graph.unwrap(), &registry).unwrap()
}

/// Runs both back ends with the script and asserts that their results are the same; returns them.
fn same_story(seek: &[Option<State>]) -> Vec<String> {
    let (lines, told) = story(Everything::new(), seek);
    let (of_loaded, told_by_loaded) = story(loaded(), seek);
    assert_eq!(lines, of_loaded);
    assert_eq!(told, told_by_loaded);
    lines.into_iter().filter(|line| !line.contains("polled")).collect()
}

#[test]
fn results_of_a_sub_plan_reach_its_parent() {
    let found = State::Found { place: Place(7), said: Default::default() };
    let lines = same_story(&[Some(found), None, Some(kit::lost("60 cm", 0.5))]);
    for line in [
        "0.010000 first commits found: unset -> Place#2",
        "0.010000 round commits round.rounds: unset -> 3",
        "0.010000 round commits round.text: unset -> \"12 cm of 3\"",
        "0.010000 round.seek reads name = \"12 cm1\"",
        "0.030000 round ended OK",
        "0.030000 round commits turn: 0 rad -> 0.5 rad",
        "0.030000 round commits text: \"12 cm\" -> \"60 cm\"",
        "0.030000 again commits again.pace: unset -> 0.6 m/s",
    ] {
        assert!(lines.iter().any(|known| known == line), "no '{line}' in {lines:#?}");
    }
}

#[test]
fn texts_are_joined_from_values_of_every_kind() {
    let lost = |said| Some(kit::lost(said, 0.5));
    let lines = same_story(&[Some(State::Bored), lost("1 m"), None, lost("2 m")]);
    for line in [
        "show reads value = \"at 3 m, lefttrue0.5\"",
        "again commits again.label: unset -> \"round\"",
        "again.seek reads name = \"round1\"",
    ] {
        assert!(lines.iter().any(|known| known.ends_with(line)), "no '{line}' in {lines:#?}");
    }
}

#[test]
fn a_string_that_is_not_a_quantity_is_a_fault_of_its_reader() {
    let found = State::Found { place: Place(7), said: Default::default() };
    let lines = same_story(&[Some(found), None, Some(kit::lost("far", 0.5))]);
    assert_eq!(lines.last().unwrap(), "0.030000 Everything ended Error(conversion)");
}

#[test]
fn a_number_that_is_not_finite_is_a_fault_of_its_writer() {
    let found = State::Found { place: Place(7), said: Default::default() };
    let lines = same_story(&[Some(found), None, Some(kit::lost("far", f64::NAN))]);
    assert!(lines.iter().any(|line| line.contains("round.seek fault arithmetic")), "{lines:#?}");
}

#[test]
fn an_input_without_a_default_needs_a_value() {
    let mut scheduler = Scheduler::new(Everything::new());
    let started =
        scheduler.start((&mut Script::default(), &mut NoTrace, &StillClock), Instant::ZERO);
    assert_eq!(format!("{started:?}"), "Err(InputMissing(EntryId(1)))");
}

#[test]
fn entries_are_set_and_read_by_name() {
    let mut plan = Everything::new();
    let speed = plan.entry_named("speed").unwrap();
    let value = plan.read(speed, "36 km/h").unwrap();
    assert_eq!(value, Value::Float(10.0));
    plan.set_input(speed.0, &value).unwrap();
    assert_eq!(plan.speed(), Some(Speed::from_si(10.0)));
    assert!(plan.set_input(speed.0, &Value::Float(f64::NAN)).is_err());
    assert!(plan.set_input(plan.entry_named("half").unwrap().0, &Value::Float(1.0)).is_err());
}

#[test]
fn devices_are_found_by_their_numbers() {
    use afp_core::devices::{self, Defect, Devices as _, SignalType};
    use vacuum::devices::{Control, Devices, Fault};
    use vacuum::signal;

    let table = Devices::TABLE;
    let control = |words| devices::find_control(table, words).and_then(Devices::control);
    assert_eq!(control("left"), Some(Control::BumperLeft));
    assert_eq!(control("bumper.right"), Some(Control::BumperRight));
    assert_eq!(devices::find_stop(table).and_then(Devices::control), Some(Control::Panel));
    let fault = |device, name, amount| {
        devices::find_fault(table, device, name).and_then(|id| Devices::fault(id, amount))
    };
    let late = Defect::Delayed(afp_core::Duration::from_millis(300));
    assert_eq!(fault("bumper", "delayed", Some(0.3)), Some(Fault::Bumper(late)));
    assert_eq!(fault("battery", "nan", None), Some(Fault::Battery(Defect::NotANumber)));
    assert_eq!(fault("battery", "low", None).and_then(Fault::battery_low), Some(0.05));
    assert_eq!(fault("wheels", "runaway", Some(-2.0)).and_then(Fault::battery_low), None);
    let by = fault("wheels", "runaway", Some(-2.0)).and_then(Fault::wheels_runaway);
    assert_eq!(by, Some(Speed::from_si(-2.0)));
    assert_eq!(fault("wheels", "blocked", None), Some(Fault::WheelsBlocked));
    for (device, name, amount) in [("battery", "low", 1.5), ("wheels", "blocked", 0.5)] {
        assert_eq!(fault(device, name, Some(amount)), None, "{device}.{name}");
    }
    for (id, device, name, ty) in [
        (signal::BUMPER_RIGHT, "bumper", "right", SignalType::Bool),
        (signal::BATTERY_VOLTAGE, "battery", "voltage", SignalType::Float("V")),
        (signal::POSE, "robot", "pose", SignalType::Pose),
        (signal::BUMPER_LEFT_2, "robot", "bumper_left", SignalType::Int),
    ] {
        assert_eq!(devices::find_signal(table, device, name), Some(id), "{device}.{name}");
        let row = devices::signals(table).find(|(known, ..)| *known == id);
        assert_eq!(row.map(|(_, _, row)| row.ty), Some(ty));
    }
}

#[test]
fn every_golden_case_is_compiled_here() {
    let folder = "../afp-codegen/tests/codegen";
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut cases: Vec<_> = files
        .filter(|path| path.extension().is_some_and(|ending| ending == "afp"))
        .filter(|path| {
            let elsewhere = ["toolbox.afp", "devices.afp", "wall_following.afp"];
            !elsewhere.iter().any(|name| path.ends_with(name))
        })
        .map(|path| path.display().to_string())
        .collect();
    cases.sort();
    assert_eq!(cases, golden::ALL);
}
