//! Ports, formulas, units and types.

use super::bodies::{Piece, plain};
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
use afp_syntax::source::Span;
use afp_syntax::units::Unit;

/// What a value shall be.
pub(super) struct Expected {
    ty: Type,
    default: Option<Constant>,
}

/// What a value at a place shall be; `None` where that is not known.
pub(super) fn wanted(view: &View, wanted: &Wanted, offset: u32) -> Option<Expected> {
    match wanted {
        Wanted::Port(node, port) => {
            let component = view.component(node)?;
            let input = component.inputs.iter().find(|input| *input.name == **port)?;
            Some(Expected { ty: input.ty.clone()?, default: input.default.clone() })
        }
        Wanted::Entry(node) => {
            let span = view.node_span(node);
            let plan = view.plan_at(offset)?;
            let entry = plan.entries.iter().find(|entry| entry.span == span)?;
            Some(Expected { ty: entry.ty.clone()?, default: None })
        }
        Wanted::Time => {
            Some(Expected { ty: Type::Quantity(Dimension::named("duration")?), default: None })
        }
        Wanted::Unknown => None,
    }
}

/// Whether a port takes a table, which is no value.
pub(super) fn takes_table(view: &View, wanted: &Wanted) -> bool {
    let Wanted::Port(node, port) = wanted else { return false };
    let made =
        view.component(node).and_then(|component| component.template.as_ref()?.made_from.as_ref());
    let Some(MadeFrom::Template { toolbox, index }) = made else { return false };
    let reads = toolbox.templates.get(*index).and_then(|template| template.reads_table.as_ref());
    reads.is_some_and(|reads| reads.port.name == *port)
}

/// Ports that are not bound yet, but by the word itself: those that need a value first.
pub(super) fn ports(list: &mut List, component: Option<&Component>) {
    let Some(component) = component else { return };
    let word = list.replaces;
    let is_open = |binding: &Option<Binding>| {
        binding.as_ref().is_none_or(|binding| binding.port_span.start == word.start)
    };
    for input in component.inputs.iter().filter(|port| is_open(&port.binding)) {
        let insert = vec![Piece::Text(format!("{} = ", input.name)), Piece::Hole(String::new())];
        port(
            list,
            &input.name,
            insert,
            input.declared,
            u8::from(!input.required),
            input_text(input),
        );
    }
    for output in component.outputs.iter().filter(|port| is_open(&port.binding)) {
        let insert = vec![Piece::Text(format!("{} => ", output.name)), Piece::Hole(String::new())];
        port(list, &output.name, insert, output.declared, 2, output_text(output));
    }
}

fn port(
    list: &mut List,
    name: &str,
    insert: Vec<Piece>,
    declared: Option<Span>,
    rank: u8,
    detail: String,
) {
    let Some(id) = declared.and_then(|span| list.view.index().declared_at(span)) else { return };
    list.definition_as(id, name, insert, rank);
    if let Some(last) = list.all.last_mut() {
        last.detail = detail;
    }
}

/// What can be computed with: entries, those of the type that is wanted first, then values.
pub(super) fn formulas(list: &mut List, expected: Option<&Expected>, offset: u32) {
    let view = list.view;
    let entries = view.plan_at(offset).map_or(&[][..], |plan| &plan.entries);
    for entry in entries {
        let fits = expected.is_none_or(|expected| is_near(entry.ty.as_ref(), &expected.ty));
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
            let insert = vec![Piece::Hole("1".to_owned()), Piece::Text(format!(" {unit}"))];
            list.add(&format!("1 {unit}"), CompletionKind::Value, insert, 1);
        }
        _ => {}
    }
}

/// Whether a value of a type becomes one of another without much ado, or can be computed with for it.
fn is_near(ty: Option<&Type>, wanted: &Type) -> bool {
    match (ty, wanted) {
        (None, _) | (_, Type::Any | Type::Text) => true,
        (Some(Type::Int), Type::Quantity(dimension)) => *dimension == Dimension::NONE,
        (Some(ty), Type::Number) => ty.is_numeric(),
        // Factors without a dimension.
        (Some(Type::Quantity(own)), Type::Quantity(_)) => *own == Dimension::NONE,
        (Some(ty), wanted) => ty == wanted,
    }
}

fn add_entry(list: &mut List, entry: &Entry, rank: u8) {
    let name = entry.name.as_ref().and_then(|name| list.view.index().declared_at(name.span));
    if let Some(id) = name {
        list.definition(id, rank);
    }
}

/// The entries that an output can go to.
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

/// The units of a number, those of what is wanted alone where that is known.
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

/// Types: the language's, enums and object types in view; in toolboxes also those of any type.
pub(super) fn types(list: &mut List, offset: u32) {
    for name in ["bool", "int", "float", "string"].into_iter().chain(Dimension::names()) {
        list.add(name, CompletionKind::Type, plain(name), 1);
    }
    let view = list.view;
    let is_type = |kind| matches!(kind, DefinitionKind::Enum | DefinitionKind::Object);
    let of_file = view.index().definitions_in(view.file).filter(|(_, known)| is_type(known.kind));
    let visible = match view.is_plan_file() {
        true => view.index().visible(view.file, offset, is_type),
        false => of_file.map(|(id, _)| id).collect(),
    };
    visible.into_iter().for_each(|id| list.definition(id, 0));
    if !view.is_plan_file() {
        for name in ["any", "number"] {
            list.add(name, CompletionKind::Type, plain(name), 2);
        }
    }
}
