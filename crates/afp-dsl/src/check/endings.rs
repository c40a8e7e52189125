//! Whether a plan can end as `Interrupted`: an event of a reachable element leads to `terminate`.

use crate::check::names::Indices;
use afp_syntax::ast::{Edge, Element, ElementKind, Guard, Plan, Reactions};
use afp_syntax::source::Span;

/// The first edge that ends the plan as `Interrupted`.
pub(crate) fn interrupting(plan: &Plan) -> Option<Span> {
    let elements = plan.elements();
    // Computations are not interrupted by events.
    if elements.iter().all(|element| element.kind() == ElementKind::Computation) {
        return None;
    }
    let globals = edges_of_globals(plan);
    // A fast decision for most plans.
    if elements.iter().all(|element| element.reactions().is_empty())
        && let Some((_, edge)) = globals.iter().find(|(_, edge)| edge.leads_to("terminate"))
    {
        return edge.span();
    }
    let events = Events::of(&elements, globals);
    let ending = |edges: &[Edge]| edges.iter().find(|edge| edge.leads_to("terminate")).cloned();
    let of_globals = || events.globals.iter().filter(|(_, edge)| edge.leads_to("terminate"));
    let mut of_elements = events.elements.iter().map(|each| ending(&each.edges));
    let is_shared = events.elements.iter().any(|each| !each.replaced.is_empty());
    if !is_shared && let Some((_, edge)) = of_globals().next() {
        return edge.span();
    }
    if of_globals().next().is_none() && of_elements.all(|edge| edge.is_none()) {
        return None;
    }
    let reached = reached(plan, &elements, &events);
    let active = || events.elements.iter().zip(&reached).filter(|(_, reached)| **reached);
    let global = of_globals().find(|each| active().any(|(element, _)| element.keeps(each)));
    let edge = global.map(|(_, edge)| edge.clone());
    edge.or_else(|| active().find_map(|(each, _)| ending(&each.edges))).and_then(|edge| edge.span())
}

struct Events {
    /// Edges of global supervisors, with the supervisors' names.
    globals: Vec<(String, Edge)>,
    /// Edges of each element.
    elements: Vec<OfElement>,
}

/// An element's additions to and replacements of global edges.
struct OfElement {
    takes_time: bool,
    /// Edges of its supervisors and reactions.
    edges: Vec<Edge>,
    /// Supervisors and events with its own reactions.
    replaced: Vec<(String, String)>,
}

impl Events {
    fn of(elements: &[Element], globals: Vec<(String, Edge)>) -> Events {
        let elements = elements.iter().map(|element| OfElement::of(element, &globals));
        Events { elements: elements.collect(), globals }
    }
}

/// Edges of global supervisors, with the supervisors' names.
fn edges_of_globals(plan: &Plan) -> Vec<(String, Edge)> {
    let guards = plan.guards().into_iter().flat_map(|guard| {
        let name = guard.name().map(|name| name.text).unwrap_or_default();
        guard.edges().into_iter().map(move |edge| (name.clone(), edge))
    });
    guards.collect()
}

impl OfElement {
    fn of(element: &Element, globals: &[(String, Edge)]) -> OfElement {
        let takes_time = element.kind() != ElementKind::Computation;
        let mut edges: Vec<_> = element.guards().iter().flat_map(Guard::edges).collect();
        let mut replaced = Vec::new();
        for table in element.reactions().iter().filter(|_| takes_time) {
            let name = table.name().map(|name| name.text).unwrap_or_default();
            if !globals.iter().any(|(known, _)| *known == name) {
                continue;
            }
            let events = table.edges().into_iter().flat_map(|edge| edge.names);
            replaced.extend(events.map(|event| (name.clone(), event.text)));
            edges.extend(Reactions::edges(table));
        }
        OfElement { takes_time, edges, replaced }
    }

    /// Whether an event of a global supervisor's edge keeps its target while the element is active.
    fn keeps(&self, (guard, edge): &(String, Edge)) -> bool {
        let is_replaced =
            |event: &String| self.replaced.iter().any(|(of, known)| of == guard && known == event);
        self.takes_time && !edge.names.iter().all(|event| is_replaced(&event.text))
    }
}

fn leads_to(edge: &Edge) -> String {
    edge.target.as_ref().map(|name| name.text.clone()).unwrap_or_default()
}

/// Elements reachable from `start`, by their own edges and by effective edges of global
/// supervisors.
fn reached(plan: &Plan, elements: &[Element], events: &Events) -> Vec<bool> {
    let names: Vec<_> = elements.iter().map(Element::name).collect();
    let indices =
        Indices::of(names.iter().map(|name| name.as_ref().map(|name| name.text.as_str())));
    let mut open: Vec<String> =
        plan.starts().iter().filter_map(|start| Some(start.target()?.text)).collect();
    if open.is_empty() {
        return vec![true; elements.len()];
    }
    let mut reached = vec![false; elements.len()];
    let mut waiting: Vec<_> = events.globals.iter().collect();
    while let Some(next) = open.pop() {
        let Some(index) = indices.find(&next) else { continue };
        if std::mem::replace(&mut reached[index], true) {
            continue;
        }
        open.extend(elements[index].edges().iter().map(leads_to));
        let own = &events.elements[index];
        open.extend(own.edges.iter().map(leads_to));
        waiting.retain(|each| {
            let kept = own.keeps(each);
            open.extend(kept.then(|| leads_to(&each.1)));
            !kept
        });
    }
    reached
}
