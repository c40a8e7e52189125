//! Random plans with `suspend` and `return`, nested and with faults. The scripted components check
//! the calls of rule 17: start, then any number of suspend and resume, then one end. They also check
//! that one actor moves at a time, that suspended components are not polled, and that each start and
//! return has a look. `AFP_SCHEDULES` sets the number of plans, each of which runs without and with
//! faults.

use afp_core::trace::{Ending, NoTrace};
use afp_core::{Fault, Instant, Scheduler, StillClock, Wake};

use crate::support::build::{
    Builder, ElementSpec, SupervisorSpec, actor, computation, guard, plan, sub_plan,
};
use crate::support::scripted::Scripted;
use crate::support::world::{Dice, World};

#[derive(Clone, Copy, PartialEq)]
enum To {
    Element(usize),
    Suspend(usize),
    Return,
    Resume,
    Ignore,
    Terminate,
    Fail,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Actor,
    Computation,
    SubPlan,
}

struct Element {
    kind: Kind,
    period: u64,
    states: Vec<To>,
    on_error: Option<To>,
    locals: Vec<Guard>,
    /// The target of the first event of a global supervisor.
    reaction: Option<(usize, To)>,
}

struct Guard {
    period: u64,
    events: Vec<To>,
    lasting: bool,
    continues: bool,
}

struct Draft {
    elements: Vec<Element>,
    globals: Vec<Guard>,
}

impl Draft {
    fn random(dice: &mut Dice, depth: u64) -> Draft {
        let count = 2 + dice.below(5) as usize;
        let elements = (0..count).map(|_| Element::random(dice, count, depth)).collect();
        let globals: Vec<_> = (0..dice.below(3)).map(|_| Guard::random(dice, count)).collect();
        let mut draft = Draft { elements, globals };
        for element in &mut draft.elements {
            if element.kind != Kind::Computation && !draft.globals.is_empty() && dice.percent(30) {
                let global = dice.below(draft.globals.len() as u64) as usize;
                element.reaction = Some((global, target(dice, count, true)));
            }
        }
        draft
    }

    /// All edges with their element, and whether an event leads along them.
    fn edges(&self) -> Vec<(Option<usize>, bool, To)> {
        let mut edges = Vec::new();
        for (index, element) in self.elements.iter().enumerate() {
            let from = Some(index);
            let states = element.states.iter().copied().chain(element.on_error);
            edges.extend(states.map(|to| (from, false, to)));
            let events = element.locals.iter().flat_map(|guard| &guard.events).copied();
            let events = events.chain(element.reaction.map(|(_, to)| to));
            edges.extend(events.map(|to| (from, true, to)));
        }
        let globals = self.globals.iter().flat_map(|guard| &guard.events);
        edges.extend(globals.map(|to| (None, true, *to)));
        edges
    }

    /// The computations that reach a target through computations only.
    fn reaching(&self, wanted: fn(To) -> bool) -> Vec<bool> {
        let mut found = vec![false; self.elements.len()];
        for _ in 0..self.elements.len() {
            for (index, element) in self.elements.iter().enumerate() {
                let mut targets = element.states.iter().copied().chain(element.on_error);
                let leads = |to| wanted(to) || matches!(to, To::Element(next) if found[next]);
                found[index] |= element.kind == Kind::Computation && targets.any(leads);
            }
        }
        found
    }

    /// Whether the checks of the language accept it, and it suspends.
    fn is_valid(&self) -> bool {
        let mut handlers = vec![false; self.elements.len()];
        for (.., to) in self.edges() {
            if let To::Suspend(handler) = to {
                handlers[handler] = true;
            }
        }
        let holds = self.reaching(|to| matches!(to, To::Resume | To::Suspend(_)));
        let returns = self.reaching(|to| to == To::Return);
        let computes = |index: usize| self.elements[index].kind == Kind::Computation;
        let may = |(from, event, to): (Option<usize>, bool, To)| {
            let handled = from.is_some_and(|from| handlers[from] || returns[from]);
            let held = event || from.is_some_and(computes);
            match to {
                To::Element(to) => {
                    let chained = event || from.is_some_and(|from| holds[from]);
                    !handlers[to] && (!returns[to] || handled) && (!holds[to] || chained)
                }
                To::Return => handled,
                To::Resume | To::Suspend(_) => held,
                To::Ignore => event,
                To::Terminate | To::Fail => true,
            }
        };
        let both = holds.iter().zip(&returns).any(|(holds, returns)| *holds && *returns);
        let computing = (0..handlers.len()).any(|index| handlers[index] && computes(index));
        let start = handlers[0] || holds[0] || returns[0];
        handlers.contains(&true)
            && !both
            && !computing
            && !start
            && self.edges().into_iter().all(may)
    }

    fn build(&self, dice: &mut Dice, depth: u64, path: &str) -> Builder {
        let mut built = plan("random");
        for (index, global) in self.globals.iter().enumerate() {
            built = built.guarded(global.build(&format!("{path}g{index}")));
        }
        for (index, element) in self.elements.iter().enumerate() {
            let name = leak(format!("e{index}"));
            let mut made: ElementSpec = match element.kind {
                Kind::Actor => actor(name),
                Kind::Computation => computation(name),
                Kind::SubPlan => {
                    sub_plan(name, random_plan(dice, depth - 1, &format!("{path}{index}")))
                }
            };
            made = made.every(element.period);
            for (state, to) in ["S0", "S1"].into_iter().zip(&element.states) {
                made = made.on(state, text(*to));
            }
            if let Some(to) = element.on_error {
                made = made.on_error(text(to));
            }
            for (number, local) in element.locals.iter().enumerate() {
                made = made.guarded(local.build(&format!("{path}e{index}s{number}")));
            }
            if let Some((global, to)) = element.reaction {
                let lasting = self.globals[global].lasting;
                made = made.reacts(named(&format!("{path}g{global}"), lasting), "E0", text(to));
            }
            built = built.with(made);
        }
        built
    }
}

