//! A plan on a robot whose time passes by itself; the robot is stopped after every end of the run.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration as Span, Instant as Wall};

use afp_carbot::table::Carbot;
use afp_core::devices::{Devices, controls, find_signal};
use afp_core::trace::Ending;
use afp_core::{Clock, Duration, Environment, Instant, Platform, rt::Registry as _};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_run::options::RunOptions;
use afp_run::{EXIT_OK, EXIT_PLAN_ERROR, Extras, Program, RunError, run, run_on_hardware};
use afp_session::{
    Hardware, Loader, Open, Opened, Opener, Request, RequestError, Robot, Samples, SessionError,
    Settings, hardware, simulated,
};
use afp_sim::Simulation;
use afp_syntax::source::Source;
use clap::{Args, Command, FromArgMatches};

mod templates {
    afp_macros::toolbox!("tests/board.afp", robot = super::Board);
}

/// Data about a board, kept after it is dropped.
#[derive(Default)]
struct Seen {
    stops: AtomicU64,
    polls: AtomicU64,
    /// The number of pose requests.
    samples: AtomicU64,
}

/// A robot that moves unless it is stopped.
struct Board {
    time: Time,
    seen: Arc<Seen>,
}

#[derive(Clone, Copy)]
struct Time(Wall);

impl Time {
    fn now(self) -> Instant {
        Instant::from_nanos(self.0.elapsed().as_nanos() as u64)
    }
}

impl Clock for Time {
    fn now(&self, step: Instant) -> Instant {
        Time::now(*self).max(step)
    }
}

impl Environment for Board {
    fn stop(&mut self, _: Instant) {}

    fn emergency_stop(&mut self) {
        self.seen.stops.fetch_add(1, Ordering::Relaxed);
    }
}

impl Platform for Board {
    type Clock = Time;

    fn clock(&self) -> Time {
        self.time
    }

    fn now(&self) -> Instant {
        self.time.now()
    }

    fn advance(&mut self, to: Instant) {
        let left = to.since(self.now());
        assert!(left.as_secs_f64() <= 0.021, "a signal would wait for {left:?}");
        std::thread::sleep(Span::from_nanos(left.as_nanos()));
    }
}

impl Robot for Board {
    type Devices = Carbot;

