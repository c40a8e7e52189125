//! Handlers: the elements that `suspend` names, and the edges that `return` from them.
//!
//! Only `suspend` leads to a handler. Otherwise the path to it would decide whether anything
//! is set aside, and `return` would lead nowhere on some paths.

use crate::check::names::Indices;
use crate::check::resume::word;
use crate::graph::{EdgeSpans, Element, ElementId, Supervisor, Target, resuming, returning};
use crate::outline;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Maximum number of notes about other edges.
const MAX_NOTES: usize = 3;

/// The elements and supervisors of a plan; with errors they are `None`.
pub(super) struct Drawn<'a> {
    pub elements: &'a [Option<Element>],
    pub supervisors: &'a [Option<Supervisor>],
    pub start: Option<(ElementId, Span)>,
}

/// The components of a plan as written.
pub(super) struct Written<'a> {
    pub globals: &'a [outline::Component],
    pub elements: &'a [outline::Component],
    pub names: &'a Indices,
}

/// The origin of an edge.
#[derive(Clone, Copy)]
enum From<'a> {
    /// An element, one of its supervisors, or its reactions.
    Element(usize),
    /// A supervisor of the plan.
    Global(&'a str),
    Start,
}

/// An edge of a plan.
#[derive(Clone, Copy)]
struct Way<'a> {
    from: From<'a>,
    to: Target,
    span: Span,
}

/// Reports edges that lead to handlers without `suspend`, and `return` outside of handlers.
pub(super) fn check(drawn: &Drawn<'_>, written: &Written<'_>, diags: &mut Diagnostics) {
    let Some(named) = written.named() else { return };
    let ways = drawn.ways();
    let returns = ways.iter().any(|way| way.to == Target::Return);
    if named.is_empty() && !returns {
        return;
    }
    reached_otherwise(drawn, &ways, &named, diags);
    let returning = returning(drawn.elements.iter().map(Option::as_ref));
    let resuming = resuming(drawn.elements.iter().map(Option::as_ref));
    for way in &ways {
        let leads = |of: &[bool], id: ElementId| of.get(id.index()) == Some(&true);
        let computation = match way.to {
            Target::Return => None,
            // A computation that does both is reported itself.
            Target::Element(id) if leads(&returning, id) && !leads(&resuming, id) => {
                drawn.element(id)
            }
            _ => continue,
        };
        outside(drawn, way, computation, &named, diags);
    }
    both(drawn, [&returning, &resuming], diags);
}

impl Written<'_> {
    /// The elements that `suspend` names, with the places; `None` if an edge has no target or an
    /// unknown one, so that a handler may be missing.
    fn named(&self) -> Option<Vec<(usize, Span)>> {
        let of_elements = self.elements.iter().flat_map(|element| {
            [element].into_iter().chain(&element.supervisors).chain(&element.reactions)
        });
        let exits = self.globals.iter().chain(of_elements).flat_map(|component| &component.exits);
        let mut named = Vec::new();
        for edge in exits.filter_map(|exit| exit.edge.as_ref()) {
            let target = edge.target.as_ref()?;
            if let Some(name) = target.text.strip_prefix(outline::SUSPEND) {
                named.push((self.names.find(name)?, target.span));
            }
        }
        Some(named)
    }
}

impl<'a> Drawn<'a> {
    fn element(&self, id: ElementId) -> Option<&'a Element> {
        self.elements.get(id.index())?.as_ref()
    }

    fn ways(&self) -> Vec<Way<'a>> {
        let mut ways = Vec::new();
        let mut add = |from,
                       targets: &mut dyn Iterator<Item = Option<Target>>,
                       extra,
                       at: &EdgeSpans| {
            let spans = at.outcomes.iter().copied().chain([at.extra]);
            let edges = targets.chain([extra]).zip(spans);
            ways.extend(edges.filter_map(|(to, span)| Some(Way { from, to: to?, span: span? })));
        };
        for (index, element) in self.elements.iter().enumerate() {
            let Some(element) = element else { continue };
            let from = From::Element(index);
            add(from, &mut element.states.iter().copied(), element.on_error, &element.edges);
            for table in &element.reactions {
                add(from, &mut table.events.iter().copied(), table.on_miss, &table.edges);
            }
        }
        for supervisor in self.supervisors.iter().flatten() {
            let from = match supervisor.owner {
                Some(owner) => From::Element(owner.index()),
                None => From::Global(&supervisor.name),
            };
            let events = &mut supervisor.events.iter().copied().map(Some);
            add(from, events, supervisor.on_miss, &supervisor.edges);
        }
        if let Some((first, span)) = self.start {
            ways.push(Way { from: From::Start, to: Target::Element(first), span });
        }
        ways
    }
}

