//! Checked components without paths and meanings of names.
//!
//! They are made while their nodes are available, so that no tree is kept; [`super::outline`] adds
//! the rest when all names are resolved.

use std::hash::Hash;
use std::rc::Rc;
use std::sync::Arc;

use crate::check::bindings;
use crate::check::edges::{self, WrittenEdge};
use crate::check::signature::{Signature, SignatureKind};
use crate::outline::{
    Binding, Component, ComponentKind, Destination, Edge, Exit, ExitKind, Findings, Input,
    MadeFrom, Output, PlanId, SUSPEND, Target, TemplateUse, Times, Value,
};
use crate::types::Type;
use afp_syntax::ast::{self, Bind, Frame, Name};
use afp_syntax::item::Item;
use afp_syntax::source::Span;
use rustc_hash::FxHashMap;

#[derive(Default)]
pub(crate) struct WrittenParts {
    /// Template or plan.
    pub template: Option<ast::Ref>,
    pub binds: Vec<ast::Bind>,
    pub edges: Vec<WrittenEdge>,
}

/// The template or plan of a component, as far as known.
#[derive(Default)]
pub(crate) struct Made {
    pub signature: Option<Rc<Signature>>,
    /// The type of `any` or `number`.
    pub generic: Option<Type>,
    /// Polling times of a supervisor.
    pub times: Option<Times>,
}

/// An element without its supervisors, a supervisor, or reactions; `text` is the file's.
pub(crate) fn draft(
    (kind, name): (ComponentKind, Option<Name>),
    frame: Frame,
    made: &Made,
    parts: WrittenParts,
    text: &str,
) -> Component {
    let signature = made.signature.as_ref();
    let (inputs, outputs) = ports(made, &parts.binds, text);
    Component {
        item: Item::plan(String::new()),
        kind,
        name,
        doc: frame.doc,
        note: frame.note,
        span: frame.span,
        template: parts.template.map(|reference| {
            let span = reference.span();
            TemplateUse {
                text: in_one_line(text, span).unwrap_or_else(|| reference.in_one_line()),
                span,
                name_span: reference.name_span().unwrap_or(span),
                made_from: signature.and_then(made_from),
            }
        }),
        generic: made.generic.clone(),
        inputs,
        outputs,
        exits: exits(kind, parts.edges, signature.map(|signature| &**signature)),
        supervisors: Vec::new(),
        reactions: Vec::new(),
        times: made.times,
        args_span: frame.args_span,
        end_span: frame.end_span,
        findings: Findings::default(),
    }
}

/// Inputs and outputs: declared ones, then undeclared bindings.
fn ports(made: &Made, binds: &[Bind], text: &str) -> (Vec<Input>, Vec<Output>) {
    let (declared, binds) = match &made.signature {
        Some(signature) => {
            (declared(signature, made.generic.as_ref()), bindings::meant(signature, binds))
        }
        None => ((Vec::new(), Vec::new()), binds.into()),
    };
    let (mut inputs, mut outputs) = declared;
    let (known_inputs, known_outputs) = (inputs.len(), outputs.len());
    let (mut written_inputs, mut written_outputs) = Default::default();
    for bind in &*binds {
        let binding = Some(binding(bind, text));
        let port = bind.port().text.as_str();
        match bind {
            Bind::In { .. } => {
                let declared = inputs[..known_inputs].iter_mut().find(|it| *it.name == *port);
                let is_declared = declared.is_some();
                match declared.filter(|input| input.binding.is_none()) {
                    Some(input) => input.binding = binding,
                    None => {
                        let nth = following(&mut written_inputs, port, is_declared);
                        inputs.push(Input { nth, binding, ..input(port.into()) });
                    }
                }
            }
            Bind::Out { .. } => {
                let declared = outputs[..known_outputs].iter_mut().find(|it| *it.name == *port);
                let is_declared = declared.is_some();
                match declared.filter(|output| output.binding.is_none()) {
                    Some(output) => output.binding = binding,
                    None => {
                        let nth = following(&mut written_outputs, port, is_declared);
                        outputs.push(Output { nth, binding, ..output(port.into()) });
                    }
                }
            }
        }
    }
    (inputs, outputs)
}

