//! One element or supervisor of a plan.

use std::rc::Rc;

use crate::check::Context;
use crate::check::bindings::{self, Site};
use crate::check::callee::Wanted;
use crate::check::choices;
use crate::check::draft::{Made, WrittenParts, draft};
use crate::check::edges::{self, Connected, Elements, Origin, WrittenEdge};
use crate::check::formula::Scope;
use crate::check::resources::User;
use crate::check::signature::{Signature, SignatureKind};
use crate::check::{tables, timing, written};
use crate::graph::{Element, ElementId, EntryId, Supervisor};
use crate::outline::{Component, ComponentKind, Times};
use crate::toolbox::Template;
use afp_syntax::ast::{self, ElementKind, Frame};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

use super::faults::{Faults, Owner, add_remarks};

/// A component, as far as it could be checked.
pub(super) struct Checked<T> {
    /// The component for the graph; `None` if it has errors.
    pub built: Option<T>,
    pub user: Option<User>,
    pub signature: Option<Rc<Signature>>,
    /// Its draft for the outline.
    pub draft: Component,
}

/// Results of a component's check.
struct Parts<T> {
    built: Option<T>,
    user: Option<User>,
    made: Made,
}

impl<T> Parts<T> {
    /// Result for a component without a template or with invalid parts.
    fn broken(made: Made) -> Parts<T> {
        Parts { built: None, user: None, made }
    }
}

/// The context of a plan's components.
pub(super) struct Components<'a> {
    pub context: Context<'a>,
    /// The scope of formulas.
    pub scope: &'a Scope<'a>,
    /// Possible targets of edges.
    pub elements: &'a Elements<'a>,
}

