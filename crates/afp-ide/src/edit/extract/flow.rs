//! The entries and exits of a selection.

use std::collections::BTreeSet;

use super::Selection;
use crate::edit::tree::{below, children, edges, name_of, name_token, target};
use crate::edit::{Refused, tree};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

/// The flow of action between a selection and the rest of its plan.
pub(super) struct Flow {
    /// The first element of the new plan.
    pub first: String,
    /// The outside target of its states.
    pub ok: Option<String>,
    /// The outside target of its events.
    pub interrupted: Option<String>,
    /// Targets of edges from outside to inside.
    pub ways_in: Vec<Token>,
    /// Targets of edges from inside to outside.
    pub ways_out: Vec<Token>,
}

impl Flow {
    /// Finds these edges, and refuses a flow that a sub-plan cannot have.
    pub fn of(selection: &Selection) -> Result<Flow, Refused> {
        let resuming = resuming(&selection.plan);
        let inside = selection.elements.iter().filter_map(name_of);
        if let Some(name) = inside.into_iter().find(|name| resuming.contains(name)) {
            return Err(Refused::new(format!(
                "'{name}' resumes the active element, which is not possible from a separate plan"
            )));
        }
        let ways_in = ways_in(selection);
        let states = exits(selection, false);
        let events = exits(selection, true);
        let across =
            ways_in.iter().chain(&states).chain(&events).find(|token| tree::suspends(token));
        if let Some(name) = across {
            return Err(Refused::new(format!(
                "'suspend {}' leads across the border of the selection, which a sub-plan cannot do",
                name.text()
            )));
        }
        let firsts = one("'start' and edges lead to", &ways_in)?;
        let ok = one("states lead to", &states)?;
        let interrupted = one("events lead to", &events)?;
        if interrupted.as_deref() == Some("terminate") {
            return Err(Refused::new(
                "an event of the selection ends the plan as Interrupted, and a sub-plan cannot end its caller",
            ));
        }
        let usual = || name_of(&selection.elements[0]).unwrap_or_default();
        let first = firsts.unwrap_or_else(usual);
        let ways_out: Vec<_> = states.into_iter().chain(events).collect();
        if let Some(name) = ways_out.iter().find(|token| resuming.contains(token.text())) {
            return Err(Refused::new(format!(
                "'{}' resumes the selection's active element, which is not possible from outside",
                name.text()
            )));
        }
        Ok(Flow { first, ok, interrupted, ways_in, ways_out })
    }
}

/// Computations that lead to `resume` through computations only.
fn resuming(plan: &Node) -> BTreeSet<String> {
    let computations = || children(plan, Kind::Element).filter(tree::is_computation);
    let mut resuming = BTreeSet::new();
    loop {
        let known = resuming.len();
        resuming.extend(
            computations()
                .filter(|element| {
                    let mut targets = edges(element).filter_map(|edge| target(&edge));
                    targets.any(|token| token.text() == "resume" || resuming.contains(token.text()))
                })
                .filter_map(|element| name_of(&element))
                .collect::<Vec<_>>(),
        );
        if resuming.len() == known {
            return resuming;
        }
    }
}

/// Returns the only name among tokens, or refuses several.
fn one(what: &str, tokens: &[Token]) -> Result<Option<String>, Refused> {
    let names: BTreeSet<_> = tokens.iter().map(|token| token.text().to_owned()).collect();
    if names.len() > 1 {
        let list = afp_syntax::diagnostics::words::list(names.iter().map(String::as_str), "and");
        return Err(Refused::new(format!(
            "{what} {list}, but a sub-plan has only one target for them"
        )));
    }
    Ok(names.into_iter().next())
}

fn ways_in(selection: &Selection) -> Vec<Token> {
    let outside =
        |token: &Token| !token.parent_ancestors().any(|node| selection.elements.contains(&node));
    let starts = children(&selection.plan, Kind::Start).filter_map(|start| name_token(&start));
    let edges = below(&selection.plan, Kind::Edge).filter_map(|edge| target(&edge));
    starts.chain(edges).filter(outside).filter(|token| selection.is_inside(token)).collect()
}

/// The outside targets of states, or of events.
fn exits(selection: &Selection, events: bool) -> Vec<Token> {
    let owners = selection.elements.iter().flat_map(|element| match events {
        false => vec![element.clone()],
        true => children(element, Kind::Guard).collect(),
    });
    let targets =
        owners.flat_map(|owner| edges(&owner).filter_map(|edge| target(&edge)).collect::<Vec<_>>());
    targets
        .filter(|token| {
            !matches!(token.text(), "fail" | "ignore" | "resume" | "return")
                && !selection.is_inside(token)
        })
        .collect()
}
