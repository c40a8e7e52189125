//! References in the files of a project, from the index.

use super::project::Project;
use super::tree::{self, name_token};
use afp_syntax::item::Item;
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

/// The tokens that mean an item of the file `home`, with their files and its declaration.
pub(super) fn to(project: &Project, home: usize, item: &Item) -> Vec<(usize, Token)> {
    let declared = tree::find(&project.roots[home], item).ok();
    let Some(name) = declared.as_ref().and_then(name_token) else { return Vec::new() };
    let uses = project.references(home, &name);
    std::iter::once((home, name)).chain(uses).collect()
}

/// The edges and the start that lead to an element of a file.
pub(super) fn to_element(project: &Project, home: usize, element: &Item) -> Vec<Token> {
    let all = to(project, home, element).into_iter().skip(1);
    let leads = |token: &Token| parent_kind(token).is_some_and(|kind| kind != Kind::Path);
    all.filter(|(file, token)| *file == home && leads(token)).map(|(_, token)| token).collect()
}

/// The formulas of a plan that read its entry.
pub(super) fn reads_of(project: &Project, home: usize, entry: &Item) -> Vec<Token> {
    let all = to(project, home, entry).into_iter().skip(1);
    let reads = |(file, token): &(usize, Token)| {
        let bind = alone(token);
        parent_kind(token) == Some(Kind::Ref)
            && scenario(token).is_none()
            && !bind.is_some_and(|bind| project.is_output(*file, &bind))
    };
    all.filter(reads).map(|(_, token)| token).collect()
}

/// The sub-plans of a file that use a plan of it.
pub(super) fn users_of(project: &Project, home: usize, plan: &Item) -> Vec<Node> {
    let all = to(project, home, plan).into_iter().filter(|(file, _)| *file == home);
    all.filter_map(|(_, token)| token.parent_ancestors().find(|n| n.kind() == Kind::Element))
        .collect()
}

/// The names in a file's scenarios that mean one of the items of the file `home`.
pub(super) fn in_scenarios(
    project: &Project,
    home: usize,
    items: &[Item],
    file: usize,
) -> Vec<Token> {
    let all = items.iter().flat_map(|item| to(project, home, item));
    let own = all.filter(|(other, token)| *other == file && scenario(token).is_some());
    own.map(|(_, token)| token).collect()
}

pub(super) fn scenario(token: &Token) -> Option<Node> {
    token.parent_ancestors().find(|node| node.kind() == Kind::Scenario)
}

/// The binding that consists only of a name.
pub(super) fn alone(name: &Token) -> Option<Node> {
    name.parent()?.parent().filter(|node| node.kind() == Kind::BindSame)
}

fn parent_kind(token: &Token) -> Option<Kind> {
    token.parent().map(|parent| parent.kind())
}