impl Components<'_> {
    /// Checks an element without its supervisors.
    pub fn element(&self, node: &ast::Element, diags: &mut Diagnostics) -> Checked<Element> {
        let written = WrittenParts {
            template: node.template(),
            binds: node.binds(),
            edges: WrittenEdge::read(node.edges()),
        };
        let head = (ComponentKind::of(node.kind()), node.name());
        self.checked(head, node.frame(), written, |frame, written| {
            self.check_element(node, frame, written, diags)
        })
    }

    /// Checks a component and adds it to the outline.
    fn checked<T>(
        &self,
        head: (ComponentKind, Option<ast::Name>),
        frame: Frame,
        mut written: WrittenParts,
        check: impl FnOnce(&Frame, &mut WrittenParts) -> Parts<T>,
    ) -> Checked<T> {
        let Parts { built, user, made } = check(&frame, &mut written);
        let draft = draft(head, frame, &made, written, self.context.file.text);
        Checked { built, user, signature: made.signature, draft }
    }

    fn check_element(
        &self,
        node: &ast::Element,
        frame: &Frame,
        written: &mut WrittenParts,
        diags: &mut Diagnostics,
    ) -> Parts<Element> {
        if node.kind() == ElementKind::Computation {
            unguarded(node, diags);
        }
        let keyword = match node.kind() {
            ElementKind::Actor => "actor",
            ElementKind::Computation => "computation",
            ElementKind::SubPlan => "subplan",
        };
        let wanted = Wanted { keyword, span: Some(node.keyword_span()) };
        let reference = written.template.as_ref();
        let signature =
            reference.and_then(|reference| self.context.callee(reference, &wanted, diags));
        let (Some(signature), Some(reference)) = (signature, reference) else {
            let words: &[&str] = match node.kind() {
                ElementKind::SubPlan => &["OK", "Interrupted", edges::ERROR],
                ElementKind::Actor | ElementKind::Computation => &[edges::ERROR],
            };
            edges::names_only(&written.edges, words, self.elements, diags);
            bindings::names_only(self.scope, &written.binds, diags);
            return Parts::broken(Made::default());
        };
        let name = node.name();
        let broken = diags.syntax_errors_within(frame.span).next().is_some();
        let site = Site { reference: reference.span(), broken };
        let (signature, bound) = match self.ports(signature, written, &site, diags) {
            Ok(found) => found,
            Err(made) => {
                edges::names_only(&written.edges, &[edges::ERROR], self.elements, diags);
                return Parts::broken(made);
            }
        };
        edges::name(&mut written.edges, &signature, diags);
        let span = name.as_ref().map_or(frame.span, |name| name.span);
        let origin =
            Origin { signature: &signature, name: name.as_ref(), span, broken, supervisor: false };
        let connected = edges::check(&origin, &written.edges, self.elements, diags);
        let user = name.as_ref().map(|name| user(&name.text, span, &signature));
        let made = Made {
            signature: Some(signature.clone()),
            generic: bound.generic.clone(),
            times: None,
        };
        let built = self.build_element(frame, &signature, name, bound, connected);
        Parts { built, user, made }
    }

    /// The bindings of an element, and its signature after these have selected a table or an enum.
    ///
    /// # Errors
    /// The ports that are known without a selection; the missing selection is reported.
    fn ports(
        &self,
        signature: Rc<Signature>,
        written: &WrittenParts,
        site: &Site,
        diags: &mut Diagnostics,
    ) -> Result<(Rc<Signature>, bindings::Bound), Made> {
        let bound = (self.scope, &*written.binds, site);
        let Some((signature, binds)) = tables::read_by(self.context, &signature, bound, diags)
        else {
            return Err(Made { signature: Some(signature), ..Made::default() });
        };
        let binds = bindings::meant(&signature, &binds);
        let mut remarks = Diagnostics::default();
        let bound = bindings::check(self.scope, &signature, &binds, site, &mut remarks);
        let taken = written.edges.iter().any(|edge| edge.name.text == edges::ERROR);
        add_remarks(remarks, if taken { Faults::Taken } else { Faults::Unconnected }, diags);
        if let Some((inputs, outputs)) = &bound.valid {
            tables::fits(self.scope, &signature, inputs, diags);
            written::fits(self.scope, &signature, (inputs, outputs), diags);
        }
        let signatures = &self.context.program.signatures;
        let (generic, at) = (bound.generic.as_ref(), site.reference);
        match choices::chosen(signatures, &signature, generic, at, diags) {
            Some(chosen) => Ok((chosen, bound)),
            None => Err(Made { signature: Some(signature), generic: bound.generic, times: None }),
        }
    }

    fn build_element(
        &self,
        frame: &Frame,
        signature: &Signature,
        name: Option<ast::Name>,
        bound: bindings::Bound,
        connected: Connected,
    ) -> Option<Element> {
        let (name, (inputs, outputs)) = (name?, bound.valid?);
        Some(Element {
            doc: frame.doc.clone(),
            component: signature.component()?,
            generic: bound.generic,
            inputs,
            outputs,
            states: connected.outcomes,
            on_error: connected.extra,
            supervisors: Vec::new(),
            reactions: Vec::new(),
            edges: connected.spans,
            span: name.span,
            name: name.text,
        })
    }

    /// Checks a supervisor of the plan, or of the element `owner`.
    pub fn supervisor(
        &self,
        node: &ast::Guard,
        owner: Option<Owner>,
        diags: &mut Diagnostics,
    ) -> Checked<Supervisor> {
        let written = WrittenParts {
            template: node.template(),
            binds: node.binds(),
            edges: WrittenEdge::read(node.edges()),
        };
        let head = (ComponentKind::Supervisor, node.name());
        self.checked(head, node.frame(), written, |frame, written| {
            self.check_supervisor(node, owner, (frame, written), diags)
        })
    }

    fn check_supervisor(
        &self,
        node: &ast::Guard,
        owner: Option<Owner>,
        (frame, written): (&Frame, &WrittenParts),
        diags: &mut Diagnostics,
    ) -> Parts<Supervisor> {
        let times = self.times(node, diags);
        let wanted = Wanted { keyword: "supervise", span: None };
        let reference = written.template.as_ref();
        let signature =
            reference.and_then(|reference| self.context.callee(reference, &wanted, diags));
        let (Some(signature), Some(reference)) = (signature, reference) else {
            let words = &[edges::DEADLINE_MISSED];
            edges::names_only(&written.edges, words, self.elements, diags);
            bindings::names_only(self.scope, &written.binds, diags);
            let times = Some(effective(None, &times, diags));
            let made = Made { times, ..Made::default() };
            return Parts::broken(made);
        };
        let name = node.name();
        let broken = diags.syntax_errors_within(frame.span).next().is_some();
        let site = Site { reference: reference.span(), broken };
        let binds = bindings::meant(&signature, &written.binds);
        let mut remarks = Diagnostics::default();
        let bound = bindings::check(self.scope, &signature, &binds, &site, &mut remarks);
        add_remarks(remarks, owner.map_or(Faults::EndPlan, |owner| owner.faults), diags);
        let span = name.as_ref().map_or(frame.span, |name| name.span);
        let origin =
            Origin { signature: &signature, name: name.as_ref(), span, broken, supervisor: true };
        let connected = edges::check(&origin, &written.edges, self.elements, diags);
        let user = name.as_ref().map(|name| user(&name.text, span, &signature));
        let times = effective(signature.template(), &times, diags);
        let made = Made {
            signature: Some(signature.clone()),
            generic: bound.generic.clone(),
            times: Some(times),
        };
        let owner = owner.and_then(|owner| owner.id);
        let built = self.build_supervisor(node, owner, &signature, bound, connected, times);
        Parts { built, user, made }
    }

    fn times(&self, node: &ast::Guard, diags: &mut Diagnostics) -> Written {
        let mut written = Written::default();
        for time in node.timings() {
            let Some(keyword) = time.keyword() else { continue };
            let index = usize::from(keyword.text == "deadline");
            if let Some(first) = written.words[index] {
                if let Some(value) = time.value() {
                    self.scope.names_only(&value);
                }
                diags.push(
                    Diagnostic::new(
                        Code::E0511,
                        keyword.span,
                        message!("'{}' is given twice", keyword.text),
                    )
                    .note(first, "first given here")
                    .help("remove one of them"),
                );
                continue;
            }
            written.words[index] = Some(keyword.span);
            let value = timing::of_supervisor(&time, self.scope, diags);
            written.values[index] = value.map(|value| (value, time.span()));
        }
        written
    }

    /// The constants in its times.
    fn timed_by(&self, node: &ast::Guard) -> Vec<EntryId> {
        let names = node.timings().into_iter().filter_map(|time| match time.value()?.kind() {
            ast::FormulaKind::Ref(reference) => reference.name(),
            _ => None,
        });
        let entries = names.filter_map(|name| self.scope.indices.find(&name.text));
        entries.filter_map(|index| u16::try_from(index).ok().map(EntryId)).collect()
    }

    fn build_supervisor(
        &self,
        node: &ast::Guard,
        owner: Option<ElementId>,
        signature: &Signature,
        bound: bindings::Bound,
        connected: Connected,
        times: Times,
    ) -> Option<Supervisor> {
        let (name, (inputs, outputs)) = (node.name()?, bound.valid?);
        let (template, _) = signature.template.as_ref()?;
        Some(Supervisor {
            doc: node.doc(),
            owner,
            template: *template,
            generic: bound.generic,
            inputs,
            outputs,
            events: connected.outcomes.into_iter().collect::<Option<_>>()?,
            on_miss: connected.extra,
            timing: times.timing,
            every_span: times.every_span,
            timed_by: self.timed_by(node),
            edges: connected.spans,
            span: name.span,
            name: name.text,
        })
    }
}

