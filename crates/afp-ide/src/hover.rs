//! The description of the word at a place.

mod words;

use crate::View;
use crate::describe::{self, component, declaration, entry, word};
use afp_dsl::index::{Definition, DefinitionId, DefinitionKind, Meaning};
use afp_dsl::timing::SupervisorTiming;
use afp_dsl::types::{Dimension, Type};
use afp_syntax::kind::Kind;
use afp_syntax::source::Span;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    pub span: Span,
    /// Its declaration in one line; empty for keywords.
    pub declaration: String,
    pub doc: String,
    /// Facts in Markdown, each a sentence or a list item.
    pub facts: Vec<String>,
}

impl Hover {
    /// Renders Markdown. Help texts come from plans and toolboxes, so do not render HTML in it.
    pub fn markdown(&self) -> String {
        let code = match self.declaration.is_empty() {
            true => String::new(),
            false => format!("```afp\n{}\n```", self.declaration),
        };
        let facts = self.facts.join("\n");
        let parts = [code, self.doc.clone(), facts];
        let parts: Vec<_> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        parts.join("\n\n")
    }
}

/// Returns the description of the word at a byte offset; `None` if it is unknown.
pub fn hover(view: &View, offset: u32) -> Option<Hover> {
    match view.name_at(offset) {
        Some(name) => of_name(view, name.span, name.meaning),
        None => of_keyword(view, offset),
    }
}

fn of_name(view: &View, span: Span, meaning: Meaning) -> Option<Hover> {
    if let Some(id) = meaning.definition() {
        let mut hover = of_definition(view, span, id);
        if let Meaning::Both { port, .. } = meaning {
            hover.facts.push(format!("for the port `{}`", declaration(view, port)));
        }
        return Some(hover);
    }
    let plain =
        |doc: String| Some(Hover { span, declaration: String::new(), doc, facts: Vec::new() });
    match meaning {
        Meaning::File(file) => plain(view.compiled.sources.get(file)?.name.clone()),
        Meaning::Ambiguous(several) => {
            let all = view.index().candidates(several).iter();
            let all = all.map(|id| format!("- `{}`", declaration(view, *id))).collect();
            let doc = "It may mean several things:".to_owned();
            Some(Hover { span, declaration: String::new(), doc, facts: all })
        }
        Meaning::Word(_) => {
            let mut hover = plain(word(meaning)?.to_owned())?;
            let dimension = Dimension::named(view.text_of(span));
            hover.facts.extend(dimension.and_then(|dimension| units(&Type::Quantity(dimension))));
            Some(hover)
        }
        _ => None,
    }
}

fn of_definition(view: &View, span: Span, id: DefinitionId) -> Hover {
    let definition = view.index().definition(id);
    let mut facts = Vec::new();
    let mut doc = definition.doc.clone();
    match definition.kind {
        DefinitionKind::Template(_) | DefinitionKind::Plan => facts.extend(members(view, id)),
        DefinitionKind::Alias => {
            let made = definition.made_from.map(|made| view.index().definition(made));
            doc = made.map_or(doc, |made| made.doc.clone());
        }
        DefinitionKind::Component(_) => {
            if let Some(made) = definition.made_from {
                let made = view.index().definition(made);
                doc = [doc, made.doc.clone()]
                    .into_iter()
                    .filter(|doc| !doc.is_empty())
                    .collect::<Vec<_>>()
                    .join("\n\n");
            }
            facts.extend(bounds(view, definition));
        }
        DefinitionKind::Input
        | DefinitionKind::Output
        | DefinitionKind::Column
        | DefinitionKind::Entry(_) => {
            facts.extend(ty(view, definition).and_then(|ty| units(&ty)));
        }
        _ => {}
    }
    Hover { span, declaration: declaration(view, id), doc, facts }
}

/// Ports and outcomes of a template; for a plan, the entries that are its ports.
fn members(view: &View, id: DefinitionId) -> Vec<String> {
    use DefinitionKind as Is;
    use afp_dsl::graph::EntryKind;

    let shown = |definition: &Definition| {
        matches!(definition.kind, Is::Input | Is::Output | Is::State | Is::Event)
            || matches!(definition.kind, Is::Entry(EntryKind::In | EntryKind::Out))
    };
    let members = view.index().members(id).filter(|(_, member)| shown(member));
    let line = |(id, member): (DefinitionId, &Definition)| {
        let doc = member.doc.lines().next().unwrap_or_default();
        let gap = if doc.is_empty() { "" } else { ": " };
        format!("- `{}`{gap}{doc}", declaration(view, id))
    };
    members.map(line).collect()
}

fn ty(view: &View, definition: &Definition) -> Option<Type> {
    if let Some(entry) = entry(view, definition) {
        return entry.ty.clone();
    }
    let mut tables = view.outline().files.iter().flat_map(|file| &file.tables);
    let column = tables
        .find_map(|table| table.columns.iter().find(|column| column.name.span == definition.name));
    if let Some(column) = column {
        return column.ty.clone();
    }
    let owner = view.index().definition(definition.owner?);
    let (_, template) = view.template(owner)?;
    let input = template.inputs.iter().find(|port| port.span == definition.name);
    let output = template.outputs.iter().find(|port| port.span == definition.name);
    input.map(|port| port.ty.clone()).or_else(|| output.map(|port| port.ty.clone()))
}

/// The units in which values of a type are written.
fn units(ty: &Type) -> Option<String> {
    let Type::Quantity(dimension) = ty else { return None };
    let usual = dimension.usual_unit();
    let all: Vec<_> = describe::units(*dimension).iter().map(|unit| format!("`{unit}`")).collect();
    match &all[..] {
        _ if usual.is_empty() => None,
        [usual, others @ ..] if !others.is_empty() => {
            Some(format!("Written in {usual}, or {}.", others.join(", ")))
        }
        _ => Some(format!("Written in `{usual}`.")),
    }
}

/// The time from the condition of a supervisor without errors until the robot has stopped.
fn bounds(view: &View, definition: &Definition) -> Vec<String> {
    let mut facts = Vec::new();
    let times = component(view, definition).and_then(|component| component.times);
    if let Some(times) = times {
        let time = afp_dsl::types::text::duration;
        facts.push(format!(
            "Polled every {}, deadline {}.",
            time(times.timing.period.as_nanos()),
            time(times.timing.deadline.as_nanos())
        ));
    }
    let Some(timing) = times.and_then(|_| view.compiled.timing()) else { return facts };
    let mut rows = timing.supervisors.iter();
    let Some(row) = rows.find(|row| row.span == definition.name) else { return facts };
    facts.extend(bound(row).map(|(label, why)| format!("It {label}: {why}.")));
    facts
}

/// The reaction bound of a supervisor and its parts; `None` if it interrupts nothing.
pub(crate) fn bound(row: &SupervisorTiming) -> Option<(String, String)> {
    let interruption = row.interruption.as_ref()?;
    let trust = interruption.trust.as_str();
    let label = match interruption.total() {
        Some(total) => format!("stops within {} ({trust})", afp_dsl::types::text::duration(total)),
        None => "stops within an unknown time".to_owned(),
    };
    Some((label, interruption.terms_in_words()))
}

fn of_keyword(view: &View, offset: u32) -> Option<Hover> {
    let at = rowan::TextSize::from(offset.min(u32::from(view.root().text_range().end())));
    let token = view.root().token_at_offset(at).find(|token| token.kind() == Kind::Keyword)?;
    let doc = words::help(token.text(), token.parent()?.kind())?.to_owned();
    let span = view.token_span(&token);
    Some(Hover { span, declaration: String::new(), doc, facts: Vec::new() })
}
