//! Elements and supervisors: their ports and their exits.

use std::rc::Rc;
use std::sync::Arc;

use super::build::Places;
use super::{
    Binding, Component, ComponentKind, Edge, Exit, ExitKind, Findings, Input, MadeFrom, Output,
    PlanId, Target, TemplateUse, Value,
};
use crate::check::bindings;
use crate::check::edges::{self, WrittenEdge};
use crate::check::signature::{Signature, SignatureKind};
use crate::check::{Made, Member};
use crate::index::Found;
use crate::types::Type;
use afp_syntax::ast::{self, Bind, Frame};
use afp_syntax::item::Item;

/// Reads the components of one plan.
pub(super) struct Reader<'a> {
    pub places: &'a Places<'a>,
    /// The plan's name in paths.
    pub plan: &'a str,
}

impl Reader<'_> {
    /// An element without its supervisors.
    pub fn element(&self, node: &ast::Element, member: Member, item: Item) -> Component {
        self.component(member, item, node.frame())
    }

    /// A supervisor.
    pub fn guard(&self, node: &ast::Guard, member: Member, item: Item) -> Component {
        self.component(member, item, node.frame())
    }

    /// Reactions to a supervisor.
    pub fn reactions(&self, node: &ast::Reactions, member: Member, item: Item) -> Component {
        self.component(member, item, node.frame())
    }

    fn component(&self, member: Member, item: Item, frame: Frame) -> Component {
        let Member { name, kind, made, written, .. } = member;
        let signature = made.signature.as_ref();
        let (inputs, outputs) = self.ports(&written.binds, &made);
        let exits = self.exits(kind, written.edges, signature);
        Component {
            item,
            kind,
            name,
            doc: frame.doc,
            note: frame.note,
            span: frame.span,
            template: written.template.as_ref().map(|reference| {
                let (span, made_from) = (reference.span(), signature.and_then(made_from));
                let text = self.places.in_one_line(span);
                TemplateUse {
                    text: text.unwrap_or_else(|| reference.in_one_line()),
                    span,
                    name_span: reference.name_span().unwrap_or(span),
                    made_from,
                }
            }),
            generic: made.generic,
            inputs,
            outputs,
            exits,
            supervisors: Vec::new(),
            reactions: Vec::new(),
            times: made.times,
            args_span: frame.args_span,
            end_span: frame.end_span,
            findings: Findings::default(),
        }
    }

    /// Inputs and outputs: those that are declared, then those that are only written.
    fn ports(&self, binds: &[Bind], made: &Made) -> (Vec<Input>, Vec<Output>) {
        let signature = made.signature.as_ref();
        let (mut inputs, mut outputs) = match signature {
            Some(signature) => declared(signature, made.generic.as_ref()),
            None => (Vec::new(), Vec::new()),
        };
        let binds = match signature {
            Some(signature) => bindings::meant(signature, binds),
            None => binds.into(),
        };
        for bind in &*binds {
            let binding = Some(self.binding(bind));
            match bind {
                Bind::In { port, .. } => {
                    let mut same = inputs.iter_mut().filter(|known| *known.name == *port.text);
                    match same.find(|known| known.binding.is_none()) {
                        Some(input) => input.binding = binding,
                        None => {
                            let known = inputs.iter().filter(|known| *known.name == *port.text);
                            let nth = following(known.count());
                            inputs.push(Input { nth, binding, ..input(port.text.as_str().into()) });
                        }
                    }
                }
                Bind::Out { port, .. } => {
                    let mut same = outputs.iter_mut().filter(|known| *known.name == *port.text);
                    match same.find(|known| known.binding.is_none()) {
                        Some(output) => output.binding = binding,
                        None => {
                            let known = outputs.iter().filter(|known| *known.name == *port.text);
                            let nth = following(known.count());
                            outputs.push(Output {
                                nth,
                                binding,
                                ..output(port.text.as_str().into())
                            });
                        }
                    }
                }
            }
        }
        (inputs, outputs)
    }

    fn binding(&self, bind: &Bind) -> Binding {
        let places = self.places;
        let (port, sign, value) = match bind {
            Bind::In { port, sign, formula } => {
                (port, sign, formula.as_ref().map(|formula| places.value(formula)))
            }
            Bind::Out { port, sign, entry, formula } => {
                let entry = entry.as_ref().map(|entry| Value {
                    text: entry.text.clone(),
                    span: entry.span,
                    entry: places.entry(entry.span),
                });
                (port, sign, entry.or_else(|| Some(places.value(formula.as_ref()?))))
            }
        };
        let last = value.as_ref().map_or(*sign, |value| value.span);
        Binding { span: port.span.to(last), port_span: port.span, value }
    }

    /// States or events: those that are declared, then the one that needs no declaration, then
    /// those that are only written.
    fn exits(
        &self,
        kind: ComponentKind,
        edges: Vec<WrittenEdge>,
        signature: Option<&Rc<Signature>>,
    ) -> Vec<Exit> {
        let supervisor = matches!(kind, ComponentKind::Supervisor | ComponentKind::Reactions);
        let (usual, special_kind) = match supervisor {
            true => (ExitKind::Event, ExitKind::Missed),
            false => (ExitKind::State, ExitKind::Error),
        };
        let special = if supervisor { edges::DEADLINE_MISSED } else { edges::ERROR };
        let declared = signature.map_or(0, |signature| signature.outcomes.len());
        let mut exits = Vec::with_capacity(declared.max(edges.len()));
        if let Some(signature) = signature {
            for (at, name) in signature.outcomes.iter().enumerate() {
                let declared = signature.outcome_span(at);
                // Whether a plan can be interrupted decides whether its user must say what then.
                let required = declared.is_some()
                    || **name != *"Interrupted"
                    || signature.interrupting.is_some();
                exits.push(Exit { declared, required, known: true, ..exit(name.clone(), usual) });
            }
        }
        let mut others = Vec::new();
        for WrittenEdge { name, target, reason, span } in edges {
            let kind = if name.text == special { special_kind } else { usual };
            let meaning = self.places.meanings.get(name.span);
            let known = !matches!(meaning, None | Some(Found::Unknown));
            let target = target.map(|target| self.places.target(target));
            let target = match (target, reason) {
                (Some(Target { text, span, to }), Some(reason)) => {
                    let text = format!("{text} {}", reason.text);
                    Some(Target { text, span: span.to(reason.span), to })
                }
                (target, _) => target,
            };
            let new = Edge { span, name_span: name.span, target };
            let first = exits.iter_mut().find(|known| *known.name == *name.text);
            match first {
                Some(first) if first.edge.is_none() => first.edge = Some(new),
                _ => {
                    let all = exits.iter().chain(&others);
                    let nth = following(all.filter(|known| *known.name == *name.text).count());
                    others.push(Exit {
                        nth,
                        known,
                        edge: Some(new),
                        ..exit(name.text.as_str().into(), kind)
                    });
                }
            }
        }
        others.sort_by_key(|exit| exit.kind != special_kind);
        exits.extend(others);
        exits
    }
}

