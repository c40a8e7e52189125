//! From an error in a toolbox's Rust code to its declaration.

use crate::names::{camel, snake};
use afp_dsl::toolbox::{Template, Toolbox};
use afp_syntax::source::Span;

/// The declaration for an error of the Rust compiler: a state, an event or a port of a template, or
/// else the template; `None` without such a declaration.
///
/// `said` are the names in the error's text, `line` the names in the marked line of Rust, `around`
/// the names in the head of the surrounding item.
pub fn declaration(
    toolbox: &Toolbox,
    said: &[&str],
    line: &[&str],
    around: &[&str],
) -> Option<Span> {
    let named = |names: &[&str]| {
        let is_named = |template: &&Template| is_in(names, &template.name);
        toolbox.templates.iter().find(is_named)
    };
    let template = named(said).or_else(|| named(around))?;
    let outcomes = template.outcomes.iter().map(|outcome| (&outcome.name, outcome.span));
    let outputs = template.outputs.iter().map(|port| (&port.name, port.span));
    let inputs = template.inputs.iter().map(|port| (&port.name, port.span));
    // A line with a value of the wrong type also names its state; the port is more exact.
    let parts: Vec<_> = outputs.chain(inputs).chain(outcomes).collect();
    // For an undeclared state, its ports are irrelevant.
    let of_outcomes = said.contains(&"State") || said.contains(&"Event");
    let line = if of_outcomes { &[] } else { line };
    let part = [said, line].into_iter().find_map(|names| {
        let part = parts.iter().find(|(name, _)| is_in(names, name));
        part.map(|(_, span)| *span)
    });
    Some(part.unwrap_or(template.span))
}

/// Whether a name of the toolbox is among names of Rust.
fn is_in(names: &[&str], name: &str) -> bool {
    names.contains(&&*camel(name)) || names.contains(&&*snake(name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use afp_syntax::source::Source;

    const TEXT: &str = "toolbox gripper
actor Grip {
    in maxForce: force
    out reached: length on Held
    state Held
    state Missed
}
supervisor CheckLost { event Lost }";

    fn found(said: &str, line: &str, around: &str) -> Option<&'static str> {
        let (toolbox, _) = Toolbox::parse(&Source::new("gripper.afp", TEXT), 0, "gripper");
        let words = |text: &'static str| text.split(' ').collect::<Vec<_>>();
        let [said, line, around] = [said, line, around].map(|text| words(text.to_owned().leak()));
        let span = declaration(&toolbox.unwrap(), &said, &line, &around)?;
        TEXT.get(span.start as usize..span.end as usize)
    }

    #[test]
    fn the_smallest_named_declaration_counts() {
        let head = "impl Actor templates Grip E for Grip";
        assert_eq!(found("Quantity integer", "State Held reached 3", head), Some("reached"));
        assert_eq!(found("Found State", "State Found reached 3", head), Some("Grip"));
        assert_eq!(found("u8", "let x inputs max_force", head), Some("maxForce"));
        assert_eq!(found("pattern Missed not covered", "match state", head), Some("Missed"));
        assert_eq!(found("cannot find type CheckLost", "toolbox gripper", ""), Some("CheckLost"));
        assert_eq!(found("borrowed value", "let x", "fn helper"), None);
    }
}
