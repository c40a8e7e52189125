//! Ports, formulas, units and types.

use super::bodies::{plain, with_holes};
use super::context::Wanted;
use super::{CompletionKind, List};
use crate::View;
use crate::signature::{input_text, output_text};
use afp_draw::formula::constant;
use afp_dsl::graph::EntryKind;
use afp_dsl::index::DefinitionKind;
use afp_dsl::outline::{Binding, Component, Entry, MadeFrom};
use afp_dsl::toolbox::Constant;
use afp_dsl::types::{Dimension, Type};
use afp_syntax::Node;
use afp_syntax::kind::Kind;
use afp_syntax::source::Span;
use afp_syntax::units::Unit;

pub(super) struct Expected {
    ty: Type,
    default: Option<Constant>,
    of_enum: bool,
}

impl From<Type> for Expected {
    fn from(ty: Type) -> Expected {
        Expected { ty, default: None, of_enum: false }
    }
}

/// The requirements of a value at a place; `None` if unknown.
pub(super) fn wanted(view: &View, wanted: &Wanted, offset: u32) -> Option<Expected> {
    match wanted {
        Wanted::Port(node, port) => {
            let component = view.component(node)?;
            let input = component.inputs.iter().find(|input| *input.name == **port)?;
            let of_enum = gives_states(component, port);
            Some(Expected { ty: input.ty.clone()?, default: input.default.clone(), of_enum })
        }
        Wanted::Entry(node) => {
            let (_, entry) = entry_at(view, node, offset)?;
            entry.ty.clone().map(Expected::from)
        }
        Wanted::Named(path) => {
            let name = view.index().definition(view.named_by(path)?).name;
            let mut entries = view.outline().plans.iter().flat_map(|plan| &plan.entries);
            let entry = entries.find(|it| it.name.as_ref().is_some_and(|it| it.span == name))?;
            entry.ty.clone().map(Expected::from)
        }
        Wanted::Time => Dimension::named("duration").map(Type::Quantity).map(Expected::from),
        Wanted::Unknown => None,
    }
}

/// The entry of a node, and its index in its plan.
fn entry_at<'a>(view: &View<'a>, node: &Node, offset: u32) -> Option<(usize, &'a Entry)> {
    let span = view.node_span(node);
    view.plan_at(offset)?.entries.iter().enumerate().find(|(_, entry)| entry.span == span)
}

/// Whether a port's value is a state of a component.
fn gives_states(component: &Component, port: &str) -> bool {
    let made = component.template.as_ref().and_then(|template| template.made_from.as_ref());
    let Some(MadeFrom::Template { toolbox, index }) = made else { return false };
    let template = toolbox.templates.get(*index);
    let states = template.and_then(|template| Some((template, template.states_of.as_ref()?)));
    states.is_some_and(|(template, states)| {
        template.inputs.get(usize::from(states.port)).is_some_and(|input| input.name == port)
    })
}

/// The readable entries of a plan at a place; an initial value is computed before the run.
fn readable(view: &View, wanted: &Wanted, offset: u32) -> impl Fn(usize, &Entry) -> bool {
    let own = match wanted {
        Wanted::Entry(node) => entry_at(view, node, offset).map(|(at, own)| (at, own.kind)),
        _ => None,
    };
    move |at, entry| match own {
        None => true,
        Some((own, EntryKind::Const)) => entry.kind == EntryKind::Const && at < own,
        Some((_, EntryKind::In)) => entry.kind == EntryKind::Const,
        Some(_) => matches!(entry.kind, EntryKind::Const | EntryKind::In),
    }
}

/// Whether a port needs a table, which is not a value.
pub(super) fn takes_table(view: &View, wanted: &Wanted) -> bool {
    let Wanted::Port(node, port) = wanted else { return false };
    let made =
        view.component(node).and_then(|component| component.template.as_ref()?.made_from.as_ref());
    let Some(MadeFrom::Template { toolbox, index }) = made else { return false };
    let reads = toolbox.templates.get(*index).and_then(|template| template.reads_table.as_ref());
    reads.is_some_and(|reads| reads.port.name == *port)
}