    fn sample(&self, to: &mut Samples<'_, '_>) {
        let pose = find_signal(Carbot::TABLE, "robot", "pose").expect("a Carbot has a pose");
        if to.wants(pose) {
            self.seen.samples.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl Hardware for Board {
    type Error = &'static str;

    fn open(settings: &Settings) -> Result<Self, &'static str> {
        match settings.get_or("port", "none") {
            "none" => Err("there is no board at 'none'"),
            _ => Ok(Board { time: Time(Wall::now()), seen: Arc::default() }),
        }
    }
}

mod work {
    use super::{Board, Ordering, Span, templates};
    use afp_core::{Actor, Fault, Instant, Poll};

    /// Slow polls, which fail in the end.
    #[derive(Clone)]
    pub struct Work {
        cost: Span,
        breaks: u64,
    }

    impl Actor<templates::Work, Board> for Work {
        fn start(
            inputs: templates::work::Inputs,
            _: &mut Board,
            _: Instant,
        ) -> Result<Self, Fault> {
            let cost = Span::from_nanos(inputs.cost.duration().as_nanos());
            Ok(Work { cost, breaks: inputs.breaks as u64 })
        }

        fn poll(
            &mut self,
            _: templates::work::Live,
            board: &mut Board,
            _: Instant,
        ) -> Result<Poll<templates::work::State>, Fault> {
            std::thread::sleep(self.cost);
            let polls = board.seen.polls.fetch_add(1, Ordering::Relaxed) + 1;
            assert!(polls != self.breaks, "this component is broken");
            Ok(Poll::Pending)
        }

        fn interrupt(&mut self, _: &mut Board, _: Instant) -> Result<(), Fault> {
            Ok(())
        }
    }
}

use work::Work;

fn options(arguments: &[&str]) -> RunOptions {
    let command = RunOptions::augment_args(Command::new("test").no_binary_name(true));
    let no_log = ["--log", "none"].iter().filter(|_| !arguments.contains(&"--log"));
    let all = ["--robot", "hardware", "--json"].iter().chain(no_log).chain(arguments);
    RunOptions::from_arg_matches(&command.get_matches_from(all)).unwrap()
}

fn plan(text: &str) -> afp_dsl::graph::Graph {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    toolboxes.add(Source::new("board.afp", templates::SOURCE), "board");
    let compiled = compile(&Source::new("plan.afp", text), &toolboxes, &Texts::default());
    compiled.graph.clone().unwrap_or_else(|| panic!("{}", compiled.render(false)))
}

const WAITS: &str = "use std\nplan Waits {\n    in time: duration = 300 ms\n    start rest\n    \
    actor rest: Wait(duration = time) { Elapsed -> terminate }\n}";

/// Runs a plan on the board; returns the result, its duration and the data of the board.
fn on_board(text: &str, arguments: &[&str]) -> (Result<u8, RunError>, Span, Arc<Seen>) {
    let graph = plan(text);
    let seen: Arc<Seen> = Arc::default();
    let board = hardware::<Simulation, Board, _>(|registry| {
        standard(registry);
        registry.actor::<templates::Work, Work>("board", "Work");
    });
    let open = |settings: &Settings| {
        let robot = Board::open(settings).map_err(|why| SessionError::Hardware(why.into()))?;
        // The opener's board is dropped with its run; this one can be examined later.
        drop(board.open(&graph, settings)?);
        let mut registry = afp::load::Registry::new();
        standard(&mut registry);
        registry.actor::<templates::Work, Work>("board", "Work");
        let plan = afp::load::LoadedPlan::new(&graph, &registry).map_err(SessionError::Load)?;
        let robot = Board { seen: seen.clone(), ..robot };
        let session = Box::new(afp_session::Session::on_hardware(plan, robot));
        Ok(Opened { session, last_resort: None, watch: None })
    };
    let texts = [("plan.afp", text)];
    // A busy machine must not count as a stall.
    let hardware = [("port", "ttyUSB0"), ("realtime.stall", "10 s")];
    let program = Program {
        name: "P",
        file: "plan.afp",
        texts: &texts,
        toolboxes: &[("board", "toolbox board")],
        project: "[robot]",
        hardware: &hardware,
    };
    let began = Wall::now();
    let ran = run_on_hardware(&program, Box::new(open), &options(arguments), Extras::default());
    (ran, began.elapsed(), seen)
}

fn standard(registry: &mut afp::load::Registry<Board>) {
    afp_std::templates::register(registry);
}

fn message(ran: Result<u8, RunError>) -> String {
    ran.expect_err("it is refused").to_string()
}

#[test]
fn a_plan_ends_by_its_clock_and_the_robot_stops() {
    let (ran, took, seen) = on_board(WAITS, &["--set", "time=120ms"]);
    assert_eq!(ran.unwrap(), EXIT_OK);
    assert!(took >= Span::from_millis(120), "{took:?}");
    assert!(seen.stops.load(Ordering::Relaxed) > 0);
}

#[test]
fn until_ends_a_run_with_late_steps() {
    // Polls every 10 ms take 15 ms each.
    let text = "use board\nplan Late {\n    start go\n    \
        actor go: Work(cost = 15 ms) { Never -> terminate }\n}";
    let (ran, took, seen) = on_board(text, &["--until", "200ms"]);
    assert_eq!(ran.unwrap(), EXIT_OK);
    assert!(took >= Span::from_millis(200), "{took:?}");
    assert!(seen.stops.load(Ordering::Relaxed) > 0);
}

#[test]
fn a_poll_that_delays_the_control_loop_ends_the_run_in_an_error_and_stops_the_robot() {
    let text = "use board\nplan Late {\n    start go\n    \
        actor go: Work(cost = 150 ms) { Never -> terminate }\n}";
    let stall = ["--set", "robot.realtime.stall=100ms", "--until", "5s"];
    let (ran, _, seen) = on_board(text, &stall);
    assert_eq!(ran.unwrap(), EXIT_PLAN_ERROR);
    assert!(seen.stops.load(Ordering::Relaxed) > 0);
    assert_eq!(seen.polls.load(Ordering::Relaxed), 1);
}

#[test]
fn a_robot_can_be_stopped_without_a_run() {
    let (ran, _, seen) = on_board(WAITS, &["--stop-only"]);
    assert_eq!(ran.unwrap(), EXIT_OK);
    assert!(seen.stops.load(Ordering::Relaxed) > 0);
    assert_eq!(seen.polls.load(Ordering::Relaxed), 0);
}

#[test]
fn a_panic_stops_the_robot() {
    let text = "use board\nplan Breaks {\n    start go\n    \
        actor go: Work(breaks = 3) { Never -> terminate }\n}";
    let (ran, _, seen) = on_board(text, &[]);
    assert_eq!(ran.unwrap(), EXIT_PLAN_ERROR);
    assert!(seen.stops.load(Ordering::Relaxed) > 0);
    assert_eq!(seen.polls.load(Ordering::Relaxed), 3);
}

#[test]
fn an_output_that_cannot_be_written_stops_the_robot_before_it_moves() {
    let (ran, _, seen) = on_board(WAITS, &["--svg", "/no/such/folder/a.svg"]);
    assert!(message(ran).contains("cannot write the picture"));
    assert!(seen.stops.load(Ordering::Relaxed) > 0);
}

#[test]
fn a_log_names_the_real_robot_and_is_not_repeated() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("a.mcap");
    let name = log.to_str().unwrap();
    let (ran, ..) = on_board(WAITS, &["--until", "50ms", "--log", name]);
    assert_eq!(ran.unwrap(), EXIT_OK);
    let read = afp_log::read(Path::new(name)).unwrap();
    let recipe = read.recipe();
    assert_eq!((&*recipe.robot, &read.cut_short), ("hardware", &None));
    assert!(read.facts["wall_clock_s"].parse::<f64>().unwrap() > 1e9);
    for times in ["loop_late", "loop_steps"] {
        assert!(read.end[times].contains(", p50 "), "{:?}", read.end);
    }
    assert_eq!((&*recipe.toolboxes[0].text, &*recipe.project), ("toolbox board", "[robot]"));
    let robot = simulated::<Simulation, _>(|_| {});
    // The simulation knows no world of it, and its pose is unknown.
    let drawn = afp_run::draw_log(&read, robot.kind()).unwrap_err().to_string();
    assert!(drawn.contains("nothing to draw") && drawn.contains("'pose'"), "{drawn}");
    let none = afp_run::draw_sonar(&read, robot.kind()).unwrap_err().to_string();
    assert!(none.contains("the log has no echoes"), "{none}");
    let simulated_with = |arguments: &[&str]| {
        let command = RunOptions::augment_args(Command::new("test").no_binary_name(true));
        RunOptions::from_arg_matches(&command.get_matches_from(arguments)).unwrap()
    };
    let again = simulated_with(&["--again", name, "--log", "none"]);
    let program = Program {
        name: "P",
        file: "plan.afp",
        texts: &[],
        toolboxes: &[],
        project: "",
        hardware: &[],
    };
    let make =
        |_: &dyn afp_session::AnyWorld, _: u64, _: &[&str]| panic!("there is nothing to make");
    let make = Box::new(make);
    let ran = run(&program, robot.kind(), make.clone(), &again, Extras::default());
    assert!(message(ran).contains("which cannot be repeated"));
    // A built program has no debugger, and refuses the option.
    let attach = simulated_with(&["--attach", "--log", "none"]);
    let ran = run(&program, robot.kind(), make, &attach, Extras::default());
    assert!(message(ran).contains("'--attach' needs a debugger, and this program has none"));
}

#[test]
fn a_real_robot_is_sampled_at_irregular_times() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("a.mcap");
    let (ran, _, seen) = on_board(WAITS, &["--until", "200ms", "--log", log.to_str().unwrap()]);
    assert_eq!(ran.unwrap(), EXIT_OK);
    // Every 20 ms, as in the simulator; a busy machine skips some.
    let samples = seen.samples.load(Ordering::Relaxed);
    assert!((4..=25).contains(&samples), "{samples}");
}

