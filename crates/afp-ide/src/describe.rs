//! Definitions as one-line declarations.

use crate::View;
use afp_dsl::index::{Definition, DefinitionId, DefinitionKind, Meaning, Word};
use afp_dsl::outline::{Component, ComponentKind, Entry};
use afp_dsl::toolbox::TemplateKind;
use afp_dsl::types::text::{number, quantity};
use afp_dsl::types::{Dimension, Type};
use afp_syntax::units::Unit;

/// The declaration of a definition in one line, without its body.
pub(crate) fn declaration(view: &View, id: DefinitionId) -> String {
    let definition = view.index().definition(id);
    let name = view.name_of(id);
    match definition.kind {
        DefinitionKind::Component(kind) => match definition.made_from {
            Some(made) => format!("{} {name}: {}", kind.keyword(), view.name_of(made)),
            None => format!("{} {name}", kind.keyword()),
        },
        DefinitionKind::Template(kind) => format!("{} {name}", template_keyword(kind)),
        DefinitionKind::Entry(_) => match entry(view, definition) {
            Some(entry) => entry_line(view, entry),
            None => one_line(view.text_of(definition.span)),
        },
        DefinitionKind::Plan => format!("plan {name}"),
        DefinitionKind::Enum => format!("enum {name}"),
        DefinitionKind::Toolbox => format!("toolbox {name}"),
        DefinitionKind::Scenario => format!("scenario {name}"),
        DefinitionKind::Value => {
            format!("{}.{name}", definition.owner.map_or("", |id| view.name_of(id)))
        }
        DefinitionKind::Alias => {
            let made = definition.made_from.map_or("", |id| view.name_of(id));
            format!("use {made} as {name}")
        }
        DefinitionKind::Table => table(view, definition, name),
        // A state of a declared computation has a body.
        DefinitionKind::State => one_line(view.text_of(definition.span)),
        DefinitionKind::Column => {
            one_line(view.text_of(definition.span)).trim_end_matches(',').to_owned()
        }
        _ => head(&one_line(view.text_of(definition.span))),
    }
}

pub(crate) fn entry<'a>(view: &View<'a>, definition: &Definition) -> Option<&'a Entry> {
    let plans = view.outline().plans.iter();
    let mut entries = plans.flat_map(|plan| &plan.entries);
    entries.find(|entry| entry.span == definition.span)
}

pub(crate) fn component<'a>(view: &View<'a>, definition: &Definition) -> Option<&'a Component> {
    let plans = view.outline().plans.iter();
    let mut all = plans.flat_map(|plan| plan.components());
    all.find(|component| component.span == definition.span)
}

fn table(view: &View, definition: &Definition, name: &str) -> String {
    let mut tables = view.outline().files.iter().flat_map(|file| &file.tables);
    let table = tables.find(|table| table.span == definition.span);
    let columns = table.map_or(&[][..], |table| &table.columns).iter().map(|column| {
        let ty = column.ty.as_ref().map_or("?".to_owned(), ToString::to_string);
        format!("{}: {ty}", column.name.text)
    });
    format!("table {name}({})", columns.collect::<Vec<_>>().join(", "))
}

fn entry_line(view: &View, entry: &Entry) -> String {
    let mut line = head(&one_line(view.text_of(entry.span)));
    // Only an inferred type is worth adding.
    if let (None, Some(ty), Some(name)) = (&entry.written_type, &entry.ty, &entry.name) {
        line = line.replacen(&name.text, &format!("{}: {ty}", name.text), 1);
    }
    line
}

fn head(line: &str) -> String {
    line.split('{').next().unwrap_or_default().trim_end().to_owned()
}

/// A text in one line, with single spaces and without comments.
pub(crate) fn one_line(text: &str) -> String {
    let solid = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let words: Vec<_> = solid.flat_map(str::split_whitespace).collect();
    words.join(" ")
}

pub(crate) fn template_keyword(kind: TemplateKind) -> &'static str {
    match kind {
        TemplateKind::Actor => "actor",
        TemplateKind::Supervisor => "supervisor",
        TemplateKind::Computation => "computation",
    }
}

pub(crate) fn component_kind(kind: TemplateKind) -> ComponentKind {
    match kind {
        TemplateKind::Actor => ComponentKind::Actor,
        TemplateKind::Supervisor => ComponentKind::Supervisor,
        TemplateKind::Computation => ComponentKind::Computation,
    }
}

/// The units of a dimension: the usual one, then all others.
pub(crate) fn units(dimension: Dimension) -> Vec<String> {
    let usual = Some(dimension.usual_unit()).filter(|usual| !usual.is_empty());
    let is_of_it = |symbol: &str| Unit::parse(symbol).is_some_and(|it| it.dimension == dimension);
    let others =
        Unit::symbols().filter(|symbol| is_of_it(symbol) && Some(*symbol) != usual.as_deref());
    usual.iter().cloned().chain(others.map(str::to_owned)).collect()
}

pub(crate) fn bound(value: f64, ty: Option<&Type>) -> String {
    match ty {
        Some(Type::Quantity(dimension)) => quantity(value, *dimension),
        _ => number(value),
    }
}

pub(crate) fn word(meaning: Meaning) -> Option<&'static str> {
    let Meaning::Word(word) = meaning else { return None };
    Some(match word {
        Word::Ok => "The sub-plan has ended by one of its own states.",
        Word::Interrupted => "The sub-plan has been ended by an event of one of its supervisors.",
        Word::Error => "A fault: the element cannot continue.",
        Word::DeadlineMissed => "The supervisor was not polled in time.",
        Word::Terminate => "The plan ends.",
        Word::Fail => "The plan ends in 'Error', for the reason after it.",
        Word::Ignore => "The event is not taken.",
        Word::Resume => "The active element continues and reads new values with its 'live' inputs.",
        Word::Suspend => "The active element is suspended, and the handler starts.",
        Word::Return => "The element that was suspended continues.",
        Word::Type => "A type of the language.",
        Word::Truth => "A truth value.",
        Word::Resource => {
            "A part of the robot that the template controls; only one element at a time may."
        }
        Word::Fault => "A fault that every sensor has.",
        Word::Amount => "The amount of the fault.",
        Word::Field => "A part of the signal.",
        Word::All => "Every actor.",
        Word::Other => "The supervisor that reports the second event.",
        #[allow(unreachable_patterns, reason = "reserved for later versions of the language")]
        _ => return None,
    })
}
