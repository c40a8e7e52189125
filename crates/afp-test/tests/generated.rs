//! Every event at five points of each element's run, for the shipped plans; and broken behaviour
//! that these scenarios detect.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use afp::load::Registry;
use afp::{Actor, Fault, Instant, Poll};
use afp_carbot::devices::Navigator;
use afp_carbot::{Forward, templates};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::rt::Registry as _;
use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::scenario::{DEFAULT_UNTIL, Scenario};
use afp_session::Loader;
use afp_sim::Simulation;
use afp_syntax::source::Source;
use afp_test::{Generated, Setting, Verdict};
use templates::forward::{Inputs, Live, State};

/// The templates of `examples/embed`, for a robot without a loudspeaker.
mod shop {
    afp::toolbox!("../../examples/embed/shop.afp", robot = super::Simulation);
}

const SHOP: &str = include_str!("../../../examples/embed/shop.afp");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn robot() -> impl afp_session::Loader {
    afp_sim::carbot(|_| {})
}

fn compiled(name: &str, text: &str) -> Compiled {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    toolboxes.add(Source::new("shop.afp", SHOP), "shop");
    let files = |path: &str| fs::read_to_string(path).map_err(|error| error.to_string());
    let compiled = afp_dsl::compile(&Source::new(name, text), &toolboxes, &files);
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    compiled
}

/// A plan with its generated scenarios.
struct Made {
    setting: Setting,
    generated: Generated,
    scenarios: Vec<Scenario>,
}

/// Plans that need more than a default run, with their durations in seconds; they run at night.
const LONG: &[(&str, u64)] = &[("patrol.afp", 180)];

fn seconds(file: &Path) -> Option<u64> {
    LONG.iter().find(|(name, _)| file.ends_with(name)).map(|(_, seconds)| *seconds)
}

impl Made {
    fn new(file: &Path, robot: &dyn Loader) -> Made {
        Made::of(file, &fs::read_to_string(file).unwrap(), robot)
    }

    /// Generates for a changed text of a plan file.
    fn of(file: &Path, text: &str, robot: &dyn Loader) -> Made {
        let name = file.display().to_string();
        let graph = Arc::new(compiled(&name, text).graph.unwrap());
        let until = seconds(file).map_or(DEFAULT_UNTIL, |seconds| seconds * 1_000_000_000);
        let quiet = Scenario::quiet("as it goes", graph, &*name, until);
        let setting = Setting::find(&quiet, file, robot.kind()).unwrap();
        let mut go = |scenario: &Scenario| afp_test::run(scenario, &setting, robot, None);
        let generated = afp_test::generate(&quiet, robot.kind().devices(), &mut go).unwrap();
        let scenarios = scenarios(&name, text, &generated);
        Made { setting, generated, scenarios }
    }

    fn text(&self) -> String {
        self.generated.text("same file")
    }

    /// Keeps the scenarios that pass.
    fn proven(mut self, plan: &str, robot: &dyn Loader) -> Made {
        let read = |made: &Generated| Ok::<_, ()>(scenarios("plan.afp", plan, made));
        let run_all = |all: &[Scenario]| Ok(all.iter().map(|it| self.run(it, robot)).collect());
        let mut generated = self.generated.clone();
        generated.prove(read, run_all).unwrap();
        self.scenarios = scenarios("plan.afp", plan, &generated);
        self.generated = generated;
        self
    }

    /// Keeps only the scenarios with an event halfway through an element's run.
    fn halfway(mut self) -> Made {
        self.scenarios.retain(|scenario| scenario.name.ends_with(" 50 %"));
        assert_ne!(self.scenarios.len(), 0);
        self
    }

    fn run(&self, scenario: &Scenario, robot: &dyn Loader) -> Verdict {
        afp_test::run(scenario, &self.setting, robot, None).unwrap()
    }

    fn all_pass(&self, robot: &dyn Loader) {
        let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
        std::thread::scope(|threads| {
            for share in self.scenarios.chunks(self.scenarios.len().div_ceil(cores)) {
                threads.spawn(move || {
                    for scenario in share {
                        let verdict = self.run(scenario, robot);
                        assert!(verdict.passed(), "{}\n{}", scenario.name, verdict.report());
                    }
                });
            }
        });
    }
}

/// The generated scenarios, for a possibly changed plan.
fn scenarios(name: &str, plan: &str, generated: &Generated) -> Vec<Scenario> {
    // They are in the plan's own file, so it is not imported.
    let text = generated.text("same file");
    let (_, scenarios) = text.split_once('\n').unwrap();
    let all = compiled(name, &format!("{plan}\n{scenarios}"));
    assert_eq!(all.scenarios.len(), generated.count(), "{}", all.render(false));
    all.scenarios
}