#[test]
fn a_late_stop_request_is_taken_without_a_press() {
    let graph = plan(WAITS);
    let board = hardware::<Simulation, Board, _>(standard);
    let settings = Settings::new([("port", "ttyUSB0")]);
    let Opened { mut session, .. } = board.open(&graph, &settings).unwrap();
    session.set_stall(Duration::from_secs(10));
    let soon = session.now() + Duration::from_millis(5);
    session.tick(soon, &mut Open, &mut []).unwrap();
    session.tick(soon, &mut Open, &mut []).unwrap();
    let (touch, ..) = controls(Carbot::TABLE).next().unwrap();
    let pressed = session.at(session.now(), Request::Press(touch, true));
    assert_eq!(pressed, Err(RequestError::Refused));
    session.at(Instant::ZERO, Request::Stop).unwrap();
    session.tick(session.now() + Duration::from_millis(5), &mut Open, &mut []).unwrap();
    assert_eq!(session.ending(), Some(Ending::Interrupted));
}

#[test]
fn settings_reach_the_robot_and_simulation_options_are_refused() {
    let (ran, _, seen) = on_board(WAITS, &["--set", "robot.port=none"]);
    let why = message(ran);
    assert!(why.contains("the robot cannot be reached: there is no board at 'none'"), "{why}");
    assert_eq!(seen.stops.load(Ordering::Relaxed), 0);
    let why = message(on_board(WAITS, &["--set", "robot.baud=9600"]).0);
    assert!(why.contains("no setting 'robot.baud'") && why.contains("'robot.port'"), "{why}");
    let why = message(on_board(WAITS, &["--set", "robot.realtime.stall=1h"]).0);
    assert!(
        why.contains("'robot.realtime.stall' cannot be '1h'") && why.contains("100 ms"),
        "{why}"
    );
    for option in [
        ["--world", "a.toml"],
        ["--speed", "max"],
        ["--press", "touch@1s"],
        ["--fail", "touch.lost@1s"],
        ["--set", "world.robot.charge=0.5"],
        ["--start", "1m,1m,0deg"],
        ["--set", "world.name=hall"],
    ] {
        let why = message(on_board(WAITS, &option).0);
        assert!(why.contains(option[0]) && why.contains("simulated"), "{why}");
    }
}
