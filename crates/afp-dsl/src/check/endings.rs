//! Whether a plan can end as `Interrupted`: some event of an element that can be reached leads to
//! `terminate`.

use crate::source::Span;
use crate::syntax::ast::{Edge, Element, Guard, Plan};

/// The first edge, as written, that ends the plan as `Interrupted`.
pub(crate) fn interrupting(plan: &Plan) -> Option<Span> {
    let elements = plan.elements();
    let reached = reached(plan, &elements);
    let local = elements.iter().zip(reached).filter(|(_, reached)| *reached);
    let guards = plan.guards().into_iter().chain(local.flat_map(|(element, _)| element.guards()));
    let edges: Vec<_> = guards.flat_map(|guard| guard.edges()).collect();
    edges.iter().find(|edge| leads_to(edge) == "terminate").map(Edge::span)
}

fn leads_to(edge: &Edge) -> String {
    edge.target().map(|name| name.text).unwrap_or_default()
}

/// Which elements can be reached from `start` and from global supervisors, which can fire anywhere.
fn reached(plan: &Plan, elements: &[Element]) -> Vec<bool> {
    let name = |element: &Element| element.name().map(|name| name.text).unwrap_or_default();
    let names: Vec<_> = elements.iter().map(name).collect();
    let mut open: Vec<String> =
        plan.starts().iter().filter_map(|start| Some(start.target()?.text)).collect();
    if open.is_empty() {
        return vec![true; elements.len()];
    }
    open.extend(plan.guards().iter().flat_map(Guard::edges).map(|edge| leads_to(&edge)));
    let mut reached = vec![false; elements.len()];
    while let Some(next) = open.pop() {
        let Some(place) = names.iter().position(|name| *name == next) else { continue };
        if std::mem::replace(&mut reached[place], true) {
            continue;
        }
        let element = &elements[place];
        open.extend(element.edges().iter().map(leads_to));
        open.extend(element.guards().iter().flat_map(Guard::edges).map(|edge| leads_to(&edge)));
    }
    reached
}
