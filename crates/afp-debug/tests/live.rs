//! The adapter next to a run that drives on by itself, in virtual time: holds, steps, the lease.

mod common;

use std::sync::Arc;

use afp_core::devices::find_signal;
use afp_core::{Duration, Instant};
use afp_debug::{Adapter, LiveTarget, Relay};
use afp_session::{AnySession, Observer, Request, SampleRef, Steering, Wire, remote};
use common::{Clients, Texted, compiled, session};

const PLAN: &str = "use std
use carbot

plan Rounds {
    start ahead
    var rounds: int = 0
    actor ahead: Forward(distance = 30 cm) { ForwardSuccessful -> count }
    computation count: Count(value = rounds, limit = 9, next => rounds) {
        Again -> corner
        Done -> corner
    }
    actor corner: Turn(angle = 90 deg) { TurnSuccessful -> rest }
    actor rest: Wait(duration = 300 ms) { Elapsed -> ahead }
}
";

/// A run with clients next to it.
struct Live {
    session: Box<dyn AnySession>,
    steering: Steering,
    wire: Wire,
    relay: Relay,
    clients: Clients,
    ticked: Instant,
}

impl Live {
    fn new() -> Live {
        let (graph, program) = compiled(PLAN, "plan.afp").unwrap();
        let session = session(&graph, &Default::default()).unwrap();
        let (remote, steering, wire) = remote();
        let (target, relay) = LiveTarget::new(Arc::new(program), &*session, remote);
        let adapter = Adapter::beside(Box::new(Texted(PLAN.to_owned())), Box::new(target));
        let ticked = session.now();
        Live { session, steering, wire, relay, clients: Clients::of(adapter), ticked }
    }

