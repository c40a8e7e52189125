//! What can be said of time before a plan runs: demand, longest step, responses, and how long the
//! robot may go on after a supervisor's condition has come to hold.
//!
//! All of it rests on what the toolboxes declare (`budget`, `stop`) and on the plan's periods and
//! deadlines. Where a declaration is missing, the result says so instead of guessing. Every search
//! goes over sub-plans once, however often they are used, so the effort is linear.

mod before;
mod check;
mod contribution;
mod cost;
mod held;
mod level;
mod response;
mod step;
mod table;
mod target;

use std::sync::Arc;

use crate::flow::view::View;
use crate::flow::{self, Model};
use crate::graph::{self, Graph};
use afp_syntax::source::Span;

use contribution::Outside;
use level::Levels;
use response::Bounds;

pub(crate) use check::check_everywhere;
pub use check::check_target;
pub use target::{BUILT_IN, Budgets, BuiltIn, Target};

/// What is known of the time behaviour of a plan and its sub-plans.
#[derive(Clone, Debug)]
pub struct Timing {
    pub plan: String,
    /// The longest that one step may take, that which starts the plan too, budgets added up: supervisors, the active actor,
    /// and what is entered behind it. `Err` names the declaration that is missing.
    pub longest_step: Result<u64, String>,
    /// What that step is made of, and the path of the element that is active then; `None` where it is not known.
    pub step_parts: Option<StepParts>,
    /// The greatest share of the processor that is ever asked for (1 is all of it), and the path of
    /// the element that is active then. `Err` names the declaration that is missing.
    pub demand: Result<(f64, String), String>,
    /// What the budgets are.
    pub basis: Basis,
    /// Every supervisor that can run, sub-plans last. One in a sub-plan stands for all uses of it,
    /// at its worst.
    pub supervisors: Vec<SupervisorTiming>,
}

/// Where the budgets come from that everything rests on; none of them is measured here.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// The target that they hold for.
    pub target: Option<String>,
    /// How many times what is declared.
    pub slowdown: f64,
    /// How many templates have a budget of their own on the target.
    pub given: usize,
}

/// What the longest step is made of, in nanoseconds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepParts {
    /// The path of the element that is active when it begins; empty where the step is that which starts the plan.
    pub path: String,
    /// Polls of the supervisors, and their starts where the plan starts.
    pub supervisors: u64,
    /// The poll of the active element, or what its interruption takes.
    pub active: u64,
    /// What is entered behind it: its supervisors, started and asked, and its own start.
    pub entered: u64,
}

/// What is known of one supervisor.
#[derive(Clone, Debug)]
pub struct SupervisorTiming {
    /// The plan that it stands in.
    pub plan: String,
    /// Its path in that plan, such as `searchFirstWall.touch`.
    pub path: String,
    /// When it is polled.
    pub timing: graph::Timing,
    /// How long after its release its poll is over. `Err` names the declaration that is missing.
    pub response: Result<Response, String>,
    /// How long after its condition has come to hold the robot stands still; `None` when it
    /// interrupts nothing.
    pub interruption: Option<Interruption>,
    /// Its name in the text.
    pub span: Span,
}

/// The response of a supervisor and what it is made of, in nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Response {
    /// How late the target may notice the release: one tick.
    pub tick: u64,
    /// The step that is running then; a step is not interrupted.
    pub step: u64,
    /// The supervisors that are polled before.
    pub before: u64,
    /// What an event of one of those interrupts and leads to, up to the look in which the others are asked; zero for one
    /// that ends with what is interrupted.
    pub entered: u64,
    /// The supervisor's own poll, with what is computed before `resume`.
    pub own: u64,
}

impl Response {
    /// The sum of all parts.
    pub fn total(&self) -> u64 {
        let parts = [self.tick, self.step, self.before, self.entered, self.own];
        parts.into_iter().fold(0, u64::saturating_add)
    }
}

/// How far the bound of an interruption can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// It follows from the declared budgets.
    Proved,
    /// It holds when every deadline is kept, which does not follow from the declared budgets; or while nobody outside
    /// writes an entry in which a loop of computations counts.
    Assumed,
    /// There is none, since a declaration is missing.
    Unknown,
}

impl Trust {
    pub fn as_str(self) -> &'static str {
        match self {
            Trust::Proved => "proved",
            Trust::Assumed => "assumed",
            Trust::Unknown => "unknown",
        }
    }
}

/// From the moment at which a condition holds at the sensor to standstill.
///
/// Delays of the sensor itself come on top. It does not hold across a look that diverts, nor for an
/// event that is not taken because its target is active already.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interruption {
    /// How far it can be trusted.
    pub trust: Trust,
    /// Its parts in nanoseconds, by name: `period`, `response` or `deadline`, `interrupt`, `stop`.
    pub terms: Vec<(&'static str, u64)>,
    /// Why it is not proved; empty when it is.
    pub reason: String,
}

impl Interruption {
    /// The sum of all terms; `None` when the bound is unknown.
    pub fn total(&self) -> Option<u64> {
        let sum = || self.terms.iter().fold(0u64, |sum, (_, time)| sum.saturating_add(*time));
        (self.trust != Trust::Unknown).then(sum)
    }
}

/// Works out the timing of a plan; without a target, ticks count as infinitely fine, and budgets are as declared.
pub fn timing(graph: &Graph, target: Option<&Target>) -> Timing {
    let model = model(graph, target);
    let summaries = flow::sum_up(&model);
    let view = |plan| View::new(&model, plan, &summaries);
    let views: Vec<View<'_>> = graph.plans.iter().map(view).collect();
    let levels = Levels::of(&views);
    let outside = Outside::of(&views, &levels, graph.main.index());
    let main = &levels.all[graph.main.index()];
    let tick = target.and_then(|target| target.tick).unwrap_or(0);
    let longest = main.longest_step.or(&main.entering);
    let open = flow::open_to_writes(&views[graph.main.index()]);
    let bounds = Bounds { longest_step: &longest, open, tick };
    let supervisors = response::rows(&views, &levels, &outside, &bounds);
    let demand = match &main.demand_unknown {
        Some(reason) => Err(reason.to_string()),
        None => Ok((main.demand, levels.busiest(&views, graph.main.index()))),
    };
    let plan = graph.main().name.clone();
    let step_parts = longest.known().ok().map(|_| levels.step_parts(&views, graph.main.index()));
    let basis = basis(&model, target);
    Timing { plan, longest_step: longest.known(), step_parts, demand, basis, supervisors }
}

/// The plans, with toolboxes as they are on a target.
fn model<'graph>(graph: &'graph Graph, target: Option<&Target>) -> Model<'graph> {
    let adapted = |toolbox| target.map_or_else(|| Arc::clone(toolbox), |it| it.adapted(toolbox));
    Model {
        plans: graph.plans.iter().map(Some).collect(),
        order: (0..graph.plans.len()).collect(),
        toolboxes: graph.toolboxes.iter().map(adapted).collect(),
    }
}

fn basis(model: &Model<'_>, target: Option<&Target>) -> Basis {
    let templates = model.toolboxes.iter().flat_map(|toolbox| {
        toolbox.templates.iter().map(|template| (toolbox.name.as_str(), template.name.as_str()))
    });
    let given =
        |target: &Target| templates.filter(|(of, name)| target.given(of, name).is_some()).count();
    Basis {
        target: target.map(|target| target.name.clone()),
        slowdown: target.map_or(1.0, |target| target.slowdown),
        given: target.map_or(0, given),
    }
}
