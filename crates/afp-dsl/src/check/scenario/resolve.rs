//! Resolves dotted names of a scenario: components and entries of its plan and of sub-plans.
//!
//! It needs only names, so it works on plans with errors.

use crate::check::names::offer;
use crate::check::signature::{Signature, SignatureKind};
use crate::check::{Members, Program, edges};
use crate::graph::{ElementId, SupervisorId};
use crate::index::Recorder;
use crate::outline::{Component, ComponentKind};
use crate::scenario::Outcome;
use afp_syntax::ast::{ClaimTarget, Name, Path};
use afp_syntax::diagnostics::{Code, Diagnostic, Sought, list};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Maximum number of paths in a help.
const MOST_PATHS: usize = 6;

#[derive(Clone, Copy)]
pub(super) struct Resolver<'a> {
    pub program: &'a Program<'a>,
    pub members: &'a [Members],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Element(ElementId),
    Supervisor(SupervisorId),
}

/// Result of resolving names.
pub(super) struct Walk<T> {
    /// The declarations of the names, as far as found.
    pub trail: Vec<Span>,
    /// The entered elements, each a sub-plan of the previous plan.
    pub entered: Vec<ElementId>,
    /// Index of the last plan in [`Program::plans`].
    pub plan: usize,
    /// The target, or the error.
    pub end: Result<T, Box<Diagnostic>>,
}

/// Where the cause of a transition was found.
pub(super) enum Cause {
    /// A state of the left element.
    Own(Outcome),
    /// One of its supervisors; names from the second on remain.
    Near(Part),
    /// In its plan.
    Inside(Walk<Part>),
    /// From the outermost plan.
    Outside(Walk<Part>),
}

impl<'a> Resolver<'a> {
    /// The component of the first names; the trail has their number.
    pub fn component(&self, plan: usize, names: &[Name]) -> Walk<Part> {
        let mut walk = Walk { trail: Vec::new(), entered: Vec::new(), plan, end: Err(empty()) };
        for (at, name) in names.iter().enumerate() {
            let Some(part) = self.part(walk.plan, &name.text) else {
                walk.end = Err(self.unknown_part(walk.plan, name));
                return walk;
            };
            walk.trail.extend(self.declaration(walk.plan, part));
            walk.end = Ok(part);
            let (Part::Element(id), Some(next)) = (part, names.get(at + 1)) else { return walk };
            if let Some(local) = self.local(walk.plan, part, &next.text) {
                walk.trail.extend(self.declaration(walk.plan, local));
                walk.end = Ok(local);
                return walk;
            }
            let Some(inner) = self.sub_plan(walk.plan, id) else { return walk };
            if self.outcome(walk.plan, part, &next.text).is_some() {
                return walk;
            }
            walk.entered.push(id);
            walk.plan = inner;
        }
        walk
    }

    /// The index of the named entry.
    pub fn entry(&self, plan: usize, names: &[Name]) -> Walk<usize> {
        let mut walk = Walk { trail: Vec::new(), entered: Vec::new(), plan, end: Err(empty()) };
        for (at, name) in names.iter().enumerate() {
            let element = self.members[walk.plan].indices.find(&name.text);
            let id = element.and_then(|index| u16::try_from(index).ok()).map(ElementId);
            let inner = id.and_then(|id| Some((id, self.sub_plan(walk.plan, id)?)));
            if let (Some((id, inner)), true) = (inner, at + 1 < names.len()) {
                walk.trail.extend(self.declaration(walk.plan, Part::Element(id)));
                walk.entered.push(id);
                walk.plan = inner;
                continue;
            }
            let head = &self.program.plans[walk.plan];
            let Some(index) = head.indices.find(&name.text) else {
                walk.end = Err(self.unknown_entry(walk.plan, name));
                return walk;
            };
            walk.trail.push(head.entries[index].name.span);
            walk.end = match names.get(at + 1) {
                None => Ok(index),
                Some(more) => {
                    let message = message!("'{}' is an entry and has no parts", name.text);
                    let error = Diagnostic::new(Code::E0209, more.span, message);
                    Err(Box::new(error.help(message!("write '{}'", name.text))))
                }
            };
            return walk;
        }
        walk
    }

