//! Flow checks: reachability, values before reads, endings.
//!
//! They run on complete plans, sub-plans first, and need only a [`Summary`] of sub-plans. Only
//! reachable elements count. Every search is iterative, so that large plans do not overflow the
//! stack.

mod assigned;
mod cycles;
mod dataflow;
mod endless;
mod failing;
mod frozen;
mod ignored;
mod lasting;
mod recovery;
mod resumed;
pub(crate) mod strong;
mod suspended;
mod toggle;
mod unreachable;
mod unread;
pub(crate) mod view;

use std::sync::Arc;

use crate::graph::{Plan, TemplateId};
use crate::toolbox::{Template, Toolbox};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Span;

pub(crate) use cycles::{components, is_quick, open_to_writes, unwind};
use view::View;

/// The plans of a compilation; [`crate::graph::Component::SubPlan`] is an index into them.
pub(crate) struct Model<'a> {
    /// Plans without errors; `None` for others, which are assumed to be correct.
    pub plans: Vec<Option<&'a Plan>>,
    /// All indices of `plans`, sub-plans before their users.
    pub order: Vec<usize>,
    /// The toolboxes of template ids.
    pub toolboxes: Vec<Arc<Toolbox>>,
}

impl Model<'_> {
    pub fn template(&self, id: TemplateId) -> &Template {
        &self.toolboxes[id.toolbox.index()].templates[usize::from(id.index)]
    }
}

/// Index of the ending `OK` in the tables of a [`Summary`].
pub(crate) const OK: usize = 0;
/// Index of the ending `Interrupted`.
pub(crate) const INTERRUPTED: usize = 1;
/// Index of failing, only in [`Summary::ends`]: no state of a sub-plan stands for it.
pub(crate) const FAILED: usize = 2;

/// Flow properties of a plan for its users.
#[derive(Clone, Debug)]
pub(crate) struct Summary {
    /// Whether it can end as `OK`, as `Interrupted`, by failing.
    pub ends: [bool; 3],
    /// Whether it can do so within the step that starts it.
    pub instant: [bool; 2],
    /// A reachable edge to `fail`.
    pub fails: Option<Span>,
    /// A reachable actor that cannot continue after an interruption.
    pub rigid: Option<suspended::Rigid>,
    /// Whether it has only computations, so that it never takes time.
    pub timeless: bool,
    /// Number of edges per step, if loops of computations determine it and the plan never takes
    /// time.
    pub taken: i64,
    /// For each ending and `out` entry: a path to the ending on which the entry is not written.
    pub unset: [Vec<Option<String>>; 2],
}

pub(crate) fn check(model: &Model<'_>, diags: &mut Diagnostics) {
    in_order(model, |view| check_plan(view, diags));
}

/// Summarises all plans of a model without the parts for checks: `unset` is empty.
pub(crate) fn sum_up(model: &Model<'_>) -> Vec<Option<Summary>> {
    in_order(model, |view| {
        let (instant, timeless) = cycles::instant_endings(view);
        let (ends, fails) = (endless::endings(view), failing::edge(view));
        let rigid = suspended::rigid(view);
        Summary { ends, fails, instant, rigid, timeless, taken: 0, unset: Default::default() }
    })
}

/// Summarises each plan after its sub-plans.
fn in_order(
    model: &Model<'_>,
    mut sum_up: impl FnMut(&View<'_>) -> Summary,
) -> Vec<Option<Summary>> {
    let mut summaries: Vec<Option<Summary>> = vec![None; model.plans.len()];
    for place in &model.order {
        let Some(plan) = model.plans[*place] else { continue };
        summaries[*place] = Some(sum_up(&View::new(model, plan, &summaries)));
    }
    summaries
}

fn check_plan(view: &View<'_>, diags: &mut Diagnostics) -> Summary {
    unreachable::check(view, diags);
    unread::check(view, diags);
    ignored::check(view, diags);
    lasting::check(view, diags);
    frozen::check(view, diags);
    resumed::check(view, diags);
    recovery::check(view, diags);
    toggle::check(view, diags);
    suspended::check(view, diags);
    let ends = endless::check(view, diags);
    let unset = assigned::check(view, diags);
    let taken = cycles::check(view, diags);
    let fails = failing::check(view, diags);
    let (instant, timeless) = cycles::instant_endings(view);
    let taken = if timeless { taken } else { 0 };
    Summary { ends, fails, instant, rigid: suspended::rigid(view), timeless, taken, unset }
}