/// Unbound ports, required ones first; the current word does not count as a binding.
pub(super) fn ports(list: &mut List, component: Option<&Component>) {
    let Some(component) = component else { return };
    let word = list.replaces;
    let is_open = |binding: &Option<Binding>| {
        binding.as_ref().is_none_or(|binding| binding.port_span.start == word.start)
    };
    for input in component.inputs.iter().filter(|port| is_open(&port.binding)) {
        let (insert, rank) = (format!("{} = ‹›", input.name), u8::from(!input.required));
        port(list, &input.name, &insert, input.declared, rank, input_text(input));
    }
    for output in component.outputs.iter().filter(|port| is_open(&port.binding)) {
        let insert = format!("{} => ‹›", output.name);
        port(list, &output.name, &insert, output.declared, 2, output_text(output));
    }
}

fn port(
    list: &mut List,
    name: &str,
    insert: &str,
    declared: Option<Span>,
    rank: u8,
    detail: String,
) {
    let Some(id) = declared.and_then(|span| list.view.index().declared_at(span)) else { return };
    list.definition_as(id, name, with_holes(insert), rank);
    if let Some(last) = list.all.last_mut() {
        last.detail = detail;
    }
}

/// Operands: entries of the wanted type, then other entries, then values.
pub(super) fn formulas(list: &mut List, wanted: &Wanted, offset: u32) {
    let view = list.view;
    let expected = self::wanted(view, wanted, offset);
    let expected = expected.as_ref();
    let entries = view.plan_at(offset).map_or(&[][..], |plan| &plan.entries);
    let readable = readable(view, wanted, offset);
    for (_, entry) in entries.iter().enumerate().filter(|(at, entry)| readable(*at, entry)) {
        let fits = expected.is_none_or(|expected| expected.is_near(entry.ty.as_ref()));
        let same = expected.is_some_and(|expected| entry.ty.as_ref() == Some(&expected.ty));
        let rank = match (same, fits) {
            (true, _) => 0,
            (_, true) => 2,
            _ => 4,
        };
        add_entry(list, entry, rank);
    }
    if let Some(expected) = expected {
        literals(list, expected);
    }
    inputs_of_computation(list, offset);
}

/// The inputs that a state of a declared computation reads.
fn inputs_of_computation(list: &mut List, offset: u32) {
    let view = list.view;
    let place = rowan::TextSize::from(offset);
    let is_around = |node: &Node| node.text_range().contains_inclusive(place);
    let templates = view.root().children().filter(|node| node.kind() == Kind::Template);
    let Some(template) = templates.into_iter().find(is_around) else { return };
    let mut states = template.children().filter(|node| node.kind() == Kind::Outcome);
    if states.any(|state| is_around(&state)) {
        list.definitions(view.ports(&template, DefinitionKind::Input).map(|(id, _)| id), 0);
    }
}

fn literals(list: &mut List, expected: &Expected) {
    let view = list.view;
    if let Some(default) = &expected.default {
        let text = constant(default, Some(&expected.ty));
        list.add(&text, CompletionKind::Value, plain(&text), 1);
    }
    match &expected.ty {
        Type::Bool => {
            for text in ["true", "false"] {
                list.add(text, CompletionKind::Value, plain(text), 1);
            }
        }
        Type::Enum(choices) => {
            for (name, span) in choices.variants.iter().zip(&choices.variant_spans) {
                let text = format!("{}.{name}", choices.name);
                match view.index().declared_at(*span) {
                    Some(id) => list.definition_as(id, &text, plain(&text), 1),
                    None => list.add(&text, CompletionKind::Value, plain(&text), 1),
                }
            }
        }
        Type::Quantity(dimension)
            if expected.default.is_none() && *dimension != Dimension::NONE =>
        {
            let unit = dimension.usual_unit();
            let insert = with_holes(&format!("‹1› {unit}"));
            list.add(&format!("1 {unit}"), CompletionKind::Value, insert, 1);
        }
        _ => {}
    }
}