    /// The meaning of names after `by` for leaving an element for a target: one of its states, a
    /// supervisor of it or of its plan, or a path from the outermost plan. Of two supervisors with
    /// equal names, the one with such an edge is meant.
    pub fn cause(
        &self,
        main: usize,
        (plan, from): (usize, Part),
        to: &ClaimTarget,
        names: &[Name],
    ) -> Option<Cause> {
        let first = names.first()?;
        if let ([_], Some(outcome)) = (names, self.outcome(plan, from, &first.text)) {
            return Some(Cause::Own(outcome));
        }
        let inside = self.component(plan, names);
        let fit = |part, rest: Option<&Name>| {
            let has = rest.is_none_or(|name| self.outcome(plan, part, &name.text).is_some());
            (self.leads(plan, (part, rest), from, to), has)
        };
        if let Some(local) = self.local(plan, from, &first.text) {
            let own = fit(local, names.get(1));
            return Some(match inside.end {
                Ok(part) if fit(part, names.get(inside.trail.len())) > own => Cause::Inside(inside),
                _ => Cause::Near(local),
            });
        }
        Some(match inside.end {
            Ok(_) => Cause::Inside(inside),
            Err(_) => Cause::Outside(self.component(main, names)),
        })
    }

    /// Whether a component, or one of its outcomes, leads to a target while an element is active.
    fn leads(
        &self,
        plan: usize,
        (part, outcome): (Part, Option<&Name>),
        active: Part,
        to: &ClaimTarget,
    ) -> bool {
        let (Some(member), Some(active)) = (self.member(plan, part), self.member(plan, active))
        else {
            return false;
        };
        let name = member.name.as_ref().map_or("", |name| &name.text);
        let globals = self.members[plan].globals.len();
        let is_global = matches!(part, Part::Supervisor(id) if id.index() < globals);
        let here = active.reactions.iter().filter(|it| is_global && is_called(it, name));
        let exits = here.chain([member]).flat_map(|it| &it.exits);
        let mut exits = exits.filter(|exit| outcome.is_none_or(|name| *exit.name == *name.text));
        let last = |path: &Path| path.names().pop().map(|name| name.text).unwrap_or_default();
        let to = to.text(last).to_string();
        exits.any(|exit| {
            let target = exit.edge.as_ref().and_then(|edge| edge.target.as_ref());
            target.is_some_and(|target| target.text.split(' ').next() == Some(&*to))
        })
    }

    fn part(&self, plan: usize, name: &str) -> Option<Part> {
        let members = &self.members[plan];
        if let Some(index) = members.indices.find(name) {
            return u16::try_from(index).ok().map(ElementId).map(Part::Element);
        }
        let index = members.globals.iter().position(|member| is_called(member, name))?;
        u16::try_from(index).ok().map(SupervisorId).map(Part::Supervisor)
    }

    pub fn local(&self, plan: usize, element: Part, name: &str) -> Option<Part> {
        let Part::Element(id) = element else { return None };
        let members = &self.members[plan];
        let own = &members.elements.get(id.index())?.supervisors;
        let index = own.iter().position(|member| is_called(member, name))?;
        let before = members.elements[..id.index()].iter().map(|element| element.supervisors.len());
        let number = members.globals.len() + before.sum::<usize>() + index;
        u16::try_from(number).ok().map(SupervisorId).map(Part::Supervisor)
    }