impl Element {
    fn random(dice: &mut Dice, count: usize, depth: u64) -> Element {
        let kind = match dice.below(if depth > 0 { 5 } else { 3 }) {
            0 => Kind::Computation,
            4 => Kind::SubPlan,
            _ => Kind::Actor,
        };
        let states = if kind == Kind::Actor { dice.below(3) } else { 2 };
        let state = |dice: &mut Dice| {
            let event = kind == Kind::Computation && dice.percent(50);
            match target(dice, count, event) {
                To::Ignore => To::Terminate,
                to => to,
            }
        };
        Element {
            kind,
            period: 10 + 10 * dice.below(2),
            states: (0..states).map(|_| state(dice)).collect(),
            on_error: dice.percent(50).then(|| target(dice, count, false)),
            locals: match kind {
                Kind::Computation => Vec::new(),
                _ => (0..dice.below(3)).map(|_| Guard::random(dice, count)).collect(),
            },
            reaction: None,
        }
    }
}

impl Guard {
    fn random(dice: &mut Dice, count: usize) -> Guard {
        Guard {
            period: 10 + 10 * dice.below(3),
            events: (0..1 + dice.below(2)).map(|_| target(dice, count, true)).collect(),
            lasting: dice.percent(50),
            continues: dice.percent(50),
        }
    }

    fn build(&self, name: &str) -> SupervisorSpec {
        let mut made = guard(named(name, self.lasting), self.period);
        for (event, to) in ["E0", "E1"].into_iter().zip(&self.events) {
            made = made.on(event, text(*to));
        }
        if self.continues { made.continues() } else { made }
    }
}

/// The scripted platform knows lasting supervisors by the end of their names.
fn named(name: &str, lasting: bool) -> &'static str {
    leak(format!("{name}{}", if lasting { "l" } else { "n" }))
}

fn target(dice: &mut Dice, count: usize, event: bool) -> To {
    let element = dice.below(count as u64) as usize;
    match dice.below(100) {
        0..10 => To::Terminate,
        10..14 => To::Fail,
        14..22 if event => To::Ignore,
        22..30 if event => To::Resume,
        30..62 if event => To::Suspend(element),
        62..74 => To::Return,
        _ => To::Element(element),
    }
}

fn text(to: To) -> &'static str {
    match to {
        To::Element(index) => leak(format!("e{index}")),
        To::Suspend(index) => leak(format!("suspend e{index}")),
        To::Return => "return",
        To::Resume => "resume",
        To::Ignore => "ignore",
        To::Terminate => "terminate",
        To::Fail => "fail",
    }
}

fn leak(text: String) -> &'static str {
    text.leak()
}

fn random_plan(dice: &mut Dice, depth: u64, path: &str) -> Builder {
    loop {
        let draft = Draft::random(dice, depth);
        if draft.is_valid() {
            return draft.build(dice, depth, path);
        }
    }
}

/// Runs a random plan; returns how often actors were suspended and resumed.
fn run(seed: u64, faults: bool) -> (usize, usize) {
    let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let depth = dice.below(3);
    let spec = random_plan(&mut dice, depth, "").build();
    let mut scheduler = Scheduler::new(Scripted::new(spec));
    let mut world = World::random(dice.clone(), faults);
    let mut now = Instant::ZERO;
    let on = (&mut world, &mut NoTrace, &StillClock);
    let mut wake = scheduler.start(on, now).expect("it can start");
    while !matches!(wake, Wake::Ended(_)) && now < Instant::from_nanos(1_500_000_000) {
        now = Instant::from_nanos(
            now.as_nanos() + [5, 10, 10, 35][dice.below(4) as usize] * 1_000_000,
        );
        wake = scheduler.step((&mut world, &mut NoTrace, &StillClock), now);
    }
    scheduler.request_stop();
    scheduler.step((&mut world, &mut NoTrace, &StillClock), now);
    let ending = scheduler.ending().expect("it was stopped");
    assert_ne!(ending, Ending::Error(Fault::INTERNAL), "seed {seed}, faults {faults}");
    if !world.calls.iter().any(|call| call == "emergency stop") {
        assert!(scheduler.plan().is_empty(), "seed {seed}, faults {faults}: a component is left");
    }
    let count =
        |what| world.calls.iter().filter(|call| call.split(' ').nth(1) == Some(what)).count();
    (count("suspend"), count("back"))
}

#[test]
fn rule_17_components_are_called_in_order_in_random_plans() {
    let (mut suspended, mut resumed) = (0, 0);
    let seeds =
        std::env::var("AFP_SCHEDULES").map_or(2000, |count| count.parse().expect("a number"));
    for seed in 0..seeds {
        for faults in [false, true] {
            let counted = std::panic::catch_unwind(|| run(seed, faults));
            let (of_suspend, of_resume) =
                counted.unwrap_or_else(|_| panic!("seed {seed}, faults {faults}"));
            suspended += of_suspend;
            resumed += of_resume;
        }
    }
    assert!(suspended > 1000 && resumed > 300, "{suspended} suspended, {resumed} resumed");
}
