//! Inlay hints: the timing bound of each supervisor.

use crate::View;
use crate::hover::bound;
use afp_dsl::outline::Component;
use afp_dsl::timing::Timing;
use afp_syntax::source::Span;

/// A text shown after a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// The empty span before it.
    pub at: Span,
    pub label: String,
    /// The parts of the bound.
    pub why: String,
}

/// Returns the reaction bound of each valid supervisor in the file, in source order: those of the
/// compiled plan and of its sub-plans.
pub fn hints(view: &View) -> Vec<Hint> {
    let Some(Timing { supervisors: rows, .. }) = view.compiled.timing() else { return Vec::new() };
    let supervisors = view.plans().flat_map(|plan| plan.all_supervisors());
    let hint = |supervisor: &Component| {
        let name = supervisor.name.as_ref()?.span;
        let (label, why) = bound(rows.iter().find(|row| row.span == name)?)?;
        Some(Hint { at: head(supervisor)?.after(), label, why })
    };
    let mut hints: Vec<_> = supervisors.filter_map(hint).collect();
    hints.sort_by_key(|hint| hint.at);
    hints
}

fn head(supervisor: &Component) -> Option<Span> {
    let times = supervisor.times.iter().flat_map(|times| [times.every_span, times.deadline_span]);
    let template = supervisor.template.as_ref()?.span;
    let parts = times.flatten().chain(supervisor.args_span);
    Some(parts.fold(template, |head, part| if part.end > head.end { head.to(part) } else { head }))
}
