//! Scenarios of a selection: paths go through the sub-plan, and edges into or out of the selection
//! become edges of the sub-plan.

use std::ops::Range;

use crate::edit::buffer::Splice;
use crate::edit::project::Project;
use crate::edit::tree::{children, range, solid_range, tokens};
use crate::edit::{Item, refer};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

/// Adapts the scenarios of a file to the sub-plan `element`, which replaces items of the file
/// `home`.
pub(super) fn splices(
    project: &Project,
    (home, items): (usize, &[Item]),
    file: usize,
    element: &str,
) -> Vec<Splice> {
    let inside = refer::in_scenarios(project, home, items, file);
    let reader = Reader { project, file, element, inside: &inside };
    let mut splices = Vec::new();
    let mut read: Vec<Node> = Vec::new();
    for token in &inside {
        let Some(claim) = claim_of(token) else {
            splices.push(reader.through(token));
            continue;
        };
        if !read.contains(&claim) {
            splices.extend(reader.claim(&claim));
            read.push(claim);
        }
    }
    splices
}

/// The claim around a name.
fn claim_of(token: &Token) -> Option<Node> {
    token.parent()?.parent().filter(|node| node.kind() == Kind::Claim)
}

struct Reader<'a> {
    project: &'a Project,
    file: usize,
    element: &'a str,
    /// Names in scenarios that mean selected elements.
    inside: &'a [Token],
}

impl Reader<'_> {
    /// Prefixes an element with the sub-plan.
    fn through(&self, token: &Token) -> Splice {
        let start = range(token).start;
        (start..start, format!("{}.", self.element))
    }

    fn claim(&self, claim: &Node) -> Vec<Splice> {
        let place = |kind: Kind, text: &str| {
            let mut found = tokens(claim, kind).filter(|token| token.text() == text);
            found.next().map(|token| range(&token).start)
        };
        let (arrow, by) = (place(Kind::Arrow, "->"), place(Kind::Keyword, "by"));
        let paths: Vec<_> =
            children(claim, Kind::Path).filter_map(|path| self.path(path)).collect();
        let is_behind =
            |path: &Path, place: Option<usize>| place.is_some_and(|place| path.place.start > place);
        let by = paths.iter().find(|path| is_behind(path, by));
        if place(Kind::Keyword, "end").is_some() {
            let whole = |path: &Path| path.whole(format!("{}.OK", self.element));
            return by.and_then(whole).into_iter().collect();
        }
        let from = paths.first().filter(|_| arrow.is_some());
        let to = paths
            .get(1)
            .filter(|path| is_behind(path, arrow) && by.is_none_or(|by| by.place != path.place));
        let watcher = by.and_then(|by| self.watcher(by));
        let leaves = from.is_some_and(|from| from.inside.is_some());
        let enters = to.is_some_and(|to| to.inside.is_some());
        let of_plan = watcher == Some(Kind::Plan);
        let crosses = from.is_some() && (to.is_some() && leaves != enters || of_plan);
        if !crosses {
            return paths
                .iter()
                .filter_map(|path| path.inside.as_ref())
                .map(|it| self.through(it))
                .collect();
        }
        let ends = [from, to].into_iter().flatten();
        let mut splices: Vec<_> =
            ends.filter_map(|path| path.whole(self.element.to_owned())).collect();
        if let Some(by) = by.filter(|_| leaves && !of_plan) {
            let outcome = if watcher.is_some() { "Interrupted" } else { "OK" };
            splices.push((by.place.clone(), outcome.to_owned()));
        }
        splices
    }

    fn path(&self, node: Node) -> Option<Path> {
        let inside = tokens(&node, Kind::Name).find(|token| self.inside.contains(token));
        Some(Path { place: solid_range(&node)?, inside, node })
    }

    /// The owner of a path's supervisor, the plan or an element; `None` without a supervisor.
    fn watcher(&self, path: &Path) -> Option<Kind> {
        tokens(&path.node, Kind::Name).find_map(|token| {
            let (_, node) = self.project.item(self.file, &token)?;
            let owner = node.parent().filter(|_| node.kind() == Kind::Guard)?;
            Some(owner.kind())
        })
    }
}

struct Path {
    node: Node,
    place: Range<usize>,
    /// Its name of a selected element.
    inside: Option<Token>,
}

impl Path {
    /// Replaces the selected element and everything after it.
    fn whole(&self, text: String) -> Option<Splice> {
        Some((range(self.inside.as_ref()?).start..self.place.end, text))
    }
}
