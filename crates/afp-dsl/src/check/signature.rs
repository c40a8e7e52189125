//! Signatures of components for bindings and edges: of a template, or of a plan used as an actor.

use std::rc::Rc;
use std::sync::Arc;

use crate::check::PlanHead;
use crate::graph::{Component, EntryKind, PlanId, TemplateId, ToolboxId};
use crate::table::Table;
use crate::toolbox::{Template, TemplateKind, Toolbox};
use crate::types::{Constant, Enum, Type};
use afp_syntax::source::Span;

/// Ports and outcomes of a template or plan.
pub(crate) struct Signature {
    pub name: String,
    pub kind: SignatureKind,
    pub inputs: Vec<Input>,
    pub outputs: Vec<OutputPort>,
    /// Entries of a plan that are not ports: its `var`s and `const`s.
    pub inner: Vec<(String, EntryKind, Span)>,
    pub outcomes: Vec<Arc<str>>,
    /// The template, unless it is a plan.
    pub template: Option<(TemplateId, Arc<Toolbox>)>,
    /// An edge that can end the plan as `Interrupted`.
    pub interrupting: Option<Span>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SignatureKind {
    Template(TemplateKind),
    /// A plan, by its index in [`crate::check::Program::plans`].
    Plan(usize),
}

pub(crate) struct Input {
    /// Its name, shared with the outline.
    pub name: Arc<str>,
    /// Its type; `None` for an invalid declaration.
    pub ty: Option<Type>,
    /// Whether it may be unbound.
    pub optional: bool,
    /// Its default.
    pub default: Option<Constant>,
    /// Minimum and maximum.
    pub range: Option<(f64, f64)>,
    pub span: Span,
}

pub(crate) struct OutputPort {
    pub name: Arc<str>,
    /// Its type; `None` for an invalid declaration.
    pub ty: Option<Type>,
    pub span: Span,
}

/// The signatures of everything that plans can use, made once.
pub(crate) struct Signatures {
    templates: Vec<Vec<Rc<Signature>>>,
    /// By index in [`crate::check::Program::plans`].
    plans: Vec<Rc<Signature>>,
}

impl Signatures {
    pub fn of(toolboxes: &[Arc<Toolbox>], plans: &[PlanHead]) -> Signatures {
        let templates = |(place, toolbox): (usize, &Arc<Toolbox>)| {
            let Ok(id) = u16::try_from(place).map(ToolboxId) else { return Vec::new() };
            let template = |index| {
                let id = TemplateId { toolbox: id, index };
                Rc::new(Signature::of_template(toolbox.clone(), id))
            };
            (0..=u16::MAX).take(toolbox.templates.len()).map(template).collect()
        };
        let plan = |(place, head)| Rc::new(Signature::of_plan(place, head));
        Signatures {
            templates: toolboxes.iter().enumerate().map(templates).collect(),
            plans: plans.iter().enumerate().map(plan).collect(),
        }
    }

    /// The signature of a template, by toolbox and index.
    pub fn template(&self, toolbox: ToolboxId, index: usize) -> Option<&Rc<Signature>> {
        self.templates.get(toolbox.index())?.get(index)
    }

    /// The signature of a template with an enum's values as states.
    pub fn of_enum(&self, toolbox: ToolboxId, name: &str, home: &Enum) -> Option<Rc<Signature>> {
        let is_it = |signature: &&Rc<Signature>| {
            let states = signature.template().and_then(|template| template.states_of.as_ref());
            let bound = states.and_then(|states| states.home.as_ref());
            signature.name == name && bound.is_some_and(|bound| **bound == *home)
        };
        self.templates.get(toolbox.index())?.iter().find(is_it).cloned()
    }

    /// The signature of a template that reads a table.
    pub fn of_table(
        &self,
        toolbox: ToolboxId,
        name: &str,
        table: &Arc<Table>,
    ) -> Option<Rc<Signature>> {
        let is_it = |signature: &&Rc<Signature>| {
            let reads = signature.template().and_then(|template| template.reads_table.as_ref());
            let bound = reads.and_then(|reads| reads.table.as_ref());
            signature.name == name && bound.is_some_and(|bound| Arc::ptr_eq(bound, table))
        };
        self.templates.get(toolbox.index())?.iter().find(is_it).cloned()
    }

    pub fn plan(&self, index: usize) -> &Rc<Signature> {
        &self.plans[index]
    }
}

impl Signature {
    fn of_template(toolbox: Arc<Toolbox>, id: TemplateId) -> Signature {
        let template = &toolbox.templates[usize::from(id.index)];
        Signature {
            name: template.name.clone(),
            kind: SignatureKind::Template(template.kind),
            inputs: inputs(template),
            outputs: outputs(template),
            inner: Vec::new(),
            outcomes: template
                .outcomes
                .iter()
                .map(|outcome| outcome.name.as_str().into())
                .collect(),
            interrupting: None,
            template: Some((id, toolbox)),
        }
    }

