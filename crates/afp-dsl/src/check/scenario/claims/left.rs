//! Claims that name an outcome instead of the element that it leaves.

use super::written;
use crate::check::scenario::Checker;
use crate::check::scenario::paths::Part;
use afp_syntax::ast::{ClaimTarget, Path};
use afp_syntax::diagnostics::{Code, Diagnostic};
use afp_syntax::message;

impl Checker<'_> {
    /// Reports a state or event instead of its element, as in timelines: `go.Done -> home`.
    pub(super) fn left_by(
        &self,
        path: &Path,
        to: &ClaimTarget,
        by: Option<&Path>,
    ) -> Option<Diagnostic> {
        let names = path.names();
        let (found, rest) = self.paths.find(self.paths.main(), &names).ok()?;
        let [outcome] = rest else { return None };
        self.paths.outcome(found, &outcome.text).filter(|_| by.is_none())?;
        let (text, to) = (path.text(), written(to));
        let owner = match found.part {
            Part::Element(_) => names.len() - 1,
            Part::Supervisor(_) => names.len() - 2,
        };
        let owner: Vec<_> = names.iter().take(owner).map(|name| &*name.text).collect();
        let element = self.paths.find(self.paths.main(), &names[..owner.len()]);
        let help = match element.is_ok_and(|(at, _)| matches!(at.part, Part::Element(_))) {
            true => message!("write '{} -> {} by {}'", owner.join("."), to, text),
            false => message!("write the element that is left: 'ELEMENT -> {} by {}'", to, text),
        };
        let message = message!("'{}' is not an element", text);
        Some(Diagnostic::new(Code::E0602, path.span(), message).help(help))
    }
}
