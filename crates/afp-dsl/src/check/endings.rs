//! Whether a plan can end as `Interrupted`: some event of an element that can be reached leads to
//! `terminate`.

use crate::check::names::Places;
use afp_syntax::ast::{Edge, Element, Guard, Plan};
use afp_syntax::source::Span;

/// The first edge, as written, that ends the plan as `Interrupted`.
pub(crate) fn interrupting(plan: &Plan) -> Option<Span> {
    let ending = |guards: Vec<Guard>| {
        let mut edges = guards.into_iter().flat_map(|guard| guard.edges());
        edges.find(|edge| edge.leads_to("terminate")).map(|edge| edge.span())
    };
    if let Some(edge) = ending(plan.guards()) {
        return Some(edge);
    }
    let elements = plan.elements();
    let first = elements.iter().position(|element| ending(element.guards()).is_some())?;
    let reached = reached(plan, &elements);
    let local = elements.iter().zip(reached).skip(first).filter(|(_, reached)| *reached);
    local.into_iter().find_map(|(element, _)| ending(element.guards()))
}

fn leads_to(edge: &Edge) -> String {
    edge.target().map(|name| name.text).unwrap_or_default()
}

/// Which elements can be reached from `start` and from global supervisors, which can fire anywhere.
fn reached(plan: &Plan, elements: &[Element]) -> Vec<bool> {
    let names: Vec<_> = elements.iter().map(Element::name).collect();
    let places = Places::of(names.iter().map(|name| name.as_ref().map(|name| name.text.as_str())));
    let mut open: Vec<String> =
        plan.starts().iter().filter_map(|start| Some(start.target()?.text)).collect();
    if open.is_empty() {
        return vec![true; elements.len()];
    }
    open.extend(plan.guards().iter().flat_map(Guard::edges).map(|edge| leads_to(&edge)));
    let mut reached = vec![false; elements.len()];
    while let Some(next) = open.pop() {
        let Some(place) = places.find(&next) else { continue };
        if std::mem::replace(&mut reached[place], true) {
            continue;
        }
        let element = &elements[place];
        open.extend(element.edges().iter().map(leads_to));
        open.extend(element.guards().iter().flat_map(Guard::edges).map(|edge| leads_to(&edge)));
    }
    reached
}