fn binding(bind: &Bind, text: &str) -> Binding {
    let formula = |formula: &Option<ast::Formula>| formula.as_ref().map(|it| value(text, it));
    let (port, sign, value) = match bind {
        Bind::In { port, sign, formula: written } => (port, sign, formula(written)),
        Bind::Out { port, sign, entry, formula: written } => {
            let entry = entry.as_ref();
            let entry = entry.map(|it| Value { text: it.text.clone(), span: it.span, entry: None });
            (port, sign, entry.or_else(|| formula(written)))
        }
    };
    let last = value.as_ref().map_or(*sign, |value| value.span);
    Binding { span: port.span.to(last), port_span: port.span, value }
}

/// A formula, without resolving an entry.
pub(super) fn value(text: &str, formula: &ast::Formula) -> Value {
    let span = formula.span();
    let text = in_one_line(text, span).unwrap_or_else(|| formula.in_one_line());
    Value { text, span, entry: None }
}

/// The target of an edge or `start`, unresolved.
pub(super) fn target(name: Name) -> Target {
    Target { text: name.text, span: name.span, to: Destination::Element(None) }
}

/// The text at a place, if it is a single line without comments and extra spaces.
pub(super) fn in_one_line(text: &str, span: Span) -> Option<String> {
    let text = text.get(span.start as usize..span.end as usize)?;
    let mut before = b'\0';
    let fits = text.bytes().all(|byte| {
        let two = [std::mem::replace(&mut before, byte), byte];
        !matches!(byte, b'\n' | b'\r' | b'\t') && !matches!(&two, b"  " | b"//" | b"/*")
    });
    fits.then(|| text.to_owned())
}

/// States or events: declared ones, then the implicit one, then undeclared ones.
fn exits(kind: ComponentKind, edges: Vec<WrittenEdge>, signature: Option<&Signature>) -> Vec<Exit> {
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
            // Users of an interruptible plan must connect `Interrupted`.
            let required =
                declared.is_some() || **name != *"Interrupted" || signature.interrupting.is_some();
            exits.push(Exit { declared, required, known: true, ..exit(name.clone(), usual) });
        }
    }
    let (mut others, mut written) = (Vec::new(), Default::default());
    for edge in edges {
        let (name, new) = named(edge);
        let declared = exits.iter_mut().find(|known| *known.name == *name);
        let is_declared = declared.is_some();
        match declared.filter(|known| known.edge.is_none()) {
            Some(first) => first.edge = Some(new),
            None => {
                let kind = if name == special { special_kind } else { usual };
                let name: Arc<str> = name.into();
                let nth = following(&mut written, name.clone(), is_declared);
                others.push(Exit { nth, edge: Some(new), ..exit(name, kind) });
            }
        }
    }
    others.sort_by_key(|exit| exit.kind != special_kind);
    exits.extend(others);
    exits
}

/// Splits a state or event and its edge.
fn named(edge: WrittenEdge) -> (String, Edge) {
    let WrittenEdge { name, suspends, target, reason, span } = edge;
    let target = match (target.map(self::target), reason, suspends) {
        (Some(Target { text, span, to }), _, Some(word)) => {
            let text = format!("{SUSPEND}{text}");
            Some(Target { text, span: word.to(span), to })
        }
        (Some(Target { text, span, to }), Some(reason), None) => {
            let text = format!("{text} {}", reason.text);
            Some(Target { text, span: span.to(reason.span), to })
        }
        (target, ..) => target,
    };
    (name.text, Edge { span, name_span: name.span, target })
}

/// The number of the next occurrence of a name; `written` counts occurrences except the first
/// declared one.
fn following<N: Hash + Eq>(written: &mut FxHashMap<N, usize>, name: N, is_declared: bool) -> u16 {
    let count = written.entry(name).or_insert(usize::from(is_declared));
    *count += 1;
    u16::try_from(*count).unwrap_or(u16::MAX)
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

/// The ports of a template or plan, unbound.
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

/// The port for a table, which the signature with columns lacks.
fn table(signature: &Signature) -> Option<Input> {
    let (port, _) = signature.template()?.table()?;
    let (name, declared) = (port.name.as_str().into(), Some(port.span));
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