    /// A run with an operator.
    fn operated() -> Live {
        let mut live = Live::new();
        live.say(r#"initialize {"adapterID": "afp", "clientName": "x"}"#);
        live.say(r#"attach {"role": "operator"}"#);
        live.say("configurationDone");
        live
    }

    fn say(&mut self, line: &str) {
        self.clients.say(line);
    }

    /// Lets the robot drive up to the next event of the run, and the adapter look at it.
    fn step(&mut self) {
        let to: &mut [&mut dyn Observer] = &mut [&mut self.relay, &mut self.wire];
        if self.steering.is_asked() {
            let now = self.session.now();
            self.steering.apply(&mut *self.session, now, to);
        }
        self.session.next_step(to).expect("the plan starts");
        let passed = self.session.now().since(self.ticked).as_nanos() / 1_000_000;
        if passed > 0 {
            self.ticked = self.session.now();
            self.clients.tick(Some(passed));
        }
    }

    /// Drives for a time; the operator answers if wanted.
    fn pass(&mut self, millis: u64, answers: bool) {
        let end = self.session.now() + Duration::from_millis(millis);
        while self.session.now() < end {
            if answers {
                self.say("answer");
            }
            self.step();
        }
    }

    fn commands(&self) -> [f64; 2] {
        ["asked_speed", "asked_turn"].map(|name| {
            let signal = find_signal(self.session.devices(), "navigator", name).unwrap();
            let mut value = f64::NAN;
            self.session.read(signal, &mut |sample| {
                if let SampleRef::Float(number) = sample {
                    value = number;
                }
            });
            value
        })
    }

    fn told(&self, text: &str) -> bool {
        self.clients.told.contains(text)
    }
}

#[test]
fn a_breakpoint_holds_at_the_step_after_its_event() {
    let mut live = Live::operated();
    live.say(
        r#"setFunctionBreakpoints {"breakpoints": [{"name": "corner", "condition": "rounds == 2"}]}"#,
    );
    let since = (0..2_000).find(|_| {
        live.say("answer");
        live.step();
        live.session.is_held()
    });
    assert!(since.is_some(), "{}", live.clients.told);
    live.pass(50, true);
    assert!(live.told(r#""reason":"function breakpoint""#), "{}", live.clients.told);
    assert_eq!(live.commands(), [0.0; 2]);
    // The second round, and no time after the start of the element.
    let lines: Vec<_> = live.clients.told.lines().collect();
    let time = |what: &str| {
        let says = |line: &&&str| line.contains(what) && line.contains("event output");
        let line = lines.iter().rev().find(says).unwrap();
        let text = line.split(r#""output":""#).nth(1).unwrap().trim_start();
        text.split(' ').next().unwrap().parse::<f64>().unwrap()
    };
    assert!(time("corner held") - time("corner started") <= 0.0101, "{}", live.clients.told);
    live.say(r#"continue {"threadId": 1}"#);
    live.pass(500, true);
    assert!(!live.session.is_held() && live.told("event continued"), "{}", live.clients.told);
}

#[test]
fn a_step_without_an_operator_ends_in_a_hold() {
    let mut live = Live::operated();
    live.pass(200, true);
    live.say(r#"pause {"threadId": 1}"#);
    live.pass(50, true);
    assert!(live.session.is_held());
    live.say(r#"next {"threadId": 1}"#);
    live.pass(200, true);
    assert!(!live.session.is_held(), "the step drives: {}", live.clients.told);
    live.pass(1_000, false);
    assert!(live.session.is_held(), "{}", live.clients.told);
    assert!(live.told("does not answer"), "{}", live.clients.told);
    live.pass(5_000, false);
    assert!(live.session.is_held(), "it does not start by itself: {}", live.clients.told);
}

#[test]
fn a_robot_that_drives_continues_without_its_operator_and_its_breakpoints() {
    let mut live = Live::operated();
    live.pass(100, true);
    live.say(r#"setFunctionBreakpoints {"breakpoints": [{"name": "rest"}]}"#);
    live.say(r#"afp/force {"path": "rounds", "value": "5", "seconds": 100}"#);
    live.clients.lose(1);
    live.pass(9_000, false);
    assert!(!live.session.is_held());
    assert!(live.session.requests().len() <= 2, "{:?}", live.session.requests());
}

#[test]
fn requests_are_taken_a_few_at_a_time_and_too_many_are_refused() {
    let mut live = Live::operated();
    live.step();
    for number in 0..100 {
        live.say(&format!(r#"setExpression {{"expression": "rounds", "value": "{number}"}}"#));
    }
    assert!(live.told("too many requests waiting"), "{}", live.clients.told);
    live.step();
    assert_eq!(live.session.requests().len(), 8);
    live.pass(200, true);
    assert_eq!(live.session.requests().len(), 64);
    for refused in ["stepBack", "restart", r#"afp/seek {"at": 1}"#, "reverseContinue"] {
        live.say(refused);
    }
    assert_eq!(live.clients.told.matches("the robot itself runs this plan").count(), 4);
}

/// A small generator of random numbers, equal on every machine.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }
}

#[test]
fn no_random_clients_move_a_held_robot() {
    let commands = [
        r#"pause {"threadId": 1}"#,
        r#"continue {"threadId": 1}"#,
        r#"next {"threadId": 1}"#,
        r#"afp/force {"path": "ahead.ForwardSuccessful", "seconds": 1}"#,
        r#"afp/force {"path": "rounds", "value": "3", "seconds": 1}"#,
        r#"setFunctionBreakpoints {"breakpoints": [{"name": "corner"}, {"name": "rest"}]}"#,
        r#"setFunctionBreakpoints {"breakpoints": []}"#,
        r#"afp/role {"take": "operator"}"#,
        r#"attach {"role": "operator"}"#,
    ];
    let mut held = 0;
    for seed in 0..6 {
        let (mut live, mut dice) = (Live::operated(), Dice(seed));
        let (mut client, mut answers, mut released, mut before) = (1, true, 0, false);
        for step in 0..2_000 {
            match dice.below(100) {
                0..3 => {
                    let line = commands[dice.below(commands.len() as u64) as usize];
                    live.clients.say_as(client, line);
                    if ["continue", "next"].iter().any(|word| line.starts_with(word)) {
                        released = step;
                    }
                }
                3 => answers = !answers,
                4 if dice.below(10) == 0 => {
                    live.clients.lose(client);
                    client += 1;
                    live.clients.say_as(client, r#"attach {"role": "operator"}"#);
                }
                _ => {}
            }
            if answers {
                live.clients.say_as(client, "answer");
            }
            live.step();
            let now = live.session.is_held();
            // A request is done one or two events later.
            assert!(now || !before || step - released < 4, "seed {seed}: it starts by itself");
            if now {
                assert_eq!(live.commands(), [0.0; 2], "seed {seed}");
                held += 1;
            }
            before = now;
        }
        let (end, trace) = (live.session.now(), live.session.trace());
        let (graph, _) = compiled(PLAN, "plan.afp").unwrap();
        let mut again = session(&graph, &Default::default()).unwrap();
        for (at, request) in live.session.requests().to_vec() {
            again.at(at, request).unwrap();
        }
        again.run(end, &mut afp_session::Open, &mut []).unwrap();
        assert_eq!(again.trace(), trace, "seed {seed}: the requests repeat the run");
        assert!(live.session.requests().iter().any(|(_, it)| *it == Request::Pause));
    }
    assert!(held > 1_000, "{held}");
}
