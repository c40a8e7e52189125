//! Imports the names that the elements of another file need.

use crate::edit::project::Project;
use crate::edit::tree::{self, below, children, single};
use crate::edit::workspace::Workspace;
use crate::edit::{Refused, add};
use afp_dsl::files::relative;
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// Adds the `use` lines for the elements of `plan`, from the file `from`.
pub(super) fn bring(workspace: &mut Workspace, plan: &Node, from: usize) -> Result<(), Refused> {
    let project = workspace.project();
    for (toolbox, alias) in toolboxes(&project.roots[from]) {
        toolbox_line(workspace, plan, &toolbox, alias.as_deref())?;
    }
    for (kind, name, meant) in named(&project, plan, from) {
        match project.find(workspace.home, kind, &name) {
            Some((seen, _)) if seen == meant => {}
            Some(_) => return Err(Refused::new(format!("'{name}' means something else there"))),
            None => {
                let path = relative(&workspace.paths[workspace.home], &workspace.paths[meant]);
                let path =
                    path.ok_or_else(|| Refused::new(format!("no path leads to '{name}'")))?;
                add::line(workspace.buffer(), &format!("use \"{path}\""))?;
            }
        }
    }
    check(&workspace.project(), workspace.home, plan, &project, from)
}

/// Checks that every name has the same meaning in both files.
fn check(
    now: &Project,
    home: usize,
    plan: &Node,
    before: &Project,
    from: usize,
) -> Result<(), Refused> {
    for (kind, name, meant) in named(before, plan, from) {
        let place = |found: Option<(usize, Node)>| found.map(|(file, _)| file);
        let holders = now.sees[home].iter().filter(|seen| {
            children(&now.roots[**seen], kind).any(|node| tree::is_named(&node, &name))
        });
        if holders.count() > 1 || Some(meant) != place(now.find(home, kind, &name)) {
            return Err(Refused::new(format!("'{name}' means something else there")));
        }
    }
    Ok(())
}

fn toolboxes(root: &Node) -> Vec<(String, Option<String>)> {
    let name = |line: &Node| tree::tokens(line, Kind::Name).next().map(|t| t.text().to_owned());
    let alias = |line: &Node| children(line, Kind::Alias).next().as_ref().and_then(name);
    children(root, Kind::Use).filter_map(|line| Some((name(&line)?, alias(&line)))).collect()
}

fn toolbox_line(
    workspace: &mut Workspace,
    plan: &Node,
    toolbox: &str,
    alias: Option<&str>,
) -> Result<(), Refused> {
    let qualifier = alias.unwrap_or(toolbox);
    let qualified = || {
        let references = below(plan, Kind::Ref);
        let mut firsts = references.filter_map(|reference| {
            let mut names = tree::tokens(&reference, Kind::Name);
            names.next().filter(|_| single(&reference).is_none())
        });
        firsts.any(|first| first.text() == qualifier)
    };
    for (known, short) in toolboxes(&workspace.buffer().root()) {
        let other = short.unwrap_or_else(|| known.clone());
        match (known == toolbox, other == qualifier) {
            (true, true) => return Ok(()),
            (false, true) => {
                return Err(Refused::new(format!("'{qualifier}' is another toolbox there")));
            }
            (true, false) if qualified() => {
                return Err(Refused::new(format!("'{qualifier}' is called '{other}' there")));
            }
            (true, false) => return Ok(()),
            (false, false) => {}
        }
    }
    add::line_of_use(workspace.buffer(), toolbox, alias)
}

/// The plans and enums that a plan of the file `from` names, each with its file.
fn named(project: &Project, plan: &Node, from: usize) -> Vec<(Kind, String, usize)> {
    let names = below(plan, Kind::Ref)
        .flat_map(|reference| tree::tokens(&reference, Kind::Name).collect::<Vec<_>>());
    let meant = names.filter_map(|token| {
        let (file, node) = project.item(from, &token)?;
        let outer = matches!(node.kind(), Kind::Plan | Kind::Enum | Kind::Table);
        outer.then(|| (node.kind(), token.text().to_owned(), file))
    });
    meant.collect()
}
