//! `on`: edges of global supervisors that an element replaces.
//!
//! Only written edges are replaced, so nothing can be missing.

use std::rc::Rc;

use crate::check::draft::{Made, WrittenParts, draft};
use crate::check::edges::{self, Elements, Origin, WrittenEdge};
use crate::check::names::unknown;
use crate::check::signature::Signature;
use crate::graph::{Reactions, SupervisorId};
use crate::index::Recorder;
use crate::outline::{Component, ComponentKind};
use afp_syntax::ast::{self, ElementKind, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Sought};
use afp_syntax::message;

/// The context of a plan's reactions.
pub(super) struct Watchers<'a> {
    /// The global supervisors, as written.
    pub globals: &'a [Component],
    /// Their signatures.
    pub signatures: &'a [Option<Rc<Signature>>],
    pub elements: &'a Elements<'a>,
    pub text: &'a str,
    pub record: &'a Recorder,
}

impl Watchers<'_> {
    /// The reactions of an element, for graph and outline.
    pub fn check(
        &self,
        element: &ast::Element,
        diags: &mut Diagnostics,
    ) -> (Vec<Reactions>, Vec<Component>) {
        let nodes = element.reactions();
        let mut known: Vec<Reactions> = Vec::with_capacity(nodes.len());
        let mut written = Vec::with_capacity(nodes.len());
        for node in nodes {
            let (reactions, member) = self.one(element, &node, diags);
            written.push(member);
            let Some(reactions) = reactions else { continue };
            match known.iter().find(|other| other.supervisor == reactions.supervisor) {
                Some(first) => diags.push(
                    Diagnostic::new(Code::E0226, reactions.span, twice(&node))
                        .note(first.span, "the first one")
                        .help("write all edges into one of them"),
                ),
                None => known.push(reactions),
            }
        }
        if element.kind() == ElementKind::Computation {
            known.clear();
        }
        (known, written)
    }

    fn one(
        &self,
        element: &ast::Element,
        node: &ast::Reactions,
        diags: &mut Diagnostics,
    ) -> (Option<Reactions>, Component) {
        let (name, edges) = (node.name(), WrittenEdge::read(node.edges()));
        let index = name.as_ref().and_then(|name| self.find(element, name, diags));
        let signature = index.and_then(|index| self.signatures.get(index)?.clone());
        let mut reactions = None;
        if let (Some(name), Some(signature), Some(index)) = (&name, &signature, index) {
            let origin = Origin {
                signature,
                name: Some(name),
                span: name.span,
                broken: false,
                supervisor: true,
            };
            let (connected, ..) = edges::connect(&origin, &edges, self.elements, diags);
            to_itself(element, &origin, &edges, diags);
            reactions = u16::try_from(index).ok().map(|index| Reactions {
                supervisor: SupervisorId(index),
                events: connected.outcomes,
                on_miss: connected.extra,
                span: name.span,
                edges: connected.spans,
            });
        } else {
            edges::names_only(&edges, &[edges::DEADLINE_MISSED], self.elements, diags);
        }
        let parts = WrittenParts { edges, ..WrittenParts::default() };
        let head = (ComponentKind::Reactions, name);
        (reactions, draft(head, node.frame(), &Made::default(), parts, self.text))
    }

    /// The index of a global supervisor.
    fn find(&self, element: &ast::Element, name: &Name, diags: &mut Diagnostics) -> Option<usize> {
        let names = self.globals.iter().map(|global| global.name.as_ref());
        let found = names.clone().position(|known| known.is_some_and(|it| it.text == name.text));
        if let Some(definition) = found.and_then(|index| self.globals[index].name.as_ref()) {
            self.record.definition(name.span, definition.span);
            return found;
        }
        self.record.unknown(name.span);
        let own =
            element.guards().iter().filter_map(ast::Guard::name).find(|o| o.text == name.text);
        diags.push(match own {
            Some(own) => Diagnostic::new(
                Code::E0248,
                name.span,
                message!("'{}' watches only this element", name.text),
            )
            .unknown(Sought::Supervisor, &name.text)
            .note(own.span, "it belongs to the element")
            .help("write the edges into the supervisor's braces"),
            None => {
                let message = message!("the plan has no supervisor '{}'", name.text);
                let known = names.flatten().map(|known| known.text.as_str());
                let none = "add one to the plan: 'supervise ...'";
                let error = unknown(Code::E0248, name.span, message, &name.text, known, none);
                error.unknown(Sought::Supervisor, &name.text)
            }
        });
        None
    }
}

fn twice(node: &ast::Reactions) -> Message {
    let name = node.name().map(|name| name.text).unwrap_or_default();
    message!("the element has two 'on {}'", name)
}

/// Reports edges to the element itself, which is already active.
fn to_itself(
    element: &ast::Element,
    watcher: &Origin<'_>,
    edges: &[WrittenEdge],
    diags: &mut Diagnostics,
) {
    let Some(own) = element.name() else { return };
    for edge in edges.iter().filter(|edge| watcher.has(&edge.name)) {
        let Some(target) = edge.target.as_ref().filter(|to| to.text == own.text) else { continue };
        let (event, own) = (&edge.name.text, &own.text);
        let message = message!("'{}' is never taken: '{}' is active already", event, own);
        diags.push(
            Diagnostic::new(Code::E0249, target.span, message)
                .help("write 'ignore', or lead it to another element")
                .replace("ignore"),
        );
    }
}
