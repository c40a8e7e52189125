//! Claims about writes: `commit of entry by component`.

use super::Checker;
use super::paths::Part;
use crate::graph::{Component, EntryKind};
use crate::scenario::Claim;
use afp_syntax::ast::Path;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Subject};
use afp_syntax::message;

impl Checker<'_> {
    pub(super) fn commit(
        &self,
        of: Option<&Path>,
        by: Option<&Path>,
        diags: &mut Diagnostics,
    ) -> Option<Claim> {
        let entry = match of {
            Some(path) => Some((self.writable(path, diags)?, path)),
            None => None,
        };
        let author = match by {
            Some(path) => Some(self.author(path, entry, diags)?),
            None => None,
        };
        Some(Claim::Commit { of: entry.map(|(entry, _)| entry), by: author })
    }

    /// The number of a writable entry.
    fn writable(&self, path: &Path, diags: &mut Diagnostics) -> Option<u32> {
        let (number, plan, id) =
            self.paths.entry(&path.names()).map_err(|error| diags.push(*error)).ok()?;
        let entry = &self.paths.graph.plan(plan).entries[id.index()];
        if entry.kind == EntryKind::Const {
            let message = message!("'{}' never changes", path.text());
            diags.push(
                Diagnostic::new(Code::E0603, path.span(), message)
                    .about(Subject::Path(path.text()))
                    .note(entry.span, "declared here")
                    .help("name an entry that is not a 'const'"),
            );
            return None;
        }
        Some(number)
    }

    /// A component that writes entries, or the given one.
    fn author(
        &self,
        path: &Path,
        entry: Option<(u32, &Path)>,
        diags: &mut Diagnostics,
    ) -> Option<u32> {
        let names = path.names();
        let (found, rest) =
            self.paths.find(self.paths.main(), &names).map_err(|error| diags.push(*error)).ok()?;
        if let Some(more) = rest.first() {
            let message = "components write entries, not their states or events";
            let help = message!("remove '.{}'", more.text);
            diags.push(Diagnostic::new(Code::E0604, more.span, message).help(help));
            return None;
        }
        // A sub-plan also initialises its own entries.
        let anything = matches!(self.paths.component(found), Some(Component::SubPlan(_)));
        let written = self.paths.written(found);
        let writes = match entry {
            Some((entry, _)) => written.contains(&entry),
            None => !written.is_empty(),
        };
        if writes || anything {
            return Some(self.paths.number(found));
        }
        let what = entry.map_or("any entry".into(), |(_, path)| message!("'{}'", path.text()));
        let message = message!("'{}' does not write {}", path.text(), what);
        let plan = self.paths.graph.plan(found.instance.plan());
        let span = match found.part {
            Part::Element(id) => plan.elements[id.index()].span,
            Part::Supervisor(id) => plan.supervisors[id.index()].span,
        };
        diags.push(
            Diagnostic::new(Code::E0603, path.span(), message)
                .about(Subject::Path(path.text()))
                .note(span, "declared here")
                .help("name a component with an output ('=>') that leads there"),
        );
        None
    }
}