    pub fn member(&self, plan: usize, part: Part) -> Option<&'a Component> {
        let members = &self.members[plan];
        match part {
            Part::Element(id) => members.elements.get(id.index()),
            Part::Supervisor(id) => {
                let locals = members.elements.iter().flat_map(|element| &element.supervisors);
                members.globals.iter().chain(locals).nth(id.index())
            }
        }
    }

    /// The index of an element's plan.
    pub fn sub_plan(&self, plan: usize, element: ElementId) -> Option<usize> {
        let member = self.member(plan, Part::Element(element))?;
        match self.signature(plan, Part::Element(element))?.kind {
            SignatureKind::Plan(place) if member.kind == ComponentKind::SubPlan => Some(place),
            _ => None,
        }
    }

    pub fn signature(&self, plan: usize, part: Part) -> Option<&'a Signature> {
        let members = &self.members[plan];
        let signature = match part {
            Part::Element(id) => members.of_elements.get(id.index()),
            Part::Supervisor(id) => members.of_supervisors.get(id.index()),
        };
        signature?.as_deref()
    }

    pub fn outcomes(&self, plan: usize, part: Part) -> Vec<&'a str> {
        let signature = self.signature(plan, part);
        let outcomes = signature.map_or(&[][..], |signature| &signature.outcomes);
        outcomes.iter().map(|outcome| &**outcome).collect()
    }

    /// The name of its implicit outcome.
    pub fn special(part: Part) -> &'static str {
        match part {
            Part::Element(_) => edges::ERROR,
            Part::Supervisor(_) => edges::DEADLINE_MISSED,
        }
    }

    pub fn outcome(&self, plan: usize, part: Part, name: &str) -> Option<Outcome> {
        let declared = self.outcomes(plan, part).iter().position(|known| *known == name);
        match declared {
            Some(index) => Some(Outcome::Declared(u16::try_from(index).ok()?)),
            None => (name == Self::special(part)).then_some(Outcome::Special),
        }
    }

    /// Records the meaning of a state's or event's name.
    pub fn record_outcome(&self, plan: usize, part: Part, name: &Name, record: &Recorder) {
        let signature = self.signature(plan, part);
        let declared = match self.outcome(plan, part, &name.text) {
            Some(Outcome::Declared(index)) => {
                signature.and_then(|signature| signature.outcome_span(usize::from(index)))
            }
            Some(Outcome::Special) => None,
            None => return record.unknown(name.span),
        };
        match (declared, edges::word(&name.text)) {
            (Some(definition), _) => record.definition(name.span, definition),
            (None, Some(word)) => record.word(name.span, word),
            (None, None) => record.unknown(name.span),
        }
    }

    fn declaration(&self, plan: usize, part: Part) -> Option<Span> {
        self.member(plan, part)?.name.as_ref().map(|name| name.span)
    }

    fn unknown_part(&self, plan: usize, name: &Name) -> Box<Diagnostic> {
        let members = &self.members[plan];
        let all = members.elements.iter().chain(&members.globals);
        let known = all.filter_map(|member| Some(member.name.as_ref()?.text.as_str()));
        let home = self.plan_name(plan);
        let message = message!("'{}' has no element or supervisor '{}'", home, name.text);
        let error = Diagnostic::new(Code::E0602, name.span, message);
        let error = error.unknown_in(home, Sought::Element, &name.text);
        if let Some(path) = self.without_point(plan, &name.text) {
            return Box::new(error.write(path));
        }
        let inside = self.one_deeper(plan, &name.text, |element, inner| {
            let local = || self.local(plan, Part::Element(element), &name.text).is_some();
            local() || inner.is_some_and(|inner| self.part(inner, &name.text).is_some())
        });
        if !inside.is_empty() {
            return Box::new(meant(error, inside));
        }
        Box::new(offer(error, &name.text, known, "write another name"))
    }

    /// Two names without a dot: an element, and a part of it.
    fn without_point(&self, plan: usize, name: &str) -> Option<String> {
        (0..).zip(&self.members[plan].elements).find_map(|(index, element)| {
            let (id, outer) = (ElementId(index), &element.name.as_ref()?.text);
            let inner = name.strip_prefix(outer.as_str())?;
            let is_local = self.local(plan, Part::Element(id), inner).is_some();
            let inside = || self.part(self.sub_plan(plan, id)?, inner);
            (is_local || inside().is_some()).then(|| format!("{outer}.{inner}"))
        })
    }

    /// The paths of elements extended by that name, if `holds` accepts an element and its plan.
    fn one_deeper(
        &self,
        plan: usize,
        name: &str,
        holds: impl Fn(ElementId, Option<usize>) -> bool,
    ) -> Vec<String> {
        let elements = (0..).map(ElementId).zip(&self.members[plan].elements);
        let holding = elements.filter(|(id, _)| holds(*id, self.sub_plan(plan, *id)));
        let named = holding.filter_map(|(_, element)| element.name.as_ref());
        named.map(|outer| format!("{}.{name}", outer.text)).collect()
    }

    fn unknown_entry(&self, plan: usize, name: &Name) -> Box<Diagnostic> {
        let entries = self.program.plans[plan].entries.iter();
        let known = entries.map(|entry| entry.name.text.as_str());
        let home = self.plan_name(plan);
        let message = message!("'{}' has no entry '{}'", home, name.text);
        let error = Diagnostic::new(Code::E0209, name.span, message);
        let error = error.unknown_in(home, Sought::Entry, &name.text);
        let inside = self.one_deeper(plan, &name.text, |_, inner| {
            inner.is_some_and(|inner| self.program.plans[inner].indices.find(&name.text).is_some())
        });
        if !inside.is_empty() {
            return Box::new(meant(error, inside));
        }
        Box::new(offer(error, &name.text, known, "declare it in the plan"))
    }

    fn plan_name(&self, plan: usize) -> &str {
        self.program.plans[plan].name.as_ref().map_or("", |name| &name.text)
    }
}

/// Suggests paths instead of a name: a single one as an edit.
fn meant(error: Diagnostic, mut paths: Vec<String>) -> Diagnostic {
    paths.truncate(MOST_PATHS);
    let error = error.help(message!("write {}", list(paths.iter().map(String::as_str), "or")));
    match paths.as_slice() {
        [path] => error.replace(path.as_str()),
        _ => error,
    }
}

fn is_called(member: &Component, name: &str) -> bool {
    member.name.as_ref().is_some_and(|known| known.text == name)
}

/// An empty path, which the parser has reported.
fn empty() -> Box<Diagnostic> {
    let error = Diagnostic::new(Code::E0602, Span::default(), "the name is missing");
    Box::new(error.help("write the name of an element or supervisor"))
}
