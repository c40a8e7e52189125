//! Plans that a debugger holds: the robot stands still, and suspended actors continue.

use afp_core::devices::find_signal;
use afp_core::{Duration, Instant, Release};
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_dsl::{Toolboxes, compile};
use afp_session::{AnySession, Loader, Next, Open, Request, SampleRef};
use afp_sim::carbot;
use afp_syntax::source::Source;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// The steps of all random runs together.
const STEPS: u32 = 100_000;

const ROOM: &str = include_str!("../../../worlds/wall_following.toml");

/// The robot drives its rounds. A bumper press suspends them, for a handler that is a sub-plan.
const ROUNDS: &str = "use std
use carbot

plan Rounds {
    start side
    var corners: int = 0
    supervise touch: CheckTouchSensorClick { TouchSensorClicked -> suspend pause }
    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }
    subplan side: Side { OK -> count }
    computation count: Count(value = corners, limit = 4, next => corners) {
        Again -> side
        Done -> side
    }
    subplan pause: Pause { OK -> return }
}

plan Side {
    start ahead
    actor ahead: Forward(distance = 60 cm) { ForwardSuccessful -> corner }
    actor corner: Turn(angle = 90 deg) { TurnSuccessful -> terminate }
}

plan Pause {
    start stand
    actor stand: Hold {
        supervise over: After(duration = 300 ms) { Elapsed -> look }
    }
    actor look: Turn(angle = 30 deg) { TurnSuccessful -> terminate }
}
";

fn graph(text: &str) -> Graph {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("plan.afp", text), &toolboxes, &Texts::default());
    let messages = compiled.render(false);
    compiled.graph.expect(&messages)
}

fn session(graph: &Graph, seed: u64) -> Box<dyn AnySession> {
    let robot = carbot(|_| ());
    let world = robot.kind().world(ROOM).expect("the room is well-formed");
    robot.session(graph, &*world, seed, &[]).expect("the room can be built")
}

/// The commanded speed and turn, in SI units.
fn commanded(session: &dyn AnySession) -> [f64; 2] {
    ["asked_speed", "asked_turn"].map(|name| {
        let signal =
            find_signal(session.devices(), "navigator", name).expect("the drive reports it");
        let mut value = f64::NAN;
        session.read(signal, &mut |sample| {
            if let SampleRef::Float(number) = sample {
                value = number;
            }
        });
        value
    })
}

/// Makes a random request of a debugger for now.
fn ask(session: &mut dyn AnySession, dice: &mut Pcg32) {
    let request = match dice.next_u32() % 5 {
        0 | 1 => Request::Pause,
        2 => Request::Release(Release::Continue),
        3 => Request::Release(Release::Step),
        _ => {
            let touch = afp_core::devices::find_control(session.devices(), "touch");
            Request::Hold(touch.expect("the robot has a bumper"), Duration::from_millis(100))
        }
    };
    session.at(session.now(), request).expect("the plan runs");
}

#[test]
fn no_command_moves_the_robot_in_a_hold_and_the_run_repeats() {
    let graph = graph(ROUNDS);
    let (mut steps, mut held, mut holds, mut seed) = (0, 0, 0, 0);
    while steps < STEPS {
        seed += 1;
        let mut dice = Pcg32::new(seed, 7);
        let mut run = session(&graph, seed);
        let mut before = false;
        for _ in 0..STEPS / 20 {
            if dice.next_u32().is_multiple_of(40) {
                ask(&mut *run, &mut dice);
            }
            match run.next_step(&mut []).expect("the plan starts") {
                Next::BeforeStep => continue,
                Next::Step => steps += 1,
                Next::Ended => break,
            }
            let holds_now = run.is_held();
            if holds_now {
                let asked = commanded(&*run);
                assert_eq!(asked, [0.0; 2], "seed {seed} at {}", run.now());
                held += 1;
            }
            holds += u32::from(holds_now && !before);
            before = holds_now;
        }
        let (end, trace) = (run.now(), run.trace());
        let mut again = session(&graph, seed);
        for (at, request) in run.requests() {
            again.at(*at, request.clone()).expect("it was possible before");
        }
        again.run(end, &mut Open, &mut []).expect("the plan starts");
        assert_eq!(again.trace(), trace, "seed {seed}: the requests repeat the run");
    }
    println!("{steps} steps in {seed} runs, {holds} holds, {held} steps held");
    assert!(holds > 300 && held > STEPS / 5, "{holds} holds, {held} steps held");
}

#[test]
fn a_held_drive_ends_where_it_would_have_ended() {
    let drive = "use carbot
plan Drive {
    start ahead
    actor ahead: Forward(distance = 1.2 m) { ForwardSuccessful -> terminate }
}
";
    let graph = graph(drive);
    let end = |holds: &[u64]| {
        let mut run = session(&graph, 1);
        for from in holds {
            let at = |millis| Instant::ZERO + Duration::from_millis(millis);
            run.at(at(*from), Request::Pause).unwrap();
            run.at(at(from + 700), Request::Release(Release::Continue)).unwrap();
        }
        run.run(Instant::ZERO + Duration::from_secs(60), &mut Open, &mut []).unwrap();
        assert!(run.ending().is_some(), "it arrives");
        let pose = find_signal(run.devices(), "robot", "pose").unwrap();
        let mut place = [f64::NAN; 2];
        run.read(pose, &mut |sample| {
            if let SampleRef::Pose(frame) = sample {
                place = [frame.pose.x, frame.pose.y];
            }
        });
        place
    };
    let (whole, parts) = (end(&[]), end(&[1000, 2203, 4507]));
    let apart = (whole[0] - parts[0]).hypot(whole[1] - parts[1]);
    assert!(apart < 0.03, "{apart} m: {whole:?}, {parts:?}");
}