#[test]
fn a_changed_distance_breaks_only_its_scenarios() {
    let plan = |first: u32| {
        format!(
            "use carbot\nplan Bend {{
                start go
                supervise escape: CheckEscapeButton {{ EscapeButtonPressed -> terminate }}
                actor go: Forward(distance = {first} cm) {{ ForwardSuccessful -> turn }}
                actor turn: Turn(angle = 90 deg) {{ TurnSuccessful -> on }}
                actor on: Forward(distance = 20 cm) {{ ForwardSuccessful -> terminate }}
            }}"
        )
    };
    let made = Made::of(Path::new("bend.afp"), &plan(40), &robot());
    assert_eq!(made.scenarios.len(), 15);
    made.all_pass(&robot());
    let shorter = scenarios("bend.afp", &plan(30), &made.generated);
    let broken = shorter.iter().filter(|scenario| !made.run(scenario, &robot()).passed());
    let names: Vec<_> = broken.map(|scenario| scenario.name.as_str()).collect();
    assert_eq!(names, ["go: escape.EscapeButtonPressed at 90 %"]);
}

/// Plans that continue soon after an event or at its instant: the omitted scenarios, and whether
/// some expect a later end in `Error`.
#[test]
fn generated_scenarios_pass_for_any_plan_after_the_event() {
    let global = |line: &str| format!("supervise own: CheckEscapeButton {{ {line} }}");
    let fails = "actor rest: Signal(times = 3) { Signalled -> fail \"battery\" }";
    let go = "actor go: Forward(distance = 50 cm) { ForwardSuccessful -> terminate }";
    let battery = "supervise battery: CheckBattery { BatteryLow -> rest }";
    let late =
        |to: &str| format!("supervise late: CheckTimeout(duration = 1.3 s) {{ TimedOut -> {to} }}");
    let plans = [
        (vec![battery.to_owned(), go.to_owned(), fails.to_owned()], true),
        (vec![battery.to_owned(), go.to_owned(), fails.to_owned(), late("fail \"late\"")], true),
        (vec![battery.to_owned(), go.to_owned(), late("rest"), fails.replace("fail \"battery\"", "go")], false),
        (vec![global("EscapeButtonPressed -> resume"), late("fail \"late\""), go.to_owned()], true),
        (
            vec![
                global("EscapeButtonPressed -> choose"),
                "var n: int = 0".to_owned(),
                "computation choose: Count(value = n, limit = 1, next => n) { Again -> go, Done -> fail \"twice\" }".to_owned(),
                go.to_owned(),
            ],
            false,
        ),
        (
            vec![
                "var gone: length = 0 m".to_owned(),
                global("EscapeButtonPressed -> back"),
                go.replace("50 cm)", "50 cm, driven => gone)"),
                "actor back: Forward(distance = -1 mm, driven => gone) { ForwardSuccessful -> terminate }".to_owned(),
            ],
            false,
        ),
        (
            vec![
                "actor go: Forward(distance = 50 cm) {
                    supervise own: CheckTouchSensor { TouchSensorPressed -> terminate }
                    ForwardSuccessful -> terminate
                }".to_owned(),
                "supervise own: CheckTouchSensor { TouchSensorPressed -> fail \"bump\" }".to_owned(),
            ],
            false,
        ),
    ];
    for (lines, fails) in plans {
        let plan = format!("use carbot use std plan M {{ start go\n{}\n}}", lines.join("\n"));
        let made = Made::of(Path::new("plan.afp"), &plan, &robot());
        let before = made.generated.count();
        let made = made.proven(&plan, &robot());
        made.all_pass(&robot());
        let all = made.generated.count() as f64 / before as f64;
        assert!(before == 0 || all > 0.5, "{plan}\n{:?}", made.generated.left_out);
        assert_eq!(made.text().contains("expect end by Error\n"), fails, "{plan}\n{}", made.text());
    }
}

#[test]
fn scenarios_without_an_interruption_are_listed() {
    let plan = "use carbot plan Square { start go
        actor go: Forward(distance = 50 cm) { ForwardSuccessful -> terminate } }";
    let made = Made::of(Path::new("square.afp"), plan, &robot());
    assert_eq!(made.generated.count(), 0);
    assert_eq!(made.generated.left_out, ["no event interrupts anything in 'Square'"]);
}

#[test]
fn errors_and_supervisors_of_sub_plans_are_generated() {
    let plan = "use carbot\nplan Errand {
            start go
            subplan go: Go { OK -> terminate }
        }
        plan Go {
            start way
            supervise bump: CheckTouchSensor { TouchSensorPressed -> back }
            subplan way: Way { OK -> terminate }
            actor back: Forward(distance = -10 cm) { ForwardSuccessful -> terminate }
        }
        plan Way {
            start on
            actor on: Forward(distance = 40 cm) { ForwardSuccessful -> terminate, Error -> off }
            actor off: Forward(distance = -10 cm) { ForwardSuccessful -> terminate }
        }";
    let made = Made::of(Path::new("errand.afp"), plan, &robot());
    assert_eq!(made.generated.left_out, [""; 0]);
    assert!(made.text().contains("go.back"), "{}", made.text());
}

