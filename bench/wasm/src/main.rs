//! The parts of an editor in a browser, in one program: compiler, formatter, drawing, edits,
//! interpreter and simulator.
//!
//! `cargo xtask gate` compiles it to WebAssembly and runs it in Node.js; the benchmark reports its
//! size.

use std::hint::black_box;

use afp::load::{LoadedPlan, Registry};
use afp::trace::NoTrace;
use afp::{Instant, Scheduler, Wake};
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_dsl::{Compiled, compile};
use afp_ide::edit::{Change, apply, edit};
use afp_sim::{Simulation, World};
use afp_syntax::item::Item;
use afp_syntax::source::Source;

const PLAN: &str = include_str!("../../../plans/wall_following.afp");
const ROOM: &str = include_str!("../../../worlds/wall_following.toml");

/// The simulated time of a drive.
const END: Instant = Instant::from_nanos(10_000_000_000);

fn main() {
    let text = afp_format::format(black_box(PLAN)).unwrap_or_default();
    assert_eq!(text, PLAN, "the shipped plan is formatted");
    let compiled = compiled(&renamed(&text));
    let drawing = afp_draw::svg(&compiled.outline, &afp_draw::Options::default());
    assert!(drawing.contains("alongTheWall"), "the new name is drawn");
    match &compiled.graph {
        Some(graph) => drive(graph),
        None => panic!("{}", compiled.render(false)),
    }
}

/// The plan with one renamed actor.
fn renamed(text: &str) -> String {
    let item = Item::inner("WallFollowing", "followWall");
    let change = Change::Rename { item, to: "alongTheWall".to_owned() };
    let edits = edit(&[Source::new("plan.afp", text)], &toolboxes(), 0, &change);
    let edits = edits.unwrap_or_else(|why| panic!("{why}"));
    assert!(!edits.is_empty(), "the actor is named");
    apply(text, &edits)
}

fn toolboxes() -> Toolboxes {
    afp_toolboxes::sources().collect()
}

fn compiled(text: &str) -> Compiled {
    let source = Source::new("plan.afp", text);
    compile(&source, &toolboxes(), &Texts::default())
}

fn drive(graph: &Graph) {
    let mut registry = Registry::<Simulation>::new();
    afp_std::templates::register(&mut registry);
    afp_carbot::templates::register(&mut registry);
    let plan = LoadedPlan::new(graph, &registry).unwrap_or_else(|why| panic!("{why:?}"));
    let world = World::parse(black_box(ROOM)).unwrap_or_else(|why| panic!("{why:?}"));
    let mut robot = Simulation::new(&world, 1).unwrap_or_else(|why| panic!("{why:?}"));
    let start = robot.truth().pose();
    let mut plan = Scheduler::new(plan);
    let wake = plan.run_until(&mut robot, &mut NoTrace, END);
    assert!(matches!(wake, Ok(Wake::At(_))), "{wake:?}");
    let (from, to) = (start, robot.truth().pose());
    assert!((from.x - to.x).hypot(from.y - to.y) > 0.1, "the robot has moved");
}