/// The number of one more of a name of which some are there.
fn following(known: usize) -> u16 {
    u16::try_from(known + 1).unwrap_or(u16::MAX)
}

fn made_from(signature: &Rc<Signature>) -> Option<MadeFrom> {
    Some(match signature.kind {
        SignatureKind::Plan(place) => MadeFrom::Plan(PlanId::new(place)),
        SignatureKind::Template(_) => {
            let (id, toolbox) = signature.template.as_ref()?;
            MadeFrom::Template { toolbox: toolbox.clone(), index: usize::from(id.index) }
        }
    })
}

/// The ports of a template or plan, none of them bound.
fn declared(signature: &Signature, generic: Option<&Type>) -> (Vec<Input>, Vec<Output>) {
    let actual = |ty: &Option<Type>| match (ty, generic) {
        (Some(Type::Any | Type::Number | Type::Discrete), Some(generic)) => Some(generic.clone()),
        (ty, _) => ty.clone(),
    };
    let inputs = signature.inputs.iter().map(|port| Input {
        declared: Some(port.span),
        ty: actual(&port.ty),
        required: !port.optional,
        default: port.default.clone(),
        range: port.range,
        ..input(port.name.clone())
    });
    let outputs = signature.outputs.iter().map(|port| Output {
        declared: Some(port.span),
        ty: actual(&port.ty),
        ..output(port.name.clone())
    });
    (table(signature).into_iter().chain(inputs).collect(), outputs.collect())
}

/// The port that takes a table, which the signature with its columns does not have.
fn table(signature: &Signature) -> Option<Input> {
    let reads = signature.template()?.reads_table.as_ref()?;
    reads.table.as_ref()?;
    let (name, declared) = (reads.port.name.as_str().into(), Some(reads.port.span));
    Some(Input { declared, required: true, ..input(name) })
}

fn input(name: Arc<str>) -> Input {
    Input {
        name,
        nth: 1,
        declared: None,
        ty: None,
        required: false,
        default: None,
        range: None,
        binding: None,
        findings: Findings::default(),
    }
}

fn output(name: Arc<str>) -> Output {
    Output { name, nth: 1, declared: None, ty: None, binding: None, findings: Findings::default() }
}

fn exit(name: Arc<str>, kind: ExitKind) -> Exit {
    Exit {
        name,
        nth: 1,
        kind,
        known: false,
        declared: None,
        required: false,
        edge: None,
        findings: Findings::default(),
    }
}
