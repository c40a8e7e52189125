//! Static timing analysis: demand, longest step, responses, and the time from a supervisor's
//! condition to standstill.
//!
//! It is based on the toolboxes' declarations (`budget`, `stop`) and on the plan's periods and
//! deadlines. If a declaration is missing, the result is unknown. Every search visits a sub-plan
//! once, so the cost is linear.

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

/// Timing of a plan and its sub-plans.
#[derive(Clone, Debug)]
pub struct Timing {
    pub plan: String,
    /// Longest duration of a step, including the plan's first, as a sum of budgets: supervisors,
    /// the active actor, and everything entered after it. `Err` names the missing declaration.
    pub longest_step: Result<u64, String>,
    /// The parts of that step, and the path of its active element; `None` if unknown.
    pub step_parts: Option<StepParts>,
    /// Maximum share of the processor (1 is all), and the path of the element that is then active.
    /// `Err` names the missing declaration.
    pub demand: Result<(f64, String), String>,
    pub basis: Basis,
    /// Every supervisor that can run, sub-plans last. One in a sub-plan stands for all its uses, at
    /// its worst.
    pub supervisors: Vec<SupervisorTiming>,
}

/// Origin of the budgets; none is measured here.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// Their target.
    pub target: Option<String>,
    /// Factor on the declared budgets.
    pub slowdown: f64,
    /// Number of templates with their own budget on the target.
    pub given: usize,
}

/// Parts of the longest step, in nanoseconds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepParts {
    /// Path of the element that is active at its beginning; empty for the plan's first step.
    pub path: String,
    /// Polls of the supervisors, and their starts in the first step.
    pub supervisors: u64,
    /// Poll or interruption of the active element.
    pub active: u64,
    /// Everything entered after it: supervisors, their first polls, and starts.
    pub entered: u64,
}

#[derive(Clone, Debug)]
pub struct SupervisorTiming {
    pub plan: String,
    /// Its path in that plan, such as `searchFirstWall.touch`.
    pub path: String,
    pub timing: graph::Timing,
    /// Time from its release to the end of its poll. `Err` names the missing declaration.
    pub response: Result<Response, String>,
    /// Time from its condition to standstill; `None` if it interrupts nothing.
    pub interruption: Option<Interruption>,
    pub span: Span,
}

/// Parts of a supervisor's response, in nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Response {
    /// Delay in noticing the release: one tick.
    pub tick: u64,
    /// The running step, which is not interrupted.
    pub step: u64,
    /// Earlier polls of other supervisors.
    pub before: u64,
    /// Interruption and entries caused by an event of these, up to the look with the other polls;
    /// zero for a supervisor that ends with the interrupted element.
    pub entered: u64,
    /// Its own poll, with computations before `resume`.
    pub own: u64,
}

impl Response {
    pub fn total(&self) -> u64 {
        let parts = [self.tick, self.step, self.before, self.entered, self.own];
        parts.into_iter().fold(0, u64::saturating_add)
    }
}

/// Trust in the bound of an interruption.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// It follows from the declared budgets.
    Proved,
    /// It holds if every deadline is kept, which does not follow from the declared budgets; or if
    /// no external write changes an entry in which a loop of computations counts.
    Assumed,
    /// Unknown, since a declaration is missing.
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

/// Time from a condition at the sensor to standstill.
///
/// The sensor's delay is added to it. It does not apply across a look that diverts, nor to an event
/// that is not taken because its target is already active.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interruption {
    pub trust: Trust,
    /// Its parts in nanoseconds, by name: `period`, `response` or `deadline`, `interrupt`, `stop`.
    pub terms: Vec<(&'static str, u64)>,
    /// Why it is not proved; empty if it is.
    pub reason: String,
}

impl Interruption {
    /// The sum of all terms; `None` if unknown.
    pub fn total(&self) -> Option<u64> {
        let sum = || self.terms.iter().fold(0u64, |sum, (_, time)| sum.saturating_add(*time));
        (self.trust != Trust::Unknown).then(sum)
    }
}

/// Computes the timing of a plan; without a target, ticks are infinitely fine and budgets as
/// declared.
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

/// The plans with the toolboxes' budgets on a target.
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
