//! Renames an item wherever files refer to it.

use super::project::Project;
use super::tree::{self, Scope, name_token, range, scope_of};
use super::workspace::Workspace;
use super::{Item, Refused, name, refer};
use afp_dsl::types::is_built_in;
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

pub(super) fn item(workspace: &mut Workspace, item: &Item, to: &str) -> Result<(), Refused> {
    let root = workspace.buffer().root();
    let node = tree::find(&root, item)?;
    match node.kind() {
        Kind::Element => name::check_element(to)?,
        Kind::Enum | Kind::Table if is_built_in(to) => {
            return Err(Refused::new(format!("'{to}' is a type of the language")));
        }
        _ => name::check(to)?,
    }
    name::check_free(&scope_of(&root, item)?, to, Some(item.name()))?;
    if to == item.name() {
        return Ok(());
    }
    if matches!(node.kind(), Kind::Plan | Kind::Enum | Kind::Table) {
        check_free_elsewhere(workspace, node.kind(), to)?;
    }
    if name_token(&node).is_none() {
        return Err(Refused::new("it has no name yet"));
    }
    let home = workspace.home;
    everywhere(workspace, |project| all_to(refer::to(project, home, item), to))
}

/// Renames items of a file at once, in only a part of it: the given numbers of bytes at start and
/// end stay unchanged.
pub(super) fn within(
    workspace: &mut Workspace,
    names: &[(Item, String)],
    before: usize,
    behind: usize,
) -> Result<(), Refused> {
    let home = workspace.home;
    let tokens = |project: &Project| {
        let end = usize::from(project.roots[home].text_range().end()).saturating_sub(behind);
        let inside = |(file, token): &(usize, Token)| {
            *file == home && (before..end).contains(&range(token).start)
        };
        let all = names.iter().flat_map(|(item, to)| all_to(refer::to(project, home, item), to));
        all.filter(|(token, _)| inside(token)).collect()
    };
    everywhere(workspace, tokens)
}

/// The new name of each token.
fn all_to(tokens: Vec<(usize, Token)>, to: &str) -> Vec<((usize, Token), &str)> {
    tokens.into_iter().map(|token| (token, to)).collect()
}

pub(super) fn column(
    workspace: &mut Workspace,
    table: &str,
    column: &str,
    to: &str,
) -> Result<(), Refused> {
    if matches!(to, "table" | "index") {
        return Err(Refused::new(format!("'{to}' is a port of computations that read tables")));
    }
    let missing = format!("the table '{table}' has no column '{column}'");
    inner(workspace, (&Item::table(table), Kind::Column), column, to, &missing)
}

/// Renames a value of an enum.
pub(super) fn value(
    workspace: &mut Workspace,
    enumeration: &str,
    value: &str,
    to: &str,
) -> Result<(), Refused> {
    let missing = format!("the enum '{enumeration}' has no value '{value}'");
    inner(workspace, (&Item::enumeration(enumeration), Kind::Variant), value, to, &missing)
}

/// Renames a part of an item outside plans.
fn inner(
    workspace: &mut Workspace,
    (item, kind): (&Item, Kind),
    name: &str,
    to: &str,
    missing: &str,
) -> Result<(), Refused> {
    name::check(to)?;
    let root = workspace.buffer().root();
    let scope = Scope::Inside(tree::find(&root, item)?, kind);
    if !scope.names().iter().any(|known| known == name) {
        return Err(Refused::new(missing));
    }
    if to == name {
        return Ok(());
    }
    name::check_free(&scope, to, Some(name))?;
    let home = workspace.home;
    let tokens = |project: &Project| {
        let item = tree::find(&project.roots[home], item).ok();
        let parts = item.iter().flat_map(|item| tree::below(item, kind));
        let declared =
            parts.filter(|each| tree::is_named(each, name)).find_map(|it| name_token(&it));
        let uses = declared.iter().flat_map(|name| project.references(home, name));
        all_to(uses.chain(declared.iter().map(|name| (home, name.clone()))).collect(), to)
    };
    everywhere(workspace, tokens)
}

/// Replaces names, given with their files.
fn everywhere<'n>(
    workspace: &mut Workspace,
    tokens: impl Fn(&Project) -> Vec<((usize, Token), &'n str)>,
) -> Result<(), Refused> {
    let project = workspace.project();
    spell_out(workspace, &project, &tokens(&project));
    let tokens = tokens(&workspace.project());
    for (file, buffer) in workspace.buffers.iter_mut().enumerate() {
        let own: Vec<_> = tokens.iter().filter(|((home, _), _)| *home == file).collect();
        let Some((_, to)) = own.first() else { continue };
        let before = shape(&buffer.root());
        buffer
            .splice(own.iter().map(|((_, token), to)| (range(token), (*to).to_owned())).collect());
        if shape(&buffer.root()) != before {
            return Err(Refused::new(format!("'{to}' is a keyword at this place")));
        }
    }
    Ok(())
}

/// Separates the ports and entries that share a name.
fn spell_out(workspace: &mut Workspace, project: &Project, tokens: &[((usize, Token), &str)]) {
    for (file, buffer) in workspace.buffers.iter_mut().enumerate() {
        let own = tokens.iter().filter(|((home, _), _)| *home == file);
        let binds = own.filter_map(|((_, token), _)| Some((refer::alone(token)?, token)));
        let splices =
            binds.filter_map(|(bind, name)| project.spelled_out(file, &bind, name.text()));
        let splices: Vec<_> = splices.collect();
        if !splices.is_empty() {
            buffer.splice(splices);
        }
    }
}

/// Checks that the new name is free in all files that see the item's file.
fn check_free_elsewhere(workspace: &Workspace, kind: Kind, to: &str) -> Result<(), Refused> {
    let project = workspace.project();
    let seeing = project.sees.iter().enumerate().filter(|(_, seen)| seen.contains(&workspace.home));
    let seeing: Vec<_> = seeing.map(|(file, _)| file).collect();
    if let Some((file, _)) = seeing.iter().find_map(|file| project.find(*file, kind, to)) {
        return Err(Refused::new(format!("'{to}' already exists in '{}'", workspace.paths[file])));
    }
    let toolboxes = &workspace.buffers[workspace.home].toolboxes;
    let used = seeing.iter().flat_map(|file| tree::children(&project.roots[*file], Kind::Use));
    let mut used = used.filter_map(|line| toolboxes.get(&tree::name_of(&line)?));
    match used.find(|toolbox| kind == Kind::Enum && toolbox.has_type(to)) {
        None => Ok(()),
        Some(toolbox) => {
            Err(Refused::new(format!("'{to}' is a type of the toolbox '{}'", toolbox.name)))
        }
    }
}

/// The kinds of all nodes, which a new name must not change.
fn shape(root: &Node) -> Vec<Kind> {
    root.descendants_with_tokens().map(|element| element.kind()).collect()
}