    fn of_plan(index: usize, head: &PlanHead) -> Signature {
        let of_kind = |kind| head.entries.iter().filter(move |entry| entry.kind == kind);
        Signature {
            name: head.name.as_ref().map(|name| name.text.clone()).unwrap_or_default(),
            kind: SignatureKind::Plan(index),
            inputs: of_kind(EntryKind::In)
                .map(|entry| Input {
                    name: entry.name.text.as_str().into(),
                    ty: entry.ty.clone(),
                    optional: entry.has_init,
                    default: entry.value.clone(),
                    range: entry.range,
                    span: entry.name.span,
                })
                .collect(),
            outputs: of_kind(EntryKind::Out)
                .map(|entry| OutputPort {
                    name: entry.name.text.as_str().into(),
                    ty: entry.ty.clone(),
                    span: entry.name.span,
                })
                .collect(),
            inner: [EntryKind::Var, EntryKind::Const]
                .into_iter()
                .flat_map(of_kind)
                .map(|entry| (entry.name.text.clone(), entry.kind, entry.name.span))
                .collect(),
            outcomes: vec!["OK".into(), "Interrupted".into()],
            template: None,
            interrupting: head.interrupting,
        }
    }

    /// The template, unless it is a plan.
    pub fn template(&self) -> Option<&Template> {
        let (id, toolbox) = self.template.as_ref()?;
        toolbox.templates.get(usize::from(id.index))
    }

    /// The declaration of a state or event, by index; `None` for implicit ones.
    pub fn outcome_span(&self, outcome: usize) -> Option<Span> {
        self.template()?.outcomes.get(outcome).map(|outcome| outcome.span)
    }

    /// The states or events that must be connected.
    pub fn required(&self) -> impl Iterator<Item = &str> {
        let is_plan = matches!(self.kind, SignatureKind::Plan(_));
        let optional = is_plan && self.interrupting.is_none();
        let outcomes = self.outcomes.iter().map(|outcome| &**outcome);
        outcomes.filter(move |outcome| !(optional && *outcome == "Interrupted"))
    }

    /// The component of an element; `None` for a supervisor.
    pub fn component(&self) -> Option<Component> {
        match self.kind {
            SignatureKind::Plan(index) => {
                u16::try_from(index).ok().map(PlanId).map(Component::SubPlan)
            }
            SignatureKind::Template(kind) => {
                let (id, _) = self.template.as_ref()?;
                match kind {
                    TemplateKind::Actor => Some(Component::Actor(*id)),
                    TemplateKind::Computation => Some(Component::Computation(*id)),
                    TemplateKind::Supervisor => None,
                }
            }
        }
    }
}

impl SignatureKind {
    /// A description with an article.
    pub fn describe(self) -> &'static str {
        match self {
            SignatureKind::Plan(_) => "a plan",
            SignatureKind::Template(TemplateKind::Actor) => "an actor",
            SignatureKind::Template(TemplateKind::Supervisor) => "a supervisor",
            SignatureKind::Template(TemplateKind::Computation) => "a computation",
        }
    }

    /// Its keyword in a plan.
    pub fn keyword(self) -> &'static str {
        match self {
            SignatureKind::Plan(_) => "subplan",
            SignatureKind::Template(TemplateKind::Actor) => "actor",
            SignatureKind::Template(TemplateKind::Supervisor) => "supervise",
            SignatureKind::Template(TemplateKind::Computation) => "computation",
        }
    }
}

fn inputs(template: &Template) -> Vec<Input> {
    let input = |port: &crate::toolbox::InPort| Input {
        name: port.name.as_str().into(),
        ty: Some(port.ty.clone()),
        optional: port.default.is_some(),
        default: port.default.clone(),
        range: port.range,
        span: port.span,
    };
    template.inputs.iter().map(input).collect()
}

fn outputs(template: &Template) -> Vec<OutputPort> {
    let reads = template.reads_table.as_ref();
    let table = reads.and_then(|reads| reads.table.as_ref());
    let is_broken = |index: usize| {
        let column = table.and_then(|table| table.columns.get(index));
        column.is_some_and(|column| column.ty.is_none())
    };
    let output = |(index, port): (usize, &crate::toolbox::OutPort)| OutputPort {
        name: port.name.as_str().into(),
        ty: Some(port.ty.clone()).filter(|_| !is_broken(index)),
        span: port.span,
    };
    template.outputs.iter().enumerate().map(output).collect()
}