/// Reports each handler that is a computation or that other edges lead to.
fn reached_otherwise(
    drawn: &Drawn<'_>,
    ways: &[Way<'_>],
    named: &[(usize, Span)],
    diags: &mut Diagnostics,
) {
    for (at, (index, span)) in named.iter().enumerate() {
        let Some(handler) = drawn.elements.get(*index).and_then(Option::as_ref) else { continue };
        let name = &handler.name;
        if !handler.takes_time() {
            let message = message!(
                "'{}' is a computation, and only an actor or a sub-plan can handle an interruption",
                name
            );
            let help =
                message!("lead the event to '{}', and '{}' to 'suspend' with an actor", name, name);
            diags.push(
                Diagnostic::new(Code::E0257, *span, message)
                    .note(handler.span, "the computation")
                    .help(help),
            );
            continue;
        }
        if named[..at].iter().any(|(known, _)| known == index) {
            continue;
        }
        let leads_here =
            |way: &&Way<'_>| matches!(way.to, Target::Element(id) if id.index() == *index);
        let mut others = ways.iter().filter(leads_here);
        let Some(first) = others.next() else { continue };
        let message = message!("'{}' is a handler, and only 'suspend' may lead to it", name);
        let error = Diagnostic::new(Code::E0257, first.span, message);
        let error = error.note(*span, "it handles an interruption here");
        let others = others.take(MAX_NOTES);
        let error = others.fold(error, |error, way| error.note(way.span, "this leads to it, too"));
        diags.push(match first.from {
            From::Start => error.help("start with another element"),
            _ => error.help(message!(
                "add a second element with the template of '{}', and lead the edge there",
                name
            )),
        });
    }
}

/// Reports an edge that returns although nothing is set aside, directly or by a computation.
fn outside(
    drawn: &Drawn<'_>,
    way: &Way<'_>,
    computation: Option<&Element>,
    named: &[(usize, Span)],
    diags: &mut Diagnostics,
) {
    let message = match way.from {
        From::Element(index) => {
            let Some(Some(element)) = drawn.elements.get(index) else { return };
            let is_handler = named.iter().any(|(known, _)| *known == index);
            // The edges that lead to a computation are checked instead.
            if is_handler || !element.takes_time() {
                return;
            }
            message!("nothing is suspended while '{}' is active", element.name)
        }
        From::Global(name) => {
            message!("'{}' watches every element, and only a handler can return", name)
        }
        From::Start => "nothing is suspended when the plan starts".into(),
    };
    let mut error = Diagnostic::new(Code::E0256, way.span, message);
    if let Some(computation) = computation {
        error = error.note(computation.span, "this computation can lead to 'return'");
    }
    diags.push(match way.from {
        From::Global(name) => {
            if let Some((_, span)) = named.first() {
                error = error.note(*span, "this names a handler");
            }
            let on = format!("on {name} {{ ... -> return }}");
            error.help(message!("write '{}' in the handler", on))
        }
        From::Element(index) => {
            let name = drawn.elements.get(index).and_then(Option::as_ref).map_or("", |it| &it.name);
            error.help(message!(
                "lead it to an element, or suspend to '{}': 'Event -> suspend {}'",
                name,
                name
            ))
        }
        From::Start => error.help("start with another element"),
    });
}

/// Reports computations that can lead to `return` and to `resume` or `suspend`, at the last one on
/// the way.
fn both(drawn: &Drawn<'_>, [returning, resuming]: [&[bool]; 2], diags: &mut Diagnostics) {
    let elements = drawn.elements;
    let has_both = |index: usize| returning[index] && resuming[index];
    let mut found: Vec<_> = (0..elements.len()).filter(|index| has_both(*index)).collect();
    let leads_on = |index: &usize| {
        let next = elements[*index].as_ref().into_iter().flat_map(|it| it.states.iter().flatten());
        next.filter_map(Target::element).any(|id| has_both(id.index()))
    };
    if !found.iter().all(leads_on) {
        found.retain(|index| !leads_on(index));
    }
    for index in found {
        let (Some(element), Ok(id)) = (&elements[index], u16::try_from(index)) else { continue };
        let other = word(elements, ElementId(id));
        let message = message!("'{}' can lead to both 'return' and '{}'", element.name, other);
        let mut error = Diagnostic::new(Code::E0256, element.span, message);
        let edges = element.states.iter().chain([&element.on_error]);
        let spans = element.edges.outcomes.iter().chain([&element.edges.extra]);
        for (to, span) in edges.zip(spans) {
            let note = match to {
                Some(Target::Return) => "a handler has ended before this",
                Some(Target::Resume | Target::Suspend(_)) => {
                    "an element is still active before this"
                }
                _ => continue,
            };
            if let Some(span) = span {
                error = error.note(*span, note);
            }
        }
        diags.push(error.help("use a computation for each"));
    }
}
