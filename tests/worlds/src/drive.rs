//! Drives one case.

use std::cell::{Cell, RefCell};
use std::fmt::Write;
use std::rc::Rc;

use afp::load::{LoadedPlan, Registry};
use afp_core::rt::NamedPlan;
use afp_core::trace::{Ending, Line, Observe, Record, TraceHash, Verdict};
use afp_core::{Duration, Instant, Scheduler, Wake};
use afp_sim::{Pose, Simulation};

use crate::case::Case;
use crate::contact::{Contact, Diary};
use crate::push::Pushes;
use crate::watch::Watch;
use crate::witness::Witness;

/// How often the truth is looked at.
const LOOK: Duration = Duration::from_millis(20);
/// A robot that is so far from where it takes itself to be, metres, does not know where it is.
const ASTRAY: f64 = 0.5;
/// How long the robot is watched after the end.
const REST: Duration = Duration::from_secs(2);

/// What a case came to.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The hash of its trace.
    pub trace: TraceHash,
    /// How the plan ended, if it did.
    pub ending: Option<Ending>,
    /// Promises that broke, oldest first.
    pub broken: Vec<(Instant, String)>,
    /// What happened, line by line.
    pub timeline: String,
    /// What the robot came to touch, each time, oldest first.
    pub contacts: Vec<Contact>,
    /// What was seen of it on the way.
    pub seen: Seen,
    /// When the plan ended, or the case.
    pub at: Instant,
    /// Where the robot is then.
    pub pose: Pose,
}

/// What is seen of a robot that is looked at every [`LOOK`].
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// For how long its drive was told to move into something that it touched.
    pub pushing: Duration,
    /// For how long it touched something while its drive was told to move, into it or away from it.
    pub touching: Duration,
    /// When and where it did.
    pub pushes: Pushes,
    /// When it first took itself to be more than [`ASTRAY`] from where it was.
    pub astray: Option<Instant>,
}

impl Seen {
    fn look(&mut self, robot: &Witness, things: &[String]) {
        if self.pushes.look(robot, things) {
            self.pushing += LOOK;
        }
        let truth = robot.sim.truth();
        if truth.touching().next().is_some() && !truth.is_halted() {
            self.touching += LOOK;
        }
        let off = robot.sim.localisation_error().filter(|[off, _]| *off > ASTRAY);
        self.astray = self.astray.or(off.map(|_| robot.sim.now()));
    }
}

/// Drives a case to its end.
///
/// # Panics
/// The simulator, the scheduler or a template panics, which they should not; or the plan lacks an input of the case.
pub fn run(case: &Case) -> Outcome {
    let plan = loaded(case);
    let names = plan.names();
    let sim = Simulation::new(&case.world, case.seed).expect("the room can be built");
    let watch = Rc::new(RefCell::new(watch(case, &sim)));
    let (mut trace, mut timeline) = (TraceHash::default(), String::new());
    let diary = RefCell::new(Diary::default());
    let mut sink = Observe(|at: Instant, record: &Record<'_>| {
        trace.record(at, record, &names);
        watch.borrow_mut().on_record(at, record, &names);
        diary.borrow_mut().on_record(at, record, &names);
        if !matches!(record, Record::Input { .. } | Record::Polled { verdict: Verdict::Clear, .. })
        {
            let _ = writeln!(timeline, "{}", Line { at, record, names: &names });
        }
    });
    let clock = sim.clock();
    let mut robot = Witness { sim, watch: Rc::clone(&watch), counted: Cell::default() };
    let mut scheduler = Scheduler::new(plan);
    for (entry, value) in &case.inputs {
        scheduler.set_named(entry, value).expect("the plan has such an input");
    }
    let start = scheduler.start((&mut robot, &mut sink, &clock), Instant::ZERO);
    let mut wake = start.expect("every entry has a value");
    let (mut end, mut look, mut next) = (case.until, Instant::ZERO, 0);
    let (mut seen, mut at) = (Seen::default(), case.until);
    let things: Vec<String> = case.world.obstacles.iter().map(|it| it.name.clone()).collect();
    while robot.sim.now() < end {
        let due = match wake {
            Wake::At(due) => due.max(clock.free()),
            Wake::Ended(_) | Wake::NotStarted => Instant::MAX,
        };
        let stimulus = case.chance.0.get(next).map_or(Instant::MAX, |(at, _)| *at);
        robot.sim.advance_to(due.min(look).min(stimulus).min(end));
        let now = robot.sim.now();
        if now == look {
            watch.borrow_mut().look(&robot.sim);
            diary.borrow_mut().poses.push(robot.sim.truth().pose());
            seen.look(&robot, &things);
            look += LOOK;
        }
        case.chance.happen(&mut next, &mut robot.sim);
        if due <= now {
            watch.borrow_mut().step(now);
            wake = scheduler.step((&mut robot, &mut sink, &clock), now);
            watch.borrow_mut().stepped(now);
            if matches!(wake, Wake::Ended(_)) {
                // Nobody helps the robot: what the plan did must be enough.
                (at, end) = (now, now + REST);
            }
        }
    }
    let (ending, truth) = (scheduler.ending(), robot.sim.truth());
    let contacts = diary.borrow().contacts(&case.world, truth.collisions(), LOOK);
    let pose = truth.pose();
    drop((robot, scheduler));
    let watch = Rc::into_inner(watch).expect("nobody else holds it any more");
    let broken = watch.into_inner().broken();
    Outcome { trace, ending, broken, timeline, contacts, seen, at, pose }
}

/// Whoever watches a case, before it begins.
fn watch(case: &Case, sim: &Simulation) -> Watch {
    let reach = case.world.obstacles.iter().flat_map(|obstacle| obstacle.outline.corners());
    let reach = reach.flatten().fold(0.0, f64::max);
    let mut watch = Watch::new(sim, stop_time(case), reach);
    watch.happened(&case.chance);
    watch
}

/// The plan of a case, with the Rust of its templates.
fn loaded(case: &Case) -> LoadedPlan<Witness> {
    let mut registry = Registry::new();
    afp_std::templates::register(&mut registry);
    afp_carbot::templates::register(&mut registry);
    LoadedPlan::new(&case.plan.graph, &registry).expect("every template has its Rust")
}

/// The longest stop time that a template of the plan's toolboxes declares.
fn stop_time(case: &Case) -> Duration {
    let toolboxes = case.plan.graph.toolboxes.iter();
    let stops = toolboxes.flat_map(|toolbox| &toolbox.templates).filter_map(|each| each.stop);
    Duration::from_nanos(stops.max().unwrap_or(0))
}
