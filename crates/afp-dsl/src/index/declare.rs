//! The declarations of plan files and toolboxes.

use super::DefinitionKind;
use super::record::{Found, Meanings};
use crate::outline::{Component, Outline, Plan, Table};
use crate::toolbox::{DeviceKind, TemplateKind};
use afp_syntax::ast::{self, DevicePart, Item, Part};
use afp_syntax::source::Span;

/// A definition without a number yet; it refers to others by the places of their names.
#[derive(Clone, Debug)]
pub(crate) struct Declared {
    pub kind: DefinitionKind,
    pub name: Span,
    /// The complete definition.
    pub span: Span,
    /// The name of the enclosing definition.
    pub owner: Option<Span>,
    /// The name of its template or type.
    pub made_from: Option<Span>,
    /// Its `///` lines.
    pub doc: String,
}

impl Declared {
    fn new(kind: DefinitionKind, name: Span, span: Span) -> Declared {
        Declared { kind, name, span, owner: None, made_from: None, doc: String::new() }
    }

    fn owner(self, owner: Option<Span>) -> Declared {
        Declared { owner, ..self }
    }

    fn made_from(self, made_from: Option<Span>) -> Declared {
        Declared { made_from, ..self }
    }

    fn doc(self, doc: impl Into<String>) -> Declared {
        Declared { doc: doc.into(), ..self }
    }
}

/// The declarations of plan files.
pub(super) fn of_outline(outline: &Outline, meanings: &Meanings, all: &mut Vec<Declared>) {
    let lookup = meanings.lookup();
    let meant = |name: Span| match lookup.get(name) {
        Some(Found::Definition(definition)) => Some(definition),
        _ => None,
    };
    for file in &outline.files {
        for line in &file.uses {
            if let Some(alias) = &line.alias {
                let toolbox = line.toolbox.as_ref().and_then(|toolbox| meant(toolbox.span));
                let alias = Declared::new(DefinitionKind::Alias, alias.span, line.span);
                all.push(alias.made_from(toolbox));
            }
        }
        for each in &file.enums {
            let name = each.name.as_ref().map(|name| name.span);
            if let Some(name) = name {
                all.push(Declared::new(DefinitionKind::Enum, name, each.span).doc(&each.doc));
            }
            values(&each.variants, name, all);
        }
        file.tables.iter().for_each(|table| of_table(table, all));
        for scenario in &file.scenarios {
            if let Some(name) = &scenario.name {
                let plan = scenario.plan.and_then(|plan| outline.plan(plan).name.as_ref());
                let one = Declared::new(DefinitionKind::Scenario, name.span, scenario.span);
                all.push(one.made_from(plan.map(|name| name.span)));
            }
        }
    }
    for plan in &outline.plans {
        of_plan(plan, &meant, all);
    }
}

fn of_table(table: &Table, all: &mut Vec<Declared>) {
    let owner = table.name.as_ref().map(|name| name.span);
    if let Some(name) = owner {
        all.push(Declared::new(DefinitionKind::Table, name, table.span).doc(&table.doc));
    }
    all.extend(table.columns.iter().map(|column| {
        let one = Declared::new(DefinitionKind::Column, column.name.span, column.span);
        let ty = column.ty.as_ref().and_then(|ty| ty.declaration());
        one.doc(&column.doc).owner(owner).made_from(ty)
    }));
}

fn of_plan(plan: &Plan, meant: &dyn Fn(Span) -> Option<Span>, all: &mut Vec<Declared>) {
    let owner = plan.name.as_ref().map(|name| name.span);
    if let Some(name) = owner {
        all.push(Declared::new(DefinitionKind::Plan, name, plan.span).doc(&plan.doc));
    }
    for entry in &plan.entries {
        let Some(name) = &entry.name else { continue };
        let ty = entry.ty.as_ref().and_then(|ty| ty.declaration());
        let entry =
            Declared::new(DefinitionKind::Entry(entry.kind), name.span, entry.span).doc(&entry.doc);
        all.push(entry.owner(owner).made_from(ty));
    }
    for component in plan.supervisors.iter().chain(&plan.elements) {
        of_component(component, owner, meant, all);
        let name = component.name.as_ref().map(|name| name.span);
        for supervisor in &component.supervisors {
            of_component(supervisor, name, meant, all);
        }
    }
}

fn of_component(
    component: &Component,
    owner: Option<Span>,
    meant: &dyn Fn(Span) -> Option<Span>,
    all: &mut Vec<Declared>,
) {
    let Some(name) = &component.name else { return };
    // The template's name is the last one of its reference.
    let template = component.template.as_ref().and_then(|template| meant(template.name_span));
    let kind = DefinitionKind::Component(component.kind);
    let one = Declared::new(kind, name.span, component.span).doc(&component.doc);
    all.push(one.owner(owner).made_from(template));
}

fn values(values: &[ast::Name], owner: Option<Span>, all: &mut Vec<Declared>) {
    let values = values.iter();
    all.extend(
        values
            .map(|value| Declared::new(DefinitionKind::Value, value.span, value.span).owner(owner)),
    );
}