impl Expected {
    /// Whether a value of a type fits the requirements with little or no computation.
    fn is_near(&self, ty: Option<&Type>) -> bool {
        match (ty, &self.ty) {
            (None, _) => true,
            (Some(ty), _) if self.of_enum => matches!(ty, Type::Enum(_)),
            (_, Type::Any | Type::Text) => true,
            (Some(Type::Int), Type::Quantity(dimension)) => *dimension == Dimension::NONE,
            (Some(ty), Type::Number) => ty.is_numeric(),
            (Some(ty), Type::Discrete) => ty.is_discrete(),
            // Factors without a dimension.
            (Some(Type::Quantity(own)), Type::Quantity(_)) => *own == Dimension::NONE,
            (Some(ty), wanted) => ty == wanted,
        }
    }
}

fn add_entry(list: &mut List, entry: &Entry, rank: u8) {
    let name = entry.name.as_ref().and_then(|name| list.view.index().declared_at(name.span));
    if let Some(id) = name {
        list.definition(id, rank);
    }
}

pub(super) fn outputs(list: &mut List, component: Option<&Component>, port: &str, offset: u32) {
    let output = component.and_then(|it| it.outputs.iter().find(|output| *output.name == *port));
    let ty = output.and_then(|output| output.ty.as_ref());
    let entries = list.view.plan_at(offset).map_or(&[][..], |plan| &plan.entries);
    for entry in
        entries.iter().filter(|entry| matches!(entry.kind, EntryKind::Var | EntryKind::Out))
    {
        let fits = ty.is_none() || entry.ty.is_none() || entry.ty.as_ref() == ty;
        add_entry(list, entry, if fits { 0 } else { 4 });
    }
}

/// The units of a number; if its dimension is known, only the units of that.
pub(super) fn units(list: &mut List, expected: Option<&Expected>) {
    let dimension = match expected.map(|expected| &expected.ty) {
        Some(Type::Quantity(dimension)) => Some(*dimension),
        Some(_) => return,
        None => None,
    };
    let usual = dimension.map(Dimension::usual_unit).filter(|unit| !unit.is_empty());
    let fits = |symbol: &str| {
        let unit = Unit::parse(symbol);
        dimension.is_none() || unit.is_some_and(|unit| Some(unit.dimension) == dimension)
    };
    let singles = Unit::symbols().map(str::to_owned).filter(|symbol| fits(symbol));
    let all: Vec<_> =
        usual.iter().cloned().chain(dimension.map(Dimension::si_unit)).chain(singles).collect();
    for unit in all.iter().filter(|unit| !unit.is_empty()) {
        list.add(unit, CompletionKind::Unit, plain(unit), u8::from(Some(unit) != usual.as_ref()));
    }
}

fn built_in_types() -> impl Iterator<Item = &'static str> {
    ["bool", "int", "float", "string"].into_iter().chain(Dimension::names())
}

fn is_type(kind: DefinitionKind) -> bool {
    matches!(kind, DefinitionKind::Enum | DefinitionKind::Object)
}

/// The names of the types that an entry of a plan file can have.
pub(crate) fn type_names(view: &View) -> Vec<String> {
    let visible = view.index().visible(view.file, 0, is_type).into_iter();
    let visible = visible.map(|id| view.name_of(id).to_owned());
    built_in_types().map(str::to_owned).chain(visible).collect()
}

/// Types: built-in ones, visible enums and object types; in toolboxes also generic types.
pub(super) fn types(list: &mut List, offset: u32) {
    for name in built_in_types() {
        list.add(name, CompletionKind::Type, plain(name), 1);
    }
    let view = list.view;
    let of_file = view.index().definitions_in(view.file).filter(|(_, known)| is_type(known.kind));
    let visible = match view.is_plan_file() {
        true => view.index().visible(view.file, offset, is_type),
        false => of_file.map(|(id, _)| id).collect(),
    };
    list.definitions(visible, 0);
    if !view.is_plan_file() {
        for name in ["any", "number"] {
            list.add(name, CompletionKind::Type, plain(name), 2);
        }
    }
}
