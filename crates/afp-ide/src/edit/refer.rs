//! Everything in the files of a project that refers to an item by name.

use super::Item;
use super::port::reads;
use super::project::Project;
use super::tree::{self, below, binds, children, name_of, name_token, single, target, tokens};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

/// The tokens that mean an item of the file `home`, its declaration included, with their files.
pub(super) fn to(project: &Project, home: usize, item: &Item) -> Vec<(usize, Token)> {
    let mut found = Vec::new();
    let root = &project.roots[home];
    let own = |tokens: Vec<Token>| tokens.into_iter().map(move |token| (home, token));
    let Ok(declared) = tree::find(root, item) else { return found };
    found.extend(own(name_token(&declared).into_iter().collect()));
    match item {
        Item::Plan { name } => found.extend(to_plan(project, home, name)),
        Item::Enum { name } => found.extend(to_enum(project, home, name)),
        Item::Local { .. } => {}
        Item::Inner { plan, name } => {
            let Ok(node) = tree::plan(root, plan) else { return found };
            match declared.kind() {
                Kind::Element => found.extend(own(to_element(&node, name))),
                Kind::Entry => {
                    found.extend(own(reads_of(&node, name)));
                    found.extend(own(writes_of(&node, name)));
                    found.extend(ports_of(project, home, plan, name));
                }
                _ => {}
            }
        }
    }
    if !matches!(item, Item::Plan { .. } | Item::Enum { .. }) {
        found.extend(in_scenarios(project, |file, meant| file == home && meant == item));
    }
    found
}

/// The sub-plans and scenarios, of all files, that name a plan of the file `home`.
fn to_plan(project: &Project, home: usize, name: &str) -> Vec<(usize, Token)> {
    let mut found = Vec::new();
    for (file, root) in project.roots.iter().enumerate() {
        if project.plan(file, name).is_none_or(|(seen, _)| seen != home) {
            continue;
        }
        let users = below(root, Kind::Element).filter(tree::is_subplan);
        let references = users.flat_map(|user| children(&user, Kind::Ref).collect::<Vec<_>>());
        let scenarios = children(root, Kind::Scenario)
            .flat_map(|s| children(&s, Kind::Ref).take(1).collect::<Vec<_>>());
        let names = references.chain(scenarios).filter_map(|reference| single(&reference));
        found.extend(names.filter(|token| token.text() == name).map(|token| (file, token)));
    }
    found
}

/// The types and values, of all files, that name an enum of the file `home`.
fn to_enum(project: &Project, home: usize, name: &str) -> Vec<(usize, Token)> {
    let mut found = Vec::new();
    for (file, root) in project.roots.iter().enumerate() {
        if project.find(file, Kind::Enum, name).is_none_or(|(seen, _)| seen != home) {
            continue;
        }
        let tokens = below(root, Kind::Ref).filter_map(|reference| enum_of(&reference));
        found.extend(tokens.filter(|token| token.text() == name).map(|token| (file, token)));
    }
    found
}

/// The token of a reference that would name an enum: a type, or what stands before the value.
pub(super) fn enum_of(reference: &Node) -> Option<Token> {
    let names: Vec<_> = tokens(reference, Kind::Name).collect();
    let wanted = match reference.parent()?.kind() {
        Kind::Element | Kind::Guard => return None,
        Kind::Factor => 1,
        _ => 2,
    };
    names.first().filter(|_| names.len() == wanted).cloned()
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

/// The ports of sub-plans, of all files, that stand for an entry of a plan of the file `home`.
fn ports_of(project: &Project, home: usize, plan: &str, name: &str) -> Vec<(usize, Token)> {
    let mut found = Vec::new();
    for (file, root) in project.roots.iter().enumerate() {
        if project.plan(file, plan).is_some_and(|(seen, _)| seen == home) {
            let users = users_of(root, plan);
            let ports = users.iter().flat_map(binds).filter_map(|bind| name_token(&bind));
            found.extend(ports.filter(|token| token.text() == name).map(|token| (file, token)));
        }
    }
    found
}

/// The sub-plans of a file that are made from the plan of that name.
pub(super) fn users_of(root: &Node, plan: &str) -> Vec<Node> {
    let elements = below(root, Kind::Element).filter(tree::is_subplan);
    elements.filter(|element| tree::template(element).as_deref() == Some(plan)).collect()
}

/// The names in scenarios, of all files, that mean an item for which `wanted` holds; it is given
/// with its file.
pub(super) fn in_scenarios(
    project: &Project,
    wanted: impl Fn(usize, &Item) -> bool,
) -> Vec<(usize, Token)> {
    let mut found = Vec::new();
    for (file, root) in project.roots.iter().enumerate() {
        for scenario in children(root, Kind::Scenario) {
            let plan =
                children(&scenario, Kind::Ref).next().and_then(|reference| single(&reference));
            let Some(plan) = plan.map(|token| token.text().to_owned()) else { continue };
            for path in paths(&scenario) {
                let names: Vec<_> = tokens(&path, Kind::Name).collect();
                let texts: Vec<_> = names.iter().map(Token::text).collect();
                let meant = resolve(project, file, &plan, &texts);
                let pairs = names.iter().zip(&meant).filter(|(_, (home, i))| wanted(*home, i));
                found.extend(pairs.map(|(token, _)| (file, token.clone())));
            }
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

/// What the names of a path mean, as far as they mean items, each with its file.
fn resolve(project: &Project, file: usize, plan: &str, names: &[&str]) -> Vec<(usize, Item)> {
    let mut items = Vec::new();
    let (mut file, mut plan) = (file, plan.to_owned());
    for (place, name) in names.iter().enumerate() {
        let Some((home, node)) = project.plan(file, &plan) else { break };
        let Some(node) = tree::inner(&node, name) else { break };
        items.push((home, Item::inner(&plan, *name)));
        if node.kind() != Kind::Element {
            break;
        }
        if let Some(next) = names.get(place + 1)
            && children(&node, Kind::Guard).any(|guard| name_of(&guard).as_deref() == Some(*next))
        {
            items.push((home, Item::local(&plan, *name, *next)));
            break;
        }
        let Some(inner) = tree::template(&node).filter(|_| tree::is_subplan(&node)) else { break };
        (file, plan) = (home, inner);
    }
    items
}
