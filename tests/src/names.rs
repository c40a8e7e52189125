//! The names of a plan's ids, line by line, to compare both back ends.

use afp_core::trace::{ComponentId, ComponentKind, Names, Outcome, TraceEntryId};

use crate::platform::Log;

/// More outcomes, ports and choices than any test has.
const MANY: u16 = 16;

pub fn note(names: &impl Names, log: &Log) {
    for id in (0..names.components()).map(ComponentId) {
        log.note(component(names, id));
    }
    for id in (0..names.entries()).map(TraceEntryId) {
        let entry = names.entry(id);
        let choices = (0..MANY).map(|value| names.choice(id, value));
        let choices: Vec<&str> = choices.filter(|choice| !choice.is_empty()).collect();
        let unit = if entry.unit.is_empty() { "" } else { " in " };
        log.note(format!(
            "[{:?} {}: {}{unit}{} {}]",
            entry.kind,
            entry.path,
            entry.ty,
            entry.unit,
            choices.join(" ")
        ));
    }
}

/// `[Actor a: Work (name value) Done -> b]`
fn component(names: &impl Names, id: ComponentId) -> String {
    let component = names.component(id);
    let special = match component.kind {
        ComponentKind::Supervisor => Outcome::DeadlineMissed,
        _ => Outcome::Error,
    };
    let outcomes = (0..MANY).map(Outcome::Declared).chain([special]).filter_map(|outcome| {
        let (name, target) = (names.outcome(id, outcome), names.target(id, outcome));
        (!name.is_empty()).then(|| format!(" {name} -> {target}"))
    });
    let outcomes: String = outcomes.collect();
    let reactions = (0..MANY).map_while(|n| names.reaction(id, n)).map(|each| {
        let watcher = names.component(each.supervisor).path;
        let event = names.outcome(each.supervisor, each.outcome);
        format!(" {watcher}.{event} -> {}", each.target)
    });
    let reactions: String = reactions.collect();
    let inputs = (0..MANY).map(|port| names.input(id, port)).filter(|name| !name.is_empty());
    let inputs: Vec<&str> = inputs.collect();
    let (kind, path, template) = (component.kind, component.path, component.template);
    format!("[{kind:?} {path}: {template} ({}){outcomes}{reactions}]", inputs.join(" "))
}
