//! From an error in the Rust of a toolbox back to the declaration that it is about.

use crate::names::{camel, snake};
use afp_dsl::toolbox::{Template, Toolbox};
use afp_syntax::source::Span;

/// The declaration that an error of the Rust compiler is about: a state, an event or a port of a
/// template, else the template; `None` when it is about none of them.
///
/// `said` are the names in the error's text, `line` those in the line of Rust that it points at,
/// `around` those in the head of the item around that line.
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
    // A value of the wrong type stands in a line that names its state, too: the port says more.
    let parts: Vec<_> = outputs.chain(inputs).chain(outcomes).collect();
    // About a state that is not declared, the ports beside it say nothing.
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
    fn the_smallest_declaration_that_is_named_counts() {
        let head = "impl Actor templates Grip E for Grip";
        assert_eq!(found("Quantity integer", "State Held reached 3", head), Some("reached"));
        assert_eq!(found("Found State", "State Found reached 3", head), Some("Grip"));
        assert_eq!(found("u8", "let x inputs max_force", head), Some("maxForce"));
        assert_eq!(found("pattern Missed not covered", "match state", head), Some("Missed"));
        assert_eq!(found("cannot find type CheckLost", "toolbox gripper", ""), Some("CheckLost"));
        assert_eq!(found("borrowed value", "let x", "fn helper"), None);
    }
}
