//! Drives a case.

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

/// The interval of checks against ground truth.
const LOOK: Duration = Duration::from_millis(20);
/// The distance between true and estimated position above which the robot is lost, in metres.
const ASTRAY: f64 = 0.5;
/// The time for which the robot is watched after the end.
const REST: Duration = Duration::from_secs(2);

/// The result of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub trace: TraceHash,
    /// How the plan ended, if it did.
    pub ending: Option<Ending>,
    /// Violated rules, oldest first.
    pub broken: Vec<(Instant, String)>,
    /// The events, line by line.
    pub timeline: String,
    /// The contacts of the robot, oldest first.
    pub contacts: Vec<Contact>,
    /// The observations.
    pub seen: Seen,
    /// The number of steps.
    pub steps: u64,
    /// The end of the plan, or of the case.
    pub at: Instant,
    /// The robot's pose at that time.
    pub pose: Pose,
}

/// Observations of the robot at each [`LOOK`].
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// The time in which its drive was commanded to move into a touched obstacle.
    pub pushing: Duration,
    /// The time in which it touched an obstacle while its drive was commanded to move in any
    /// direction.
    pub touching: Duration,
    /// The times and places of pushes.
    pub pushes: Pushes,
    /// The first time when its estimate was off by more than [`ASTRAY`].
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
/// The simulator, the scheduler or a template panics, which is a bug; or the case lacks an input of
/// the plan.
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
    let (mut seen, mut at, mut steps) = (Seen::default(), case.until, 1);
    let things: Vec<_> = case.world.obstacles.iter().map(|it| it.name.clone()).collect();
    while robot.sim.now() < end {
        let due = match wake {
            Wake::At(due) => due.max(clock.free()),
            Wake::Ended(_) | Wake::NotStarted => Instant::MAX,
        };
        let stimulus = case.chance.0.get(next).map_or(Instant::MAX, |(at, _)| *at);
        robot.sim.advance_to(due.min(look).min(stimulus).min(end));
        let now = robot.sim.now();
        if let Some(fault) = robot.aborts().filter(|_| scheduler.ending().is_none()) {
            wake = scheduler.abort((&mut robot, &mut sink, &clock), fault);
            (at, end) = (now, now + REST);
        }
        if now == look {
            watch.borrow_mut().look(&robot.sim);
            diary.borrow_mut().poses.push(robot.sim.truth().pose());
            seen.look(&robot, &things);
            look += LOOK;
        }
        case.chance.happen(&mut next, &mut robot.sim);
        if due <= now {
            steps += 1;
            watch.borrow_mut().step(now);
            wake = scheduler.step((&mut robot, &mut sink, &clock), now);
            watch.borrow_mut().stepped(now);
            if matches!(wake, Wake::Ended(_)) {
                (at, end) = (now, now + REST);
            }
        }
    }
    let (ending, truth) = (scheduler.ending(), robot.sim.truth());
    let contacts = diary.borrow().contacts(&case.world, truth.collisions(), LOOK);
    let pose = truth.pose();
    drop((robot, scheduler));
    let watch = Rc::into_inner(watch).expect("it has no other owner");
    let broken = watch.into_inner().broken();
    Outcome { trace, ending, broken, timeline, contacts, seen, steps, at, pose }
}

/// The watch of a case, before it begins.
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
