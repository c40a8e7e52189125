//! What a component is made from, in the one shape that bindings and edges need: a template, or a
//! plan used as an actor.

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
    /// Input ports in order.
    pub inputs: Vec<Input>,
    /// Output ports in order.
    pub outputs: Vec<OutputPort>,
    /// Entries of a plan that are no ports: its `var`s and `const`s.
    pub inner: Vec<(String, EntryKind, Span)>,
    /// States or events in order.
    pub outcomes: Vec<Arc<str>>,
    /// The template, unless it is a plan.
    pub template: Option<(TemplateId, Arc<Toolbox>)>,
    /// The edge of a plan that can end it as `Interrupted`.
    pub interrupting: Option<Span>,
}

/// What a signature belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SignatureKind {
    Template(TemplateKind),
    /// A plan, by its place in [`crate::check::Program::plans`].
    Plan(usize),
}

pub(crate) struct Input {
    /// Its name, which the outline has at each of its uses.
    pub name: Arc<str>,
    /// Its type; `None` when its declaration is broken.
    pub ty: Option<Type>,
    /// Whether it may be left unbound.
    pub optional: bool,
    /// Its value when it is left unbound.
    pub default: Option<Constant>,
    /// Least and greatest value.
    pub range: Option<(f64, f64)>,
    /// Its declaration.
    pub span: Span,
}

pub(crate) struct OutputPort {
    pub name: Arc<str>,
    /// Its type; `None` when its declaration is broken.
    pub ty: Option<Type>,
    /// Its declaration.
    pub span: Span,
}

/// The signatures of all that plans can use, made once.
pub(crate) struct Signatures {
    templates: Vec<Vec<Rc<Signature>>>,
    /// By place in [`crate::check::Program::plans`].
    plans: Vec<Rc<Signature>>,
}

impl Signatures {
    /// Those of the templates of toolboxes and of plans.
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

    /// That of a template, by toolbox and place in it.
    pub fn template(&self, toolbox: ToolboxId, index: usize) -> Option<&Rc<Signature>> {
        self.templates.get(toolbox.index())?.get(index)
    }

    /// That of the template of a name whose states are the values of an enum.
    pub fn of_enum(&self, toolbox: ToolboxId, name: &str, home: &Enum) -> Option<Rc<Signature>> {
        let is_it = |signature: &&Rc<Signature>| {
            let states = signature.template().and_then(|template| template.states_of.as_ref());
            let bound = states.and_then(|states| states.home.as_ref());
            signature.name == name && bound.is_some_and(|bound| **bound == *home)
        };
        self.templates.get(toolbox.index())?.iter().find(is_it).cloned()
    }

    /// That of the template of a name that reads a table.
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
    /// The signature of a template.
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

    /// The signature of a plan that is used as an actor.
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

    /// The template itself, unless it is a plan.
    pub fn template(&self) -> Option<&Template> {
        let (id, toolbox) = self.template.as_ref()?;
        toolbox.templates.get(usize::from(id.index))
    }

    /// Where a state or event is declared, by its place; `None` for those that every plan has.
    pub fn outcome_span(&self, outcome: usize) -> Option<Span> {
        self.template()?.outcomes.get(outcome).map(|outcome| outcome.span)
    }

    /// The states or events that have to be connected.
    pub fn required(&self) -> impl Iterator<Item = &str> {
        let is_plan = matches!(self.kind, SignatureKind::Plan(_));
        let optional = is_plan && self.interrupting.is_none();
        let outcomes = self.outcomes.iter().map(|outcome| &**outcome);
        outcomes.filter(move |outcome| !(optional && *outcome == "Interrupted"))
    }

    /// What an element made from it is; `None` for a supervisor.
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
    /// What it is, with an article.
    pub fn describe(self) -> &'static str {
        match self {
            SignatureKind::Plan(_) => "a plan",
            SignatureKind::Template(TemplateKind::Actor) => "an actor",
            SignatureKind::Template(TemplateKind::Supervisor) => "a supervisor",
            SignatureKind::Template(TemplateKind::Computation) => "a computation",
        }
    }

    /// The keyword that puts it into a plan.
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