/// Elements that need a second event, since `MakeRoom` and `Pass` alternate between two behaviours,
/// or that no run reaches, since `GoElsewhere` avoids a place where something stopped it.
/// Handwritten scenarios of these parts cover all of them.
const OUT_OF_REACH: [&str; 3] = ["'shift.aside", "'pass.avoid", "'elsewhere.go.free"];

#[test]
fn every_event_of_the_shipped_plans_interrupts() {
    let files = fs::read_dir(root().join("plans")).unwrap().map(|entry| entry.unwrap().path());
    let files: Vec<_> = files.filter(|path| path.extension().is_some_and(|e| e == "afp")).collect();
    assert!(!files.is_empty());
    let by_night = std::env::var_os("AFP_BY_NIGHT").is_some();
    std::thread::scope(|threads| {
        for file in files.iter().filter(|file| by_night || seconds(file).is_none()) {
            threads.spawn(move || {
                let made = testable(file);
                match by_night || file.ends_with("wall_following.afp") {
                    true => made.all_pass(&robot()),
                    // The others take minutes; 'cargo xtask nightly' runs all.
                    false => made.halfway().all_pass(&robot()),
                }
            });
        }
    });
}

/// Generates for a plan with only testable actors.
fn testable(file: &Path) -> Made {
    let made = Made::new(file, &robot());
    let name = file.display();
    let out = made.generated.left_out.iter().filter(|why| why.starts_with("no run reached"));
    let out = out.filter(|why| !OUT_OF_REACH.iter().any(|it| why.contains(it)));
    assert_eq!(out.collect::<Vec<_>>(), [""; 0], "{name} has actors that nobody can test");
    assert!(made.generated.count() >= 5, "{name}");
    made
}

#[test]
fn every_event_in_the_examples_sub_plans_interrupts() {
    let robot = afp_sim::carbot(|registry: &mut Registry<Simulation>| {
        shop::register(registry);
    });
    let made = Made::new(&root().join("examples/embed/plans/errands.afp"), &robot);
    assert!(made.text().contains("expect fetch.there -> terminate by touch"));
    assert_eq!(made.generated.left_out, [""; 0]);
    made.all_pass(&robot);
}

/// Interrupts `Forward` in the implementation `A` and returns the broken lines.
fn interrupted<A: Actor<templates::Forward, Simulation> + Clone + Send + 'static>() -> Vec<String> {
    let sound = Made::new(&root().join("plans/wall_following.afp"), &robot());
    let mutant = afp_sim::carbot(|registry: &mut Registry<Simulation>| {
        registry.actor::<templates::Forward, A>("carbot", "Forward");
    });
    let driving = |scenario: &&Scenario| scenario.name.starts_with("searchFirstWall: touch");
    let driving: Vec<_> = sound.scenarios.iter().filter(driving).collect();
    assert_eq!(driving.len(), 5);
    let broken = driving.iter().flat_map(|scenario| sound.run(scenario, &mutant).broken);
    broken.map(|broken| format!("{}: {}", broken.text, broken.why)).collect()
}

#[test]
fn an_actor_that_ignores_its_interruption_is_found() {
    let halted = |broken: &&String| broken.starts_with("expect halted always");
    assert_eq!(interrupted::<Mutant<false>>().iter().filter(halted).count(), 5);
    let slowly = interrupted::<Mutant<true>>();
    assert_eq!(slowly.iter().filter(halted).count(), 5, "{slowly:?}");
    assert_eq!(interrupted::<Forward>(), [""; 0]);
}

#[derive(Clone)]
struct Announce;

impl Actor<shop::Announce, Simulation> for Announce {
    fn start(_: shop::announce::Inputs<'_>, _: &mut Simulation, _: Instant) -> Result<Self, Fault> {
        Ok(Announce)
    }

    fn poll(
        &mut self,
        _: shop::announce::Live,
        _: &mut Simulation,
        _: Instant,
    ) -> Result<Poll<shop::announce::State>, Fault> {
        Ok(Poll::Ready(shop::announce::State::Announced))
    }

    fn interrupt(&mut self, _: &mut Simulation, _: Instant) -> Result<(), Fault> {
        Ok(())
    }
}

/// A `Forward` that continues after its interruption, with its last command or slowly.
#[derive(Clone)]
struct Mutant<const SLOWLY: bool>(Forward);

impl<const SLOWLY: bool> Actor<templates::Forward, Simulation> for Mutant<SLOWLY> {
    fn start(inputs: Inputs, env: &mut Simulation, now: Instant) -> Result<Self, Fault> {
        Forward::start(inputs, env, now).map(Mutant)
    }

    fn poll(
        &mut self,
        live: Live,
        env: &mut Simulation,
        now: Instant,
    ) -> Result<Poll<State>, Fault> {
        self.0.poll(live, env, now)
    }

    fn interrupt(&mut self, env: &mut Simulation, now: Instant) -> Result<(), Fault> {
        if SLOWLY {
            env.drive(Speed::from_si(0.1), AngularSpeed::from_si(0.0), now);
        }
        Ok(())
    }
}
