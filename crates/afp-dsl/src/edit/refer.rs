//! Everything in a file that refers to an item by name.

use super::Item;
use super::port::reads;
use super::tree::{self, below, binds, children, name_of, name_token, single, target, tokens};
use crate::syntax::kind::Kind;
use crate::syntax::{Node, Token};

/// The tokens that mean an item, its declaration included.
pub(super) fn to(root: &Node, item: &Item) -> Vec<Token> {
    let mut found = Vec::new();
    match item {
        Item::Plan { name } => to_plan(root, name, &mut found),
        Item::Inner { plan, name } => {
            if let Ok(node) = tree::plan(root, plan)
                && let Some(declared) = tree::inner(&node, name)
            {
                found.extend(name_token(&declared));
                match declared.kind() {
                    Kind::Element => found.extend(to_element(&node, name)),
                    Kind::Entry => {
                        found.extend(reads_of(&node, name));
                        found.extend(writes_of(&node, name));
                        found.extend(ports_of(root, plan, name));
                    }
                    _ => {}
                }
            }
        }
        Item::Local { .. } => {
            found.extend(tree::find(root, item).ok().as_ref().and_then(name_token))
        }
    }
    if !matches!(item, Item::Plan { .. }) {
        found.extend(in_scenarios(root, |meant| meant == item));
    }
    found
}

fn to_plan(root: &Node, name: &str, found: &mut Vec<Token>) {
    found.extend(tree::plan(root, name).ok().as_ref().and_then(name_token));
    let users = below(root, Kind::Element).filter(tree::is_subplan);
    let references = users.flat_map(|user| children(&user, Kind::Ref).collect::<Vec<_>>());
    let scenarios = children(root, Kind::Scenario)
        .flat_map(|s| children(&s, Kind::Ref).take(1).collect::<Vec<_>>());
    let names = references.chain(scenarios).filter_map(|reference| single(&reference));
    found.extend(names.filter(|token| token.text() == name));
}

/// The edges and the start that lead to an element.
pub(super) fn to_element(plan: &Node, name: &str) -> Vec<Token> {
    let edges = below(plan, Kind::Edge).filter_map(|edge| target(&edge));
    let starts = children(plan, Kind::Start).filter_map(|start| name_token(&start));
    edges.chain(starts).filter(|token| token.text() == name).collect()
}

/// The formulas of a plan that read an entry.
pub(super) fn reads_of(plan: &Node, name: &str) -> Vec<Token> {
    let formulas = |item: Node| match item.kind() {
        Kind::Entry => item.children().filter(|child| child.kind() != Kind::Type).collect(),
        _ => below(&item, Kind::Args).collect::<Vec<_>>(),
    };
    let all = plan.children().flat_map(formulas);
    all.flat_map(|formula| reads(&formula)).filter(|token| token.text() == name).collect()
}

/// The outputs in a plan that write an entry.
pub(super) fn writes_of(plan: &Node, name: &str) -> Vec<Token> {
    let outputs = below(plan, Kind::BindOut).filter_map(|bind| target(&bind));
    outputs.filter(|token| token.text() == name).collect()
}

/// The ports of sub-plans that stand for an entry of their plan.
pub(super) fn ports_of(root: &Node, plan: &str, name: &str) -> Vec<Token> {
    let users = users_of(root, plan);
    let ports = users.iter().flat_map(binds).filter_map(|bind| name_token(&bind));
    ports.filter(|token| token.text() == name).collect()
}

/// The sub-plans that are made from a plan.
pub(super) fn users_of(root: &Node, plan: &str) -> Vec<Node> {
    let elements = below(root, Kind::Element).filter(tree::is_subplan);
    elements.filter(|element| tree::template(element).as_deref() == Some(plan)).collect()
}

/// The names in scenarios that mean an item for which `wanted` holds.
pub(super) fn in_scenarios(root: &Node, wanted: impl Fn(&Item) -> bool) -> Vec<Token> {
    let mut found = Vec::new();
    for scenario in children(root, Kind::Scenario) {
        let plan = children(&scenario, Kind::Ref).next().and_then(|reference| single(&reference));
        let Some(plan) = plan.map(|token| token.text().to_owned()) else { continue };
        for path in paths(&scenario) {
            let names: Vec<_> = tokens(&path, Kind::Name).collect();
            let texts: Vec<_> = names.iter().map(Token::text).collect();
            let meant = resolve(root, &plan, &texts);
            let pairs = names.iter().zip(&meant);
            found.extend(pairs.filter(|(_, item)| wanted(item)).map(|(token, _)| token.clone()));
        }
    }
    found
}

/// The paths and references of a scenario that name items of its plan.
pub(super) fn paths(scenario: &Node) -> Vec<Node> {
    let lines = scenario.children().filter(|line| line.kind() != Kind::Ref);
    let inner = lines.flat_map(|line| line.descendants().collect::<Vec<_>>());
    inner
        .filter(|node| match node.kind() {
            Kind::Path => names_an_item(node),
            Kind::Ref => true,
            _ => false,
        })
        .collect()
}

/// Whether a path is one of the plan's: buttons, sensors and facts of the world are not.
fn names_an_item(path: &Node) -> bool {
    let Some(parent) = path.parent() else { return false };
    match parent.kind() {
        Kind::Action => tree::keyword(&parent)
            .is_some_and(|word| matches!(word.text(), "set" | "fire" | "finish")),
        Kind::Claim => {
            let alone = parent.children_with_tokens().filter(|each| !each.kind().is_trivia());
            alone.count() > 1 || tokens(path, Kind::Name).count() > 1
        }
        _ => true,
    }
}

/// What the names of a path mean, as far as they mean items.
fn resolve(root: &Node, plan: &str, names: &[&str]) -> Vec<Item> {
    let mut items = Vec::new();
    let mut plan = plan.to_owned();
    for (place, name) in names.iter().enumerate() {
        let Some(node) = tree::plan(root, &plan).ok().and_then(|node| tree::inner(&node, name))
        else {
            break;
        };
        items.push(Item::inner(&plan, *name));
        if node.kind() != Kind::Element {
            break;
        }
        if let Some(next) = names.get(place + 1)
            && children(&node, Kind::Guard).any(|guard| name_of(&guard).as_deref() == Some(*next))
        {
            items.push(Item::local(&plan, *name, *next));
            break;
        }
        let Some(inner) = tree::template(&node).filter(|_| tree::is_subplan(&node)) else { break };
        plan = inner;
    }
    items
}
