//! Paths of actions: a component and its outcome.

use super::COMPUTES;
use crate::check::names::{offer, unknown};
use crate::check::scenario::Checker;
use crate::check::scenario::paths::{Found, Instance, Part};
use crate::graph::Component;
use afp_syntax::ast::{Name, Path};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;

/// Maximum number of components searched for a help.
const MOST: usize = 2000;

/// The verb of an injection.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::check::scenario) enum Verb {
    /// An event of a supervisor, or the error of an actor.
    Fire,
    Finish,
}

/// A search for likely paths.
struct Search<'a> {
    verb: Option<Verb>,
    /// The prefix of the paths.
    below: &'a str,
    /// Remaining components: nested plans may have any number.
    left: usize,
    found: Vec<String>,
}

impl Checker<'_> {
    pub(super) fn outcome_of(
        &self,
        path: &Path,
        verb: Verb,
        diags: &mut Diagnostics,
    ) -> Option<(Found, Name)> {
        let names = path.names();
        let error = match self.paths.find(self.paths.main(), &names) {
            Ok((found, [name])) => return Some((found, name.clone())),
            Ok((found, [])) => self.outcome_missing(path, found, verb),
            Ok((found, [name, ..])) => self.too_long(path, found, name, verb),
            Err(error) => self.owner_meant(&names, Some(verb), *error),
        };
        diags.push(error);
        None
    }

    /// Reports a path that ends with a component.
    fn outcome_missing(&self, path: &Path, found: Found, verb: Verb) -> Diagnostic {
        let below = format!("{}.", path.text());
        let possible = self.possible(Some(verb), &below);
        let what = if verb == Verb::Fire { "an event" } else { "a state" };
        let message = message!("{} is missing after '{}'", Words(what), path.text());
        let error = Diagnostic::new(Code::E0210, path.span(), message);
        if possible.is_empty() {
            let events = self.possible(Some(Verb::Fire), &below);
            return match (self.paths.component(found), events.first()) {
                (Some(Component::Computation(_)), _) => error.help(COMPUTES),
                (_, Some(event)) => error.help(message!("write 'fire {}'", event)),
                (_, None) => error.help("name another component"),
            };
        }
        let known = possible.iter().map(String::as_str);
        offer(error, "", known, "")
    }

    /// Reports an event after an actor's name without its supervisor, or an unknown name.
    pub(super) fn event_meant(&self, path: &Path, found: Found, name: &Name) -> Diagnostic {
        let home = path.text();
        let home = home.strip_suffix(&*name.text).unwrap_or_default();
        let (end, mut possible) =
            (format!(".{}", name.text), self.possible(Some(Verb::Fire), home));
        let is_event = possible.iter().any(|path| path.ends_with(&end));
        if is_event {
            possible.retain(|path| path.ends_with(&end));
        }
        let message = message!("'{}' has no event '{}'", self.paths.name(found), name.text);
        let known = possible.iter().map(String::as_str);
        let said = unknown(Code::E0602, path.span(), message, "", known, "name another component");
        match possible.as_slice() {
            [path] if is_event => said.replace(path.as_str()),
            _ => said,
        }
    }

    /// Reports superfluous names after an outcome.
    fn too_long(&self, path: &Path, found: Found, name: &Name, verb: Verb) -> Diagnostic {
        let names = path.names();
        let at = names.iter().position(|each| each.span == name.span).unwrap_or_default();
        let text = |names: &[Name]| {
            names.iter().map(|name| name.text.as_str()).collect::<Vec<_>>().join(".")
        };
        if self.paths.outcome(found, &name.text).is_some() {
            let better = text(&names[..=at]);
            let place = names.get(at + 1).map_or(name.span, |more| more.span);
            return Diagnostic::new(Code::E0210, place, "a state or event has no parts")
                .write_at(path.span(), better);
        }
        let Part::Element(_) = found.part else { return self.no_outcome(found, name) };
        let home = text(&names[..at]);
        let message = message!("'{}' has no supervisor '{}'", home, name.text);
        let possible = self.possible(Some(verb), &format!("{home}."));
        let known = possible.iter().map(String::as_str);
        unknown(Code::E0602, path.span(), message, &path.text(), known, "name another component")
    }

    /// Reports a bare outcome with the paths that end in it.
    pub(in crate::check::scenario) fn owner_meant(
        &self,
        names: &[Name],
        verb: Option<Verb>,
        error: Diagnostic,
    ) -> Diagnostic {
        let [name] = names else { return error };
        let end = format!(".{}", name.text);
        let (mut possible, is_whole) = self.search(verb, "");
        possible.retain(|path| path.ends_with(&end));
        if possible.is_empty() {
            return error;
        }
        let message = message!("the owner of '{}' is missing", name.text);
        let known = possible.iter().map(String::as_str);
        let said = unknown(error.code, error.span, message, "", known, "");
        match possible.as_slice() {
            [path] if is_whole => said.replace(path.as_str()),
            _ => said,
        }
    }

    /// The paths with the prefix `below` whose component has an outcome for a verb, or for any.
    fn possible(&self, verb: Option<Verb>, below: &str) -> Vec<String> {
        self.search(verb, below).0
    }

    /// Searches the first [`MOST`] components; also returns whether these are all.
    fn search(&self, verb: Option<Verb>, below: &str) -> (Vec<String>, bool) {
        let mut search = Search { verb, below, left: MOST, found: Vec::new() };
        self.gather(self.paths.main(), "", &mut search);
        (search.found, search.left > 0)
    }

    fn gather(&self, instance: Instance, home: &str, search: &mut Search<'_>) {
        for (name, found) in self.paths.components_of(instance) {
            if search.left == 0 {
                return;
            }
            search.left -= 1;
            let path = format!("{home}{name}.");
            // Only prefixes and extensions of the path.
            if !(path.starts_with(search.below) || search.below.starts_with(&path)) {
                continue;
            }
            let outcomes = self.brought(found, search.verb).into_iter();
            let outcomes = outcomes.map(|outcome| format!("{path}{outcome}"));
            search.found.extend(outcomes.filter(|path| path.starts_with(search.below)));
            if let Some(inner) = self.paths.inside(found) {
                self.gather(inner, &path, search);
            }
        }
    }

    /// The possible outcomes of a component for a verb, or for any.
    fn brought(&self, found: Found, verb: Option<Verb>) -> Vec<&str> {
        let outcomes = || self.paths.outcomes(found);
        match (self.paths.component(found), verb) {
            (None, Some(Verb::Fire) | None) => outcomes(),
            (Some(Component::Actor(_)), Some(Verb::Fire)) => vec![self.paths.special(found)],
            (Some(Component::Actor(_)), Some(Verb::Finish) | None) => outcomes(),
            (Some(Component::Computation(_) | Component::SubPlan(_)), None) => outcomes(),
            _ => Vec::new(),
        }
    }
}
