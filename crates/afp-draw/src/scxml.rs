//! The control flow as State Chart XML, for tools that simulate or check state charts.
//!
//! Elements become states, sub-plans states with their bodies inside, and the three ways in which
//! a plan ends become final states. Nothing but the `In` predicate is asked for, so the null data
//! model is enough: what a chart cannot hold is said at its head.

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
/// comment says this too, and what is left out: the order in which supervisors are asked, periods,
/// deadlines, values. With `data`, comments have the formulas: as written if the texts that the spans of the graph
/// point into are given, else printed.
pub fn scxml(graph: &Graph, sources: Option<&Sources>, data: bool) -> String {
    let view = View { graph, plan: graph.main(), sources, data };
    let scope = Scope::outermost(&view.plan.name);
    let mut chart = Chart::default();
    chart.document(&view, &scope);
    chart.into_text()
}