fn user(name: &str, span: Span, signature: &Signature) -> User {
    let uses = signature.template().map(|template| template.uses.clone()).unwrap_or_default();
    let plan = match signature.kind {
        SignatureKind::Plan(place) => Some(place),
        SignatureKind::Template(_) => None,
    };
    User { name: name.to_owned(), span, uses, plan }
}

/// Reports supervisors of a computation, which takes no time.
fn unguarded(node: &ast::Element, diags: &mut Diagnostics) {
    for guard in node.guards() {
        let span = guard.name().map_or_else(|| guard.span(), |name| name.span);
        diags.push(
            Diagnostic::new(
                Code::E0218,
                span,
                "a computation takes no time, so nothing can watch it",
            )
            .help("move the supervisor to an actor, or to the plan"),
        );
    }
    for reactions in node.reactions() {
        let span = reactions.name().map_or_else(|| reactions.span(), |name| name.span);
        diags.push(
            Diagnostic::new(
                Code::E0218,
                span,
                "a computation takes no time, so no supervisor is polled meanwhile",
            )
            .help("move 'on' to an actor or a sub-plan"),
        );
    }
}

#[derive(Default)]
struct Written {
    /// Valid values with their places.
    values: [Option<(u64, Span)>; 2],
    /// Places of the keywords.
    words: [Option<Span>; 2],
}

/// Effective period and deadline: as written, else the template's. A template's deadline is limited
/// to a written period.
fn effective(template: Option<&Template>, written: &Written, diags: &mut Diagnostics) -> Times {
    let declared = template.map_or(timing::DEFAULT_EVERY, |template| template.every);
    let every = written.values[0].map_or(declared, |(every, _)| every);
    let every_span = written.values[0].map(|(_, span)| span);
    if let Some((deadline, span)) = written.values[1] {
        // An invalid written period has been reported.
        if written.words[0].is_none() || written.values[0].is_some() {
            timing::deadline_fits(deadline, every, span, diags);
        }
        let times = Times::new(every, deadline, template);
        return Times { every_span, deadline_span: Some(span), ..times };
    }
    let deadline = template.and_then(|template| template.deadline).unwrap_or(every);
    Times { every_span, ..Times::new(every, deadline.min(every), template) }
}
