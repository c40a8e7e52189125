//! The control flow as State Chart XML, for tools that simulate or check state charts.
//!
//! Elements become states, sub-plans become states with their bodies inside, and the three endings
//! of a plan become final states. Charts only use the `In` predicate, so the null data model is
//! enough. The head of a chart lists the omitted parts.

mod chart;
mod names;
mod view;

use afp_dsl::graph::Graph;
use afp_syntax::source::Sources;
use chart::Chart;
use names::Scope;
use view::View;

/// The control flow of the main plan as a State Chart XML document, sub-plans unfolded.
///
/// States have dotted ids (`Plan.sub.element`), ends have `Plan-OK`, `Plan-Interrupted` and
/// `Plan-Error`. Events are named `sub:element.State`, `sub:element-supervisor.Event` and, for
/// global supervisors, `sub:supervisor.Event`; a fault's event is `Error`. The document's first
/// comment explains this and lists the omitted parts: the order of supervisors, periods, deadlines,
/// values. With `data`, comments have the formulas, from the sources if they are given, or else
/// printed.
pub fn scxml(graph: &Graph, sources: Option<&Sources>, data: bool) -> String {
    let view = View { graph, plan: graph.main(), sources, data };
    let scope = Scope::outermost(&view.plan.name);
    let mut chart = Chart::default();
    chart.document(&view, &scope);
    chart.into_text()
}