/// The declarations of a toolbox, even with errors.
pub(crate) fn of_toolbox(items: &[Item], meanings: &Meanings) -> Vec<Declared> {
    let mut all = Vec::new();
    let head = items.iter().find_map(|item| match item {
        Item::Toolbox(head) => head.name().map(|name| (name.span, head)),
        _ => None,
    });
    let owner = head.as_ref().map(|(name, _)| *name);
    for item in items {
        match item {
            Item::Toolbox(head) => {
                if let Some(name) = head.name() {
                    let one = Declared::new(DefinitionKind::Toolbox, name.span, head.span());
                    all.push(one.doc(head.doc()));
                }
            }
            Item::Enum(node) => {
                let name = node.name().map(|name| name.span);
                if let Some(name) = name {
                    let one = Declared::new(DefinitionKind::Enum, name, node.span());
                    all.push(one.doc(node.doc()).owner(owner));
                }
                values(&node.variants(), name, &mut all);
            }
            Item::Object(node) => {
                if let Some(name) = node.name() {
                    let one = Declared::new(DefinitionKind::Object, name.span, node.span());
                    all.push(one.doc(node.doc()).owner(owner));
                }
            }
            Item::Template(node) => of_template(node, owner, meanings, &mut all),
            Item::Device(node) => of_device(node, owner, &mut all),
            Item::Use(_) | Item::Plan(_) | Item::Scenario(_) | Item::Table(_) => {}
        }
    }
    all
}

/// The declarations of a template.
pub(crate) fn of_template(
    node: &ast::Template,
    toolbox: Option<Span>,
    meanings: &Meanings,
    all: &mut Vec<Declared>,
) {
    let owner = node.name().map(|name| name.span);
    if let Some(name) = owner {
        let one = Declared::new(DefinitionKind::Template(node.kind()), name, node.span());
        all.push(one.doc(node.doc()).owner(toolbox));
    }
    let outcome = match node.kind() {
        TemplateKind::Supervisor => DefinitionKind::Event,
        TemplateKind::Actor | TemplateKind::Computation => DefinitionKind::State,
    };
    for part in node.parts() {
        let (name, kind, span, doc, ty) = match &part {
            Part::In(port) => {
                (port.name(), DefinitionKind::Input, port.span(), port.doc(), port.ty())
            }
            Part::Out(port) => {
                (port.name(), DefinitionKind::Output, port.span(), port.doc(), port.ty())
            }
            Part::Outcome(node) => (node.name(), outcome, node.span(), node.doc(), None),
            Part::Icon(..)
            | Part::Uses(..)
            | Part::Needs(..)
            | Part::Timing(_)
            | Part::StatesOf(..)
            | Part::Exclusive(_) => continue,
        };
        if let Some(name) = name {
            let ty = ty.and_then(|ty| type_of(&ty, meanings));
            let one = Declared::new(kind, name.span, span).doc(doc);
            all.push(one.owner(owner).made_from(ty));
        }
    }
}

fn of_device(node: &ast::Device, toolbox: Option<Span>, all: &mut Vec<Declared>) {
    // The robot as a whole is identified by its keyword.
    let name = match node.kind() {
        DeviceKind::Robot => node.keyword(),
        _ => node.name(),
    };
    let owner = name.map(|name| name.span);
    if let Some(name) = owner {
        let one = Declared::new(DefinitionKind::Device, name, node.span());
        all.push(one.doc(node.doc()).owner(toolbox));
    }
    let mut part = |kind, name: Option<ast::Name>, span, doc: String, owner| {
        let name = name?.span;
        all.push(Declared::new(kind, name, span).doc(doc).owner(owner));
        Some(name)
    };
    for each in node.parts() {
        match each {
            DevicePart::Press(press) => {
                for control in press.controls() {
                    let doc = Some(control.doc()).filter(|doc| !doc.is_empty());
                    let doc = doc.unwrap_or_else(|| press.doc());
                    part(DefinitionKind::Control, control.name(), control.span(), doc, owner);
                }
            }
            DevicePart::Fault(fault) => {
                let (name, doc) = (fault.name(), fault.doc());
                let home = part(DefinitionKind::Fault, name, fault.span(), doc, owner);
                if let Some(amount) = fault.amount() {
                    let (name, doc) = (amount.name(), String::new());
                    part(DefinitionKind::Amount, name, amount.span(), doc, home);
                }
            }
            DevicePart::Signal(signal) => {
                let (name, doc) = (signal.name(), signal.doc());
                part(DefinitionKind::Signal, name, signal.span(), doc, owner);
            }
        }
    }
}

/// The enum or object type of a type.
fn type_of(ty: &ast::Type, meanings: &Meanings) -> Option<Span> {
    let factor = ty.factors().into_iter().next()?;
    match meanings.get(factor.reference?.name()?.span) {
        Some(Found::Definition(definition)) => Some(definition),
        _ => None,
    }
}
