//! Expectations of scenarios.

mod ends;
mod left;

use super::often::wanted;
use super::paths::{Found, Part};
use super::resolve;
use super::{Checker, Stretch};
use crate::check::names::{offer, unknown};
use crate::graph::{Component, Target};
use crate::scenario::{Cause, Claim, Expectation, Outcome};
use afp_syntax::ast::{self, Bound, ClaimKind, ClaimTarget, Line, Name, Path};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Subject, list, words};
use afp_syntax::message;

impl Checker<'_> {
    pub(super) fn expectation(
        &self,
        line: &Line,
        (never, node, bounds): (bool, &ast::Claim, &[Bound]),
        stretch: &Stretch,
        diags: &mut Diagnostics,
    ) -> Option<Expectation> {
        let window = stretch.window(bounds, diags);
        let claim = self.claim(node, diags)?;
        let window = window?;
        let wanted = wanted(never, &claim, bounds, diags)?;
        let (from, text, span) = (stretch.from, line.in_one_line(), line.span());
        Some(Expectation { claim, wanted, from, window, text, span })
    }

    pub(super) fn claim(&self, node: &ast::Claim, diags: &mut Diagnostics) -> Option<Claim> {
        match node.kind() {
            ClaimKind::Transition { from, to, by } => {
                self.transition(&from, &to, by.as_ref(), diags)
            }
            ClaimKind::Active(path) => self.active(&path, diags),
            ClaimKind::Suspended(path) => self.lasting(&path, diags).map(Claim::Suspended),
            ClaimKind::Compare(path, sign, value) => self.compare(&path, &sign, &value?, diags),
            ClaimKind::Running => Some(Claim::Running),
            ClaimKind::End(by) => self.end(by.as_ref(), diags),
            ClaimKind::Interrupt(path) => self.interrupt(&path, diags),
            ClaimKind::Commit { of, by } => self.commit(of.as_ref(), by.as_ref(), diags),
            ClaimKind::Fact(path) => self.fact(&path, diags),
            ClaimKind::Hole => None,
        }
    }

    fn element(&self, path: &Path, diags: &mut Diagnostics) -> Option<Found> {
        let names = path.names();
        let (found, rest) =
            self.paths.find(self.paths.main(), &names).map_err(|error| diags.push(*error)).ok()?;
        if rest.is_empty() && matches!(found.part, Part::Element(_)) {
            return Some(found);
        }
        let message = message!("'{}' is not an element", path.text());
        let events = self.paths.outcomes(found);
        let named = rest.first().and_then(|name| events.iter().find(|event| **event == name.text));
        let help = match (rest, named.or(events.first())) {
            (_, Some(event)) if !matches!(found.part, Part::Element(_)) => {
                let own = names.iter().take(names.len() - rest.len());
                let supervisor: Vec<_> = own.map(|name| name.text.as_str()).collect();
                message!("expect only its event: 'expect {}.{}'", supervisor.join("."), event)
            }
            ([more, ..], _) => message!("remove '.{}'", more.text),
            ([], _) => "write the name of an element".into(),
        };
        diags.push(Diagnostic::new(Code::E0602, path.span(), message).help(help));
        None
    }

    fn active(&self, path: &Path, diags: &mut Diagnostics) -> Option<Claim> {
        self.lasting(path, diags).map(Claim::Active)
    }

    fn interrupt(&self, path: &Path, diags: &mut Diagnostics) -> Option<Claim> {
        self.lasting(path, diags).map(Claim::Interrupt)
    }

    /// The number of an element that takes time.
    fn lasting(&self, path: &Path, diags: &mut Diagnostics) -> Option<u32> {
        let found = self.element(path, diags)?;
        if let Some(Component::Computation(_)) = self.paths.component(found) {
            let message = message!("'{}' is a computation and takes no time", path.text());
            let state = self.paths.outcomes(found).first().copied().unwrap_or("Error");
            diags.push(Diagnostic::new(Code::E0604, path.span(), message).help(message!(
                "expect one of its states, such as '{}.{}'",
                path.text(),
                state
            )));
            return None;
        }
        Some(self.paths.number(found))
    }

    fn transition(
        &self,
        from_path: &Path,
        to: &ClaimTarget,
        by_path: Option<&Path>,
        diags: &mut Diagnostics,
    ) -> Option<Claim> {
        let from = match self.left_by(from_path, to, by_path) {
            Some(error) => {
                diags.push(error);
                None
            }
            None => self.element(from_path, diags),
        };
        let found = match to.element() {
            Some(path) => Some(self.target(path, diags)?),
            None => None,
        };
        let from = from?;
        if let (Some(to), Some(path)) = (found, to.element())
            && to.instance != from.instance
        {
            let message = message!(
                "'{}' and '{}' belong to different plans, so no edge joins them",
                from_path.text(),
                path.text()
            );
            diags.push(
                Diagnostic::new(Code::E0603, path.span(), message)
                    .about(Subject::Path(from_path.text()))
                    .help("name two elements of one plan, or expect the other one 'active'"),
            );
            return None;
        }
        let by = match by_path {
            Some(path) => Some((self.cause(from, to, path, diags)?, path)),
            None => None,
        };
        self.joined(from, found, by.as_ref(), (from_path, to), diags)?;
        Some(Claim::Transition {
            from: self.paths.number(from),
            to: to.clone().map(|_| found.map_or(0, |found| self.paths.number(found)), |()| ()),
            by: by.map(|((found, outcome), _)| Cause {
                component: self.paths.number(found),
                outcome,
            }),
        })
    }

    /// Reports that no edge leads from one element to the other.
    fn joined(
        &self,
        from: Found,
        to: Option<Found>,
        by: Option<&((Found, Option<Outcome>), &Path)>,
        (from_path, target): (&Path, &ClaimTarget),
        diags: &mut Diagnostics,
    ) -> Option<()> {
        let causes = self.paths.causes(from);
        let leads = |(found, outcome): &&(Found, Outcome)| {
            self.paths.target_at(*found, *outcome, from).is_some_and(|at| {
                let leads_to = |id| to.is_some_and(|to| to.part == Part::Element(id));
                at.keyword() == target.keyword() && at.element().copied().is_none_or(leads_to)
            })
        };
        let fits = |(found, outcome): &&(Found, Outcome)| match by {
            Some(((wanted, want), _)) => {
                found == wanted && want.is_none_or(|want| want == *outcome)
            }
            None => true,
        };
        if causes.iter().any(|cause| leads(&cause) && fits(&cause)) {
            return Some(());
        }
        let name = written(target);
        let others: Vec<_> = causes
            .iter()
            .filter(leads)
            .map(|(found, outcome)| self.outcome_name(from, *found, *outcome))
            .collect();
        let (span, message) = match by {
            Some((_, path)) => (
                path.span(),
                message!(
                    "'{}' does not lead from '{}' to '{}'",
                    path.text(),
                    from_path.text(),
                    name
                ),
            ),
            None => (
                target.element().map_or(from_path.span(), Path::span),
                message!("no edge leads from '{}' to '{}'", from_path.text(), name),
            ),
        };
        let help = match others.as_slice() {
            [] => self.goals(from, from_path, &causes),
            others => {
                message!(
                    "write {}, which leads to it",
                    list(others.iter().map(String::as_str), "or")
                )
            }
        };
        let subject = Subject::Path(by.map_or(from_path, |(_, path)| path).text());
        diags.push(Diagnostic::new(Code::E0603, span, message).about(subject).help(help));
        None
    }

    /// The targets of an element's edges, for a help.
    fn goals(&self, from: Found, path: &Path, causes: &[(Found, Outcome)]) -> Message {
        let home = path.text();
        let home = home.rsplit_once('.').map_or(String::new(), |(home, _)| format!("{home}."));
        let place = |id: &_| {
            let found = Found { instance: from.instance, part: Part::Element(*id) };
            format!("{home}{}", self.paths.name(found))
        };
        let name = |target| match target {
            Target::Ignore => None,
            target => Some(target.text(place).to_string()),
        };
        let goals =
            causes.iter().filter_map(|(each, outcome)| self.paths.target_at(*each, *outcome, from));
        let goals: std::collections::BTreeSet<_> = goals.filter_map(name).collect();
        match goals.is_empty() {
            true => message!("no edge leads out of '{}'; expect another element", path.text()),
            false => message!("it leads to {}", list(goals.iter().map(String::as_str), "or")),
        }
    }

    /// The spelling of an outcome after `by`.
    fn outcome_name(&self, from: Found, found: Found, outcome: Outcome) -> String {
        let name = match outcome {
            Outcome::Declared(index) => self.paths.outcomes(found)[usize::from(index)],
            Outcome::Special => self.paths.special(found),
        };
        match found == from {
            true => name.to_owned(),
            false => format!("{}.{name}", self.paths.name(found)),
        }
    }

    /// The meaning of a path after `by` for leaving `from`: a supervisor of it or of its plan, one
    /// of its states, or a path from the outermost plan.
    fn cause(
        &self,
        from: Found,
        to: &ClaimTarget,
        path: &Path,
        diags: &mut Diagnostics,
    ) -> Option<(Found, Option<Outcome>)> {
        let names = path.names();
        let first = names.first()?;
        let paths = &self.paths;
        let here = from.instance;
        let (found, rest) =
            match paths.names.cause(paths.main, (here.plan_index(), from.part), to, &names)? {
                resolve::Cause::Own(outcome) => return Some((from, Some(outcome))),
                resolve::Cause::Near(part) => (Found { instance: here, part }, &names[1..]),
                resolve::Cause::Inside(walk) => paths.arrived(here, walk, &names).ok()?,
                resolve::Cause::Outside(walk) => paths
                    .arrived(paths.main(), walk, &names)
                    .map_err(|_| diags.push(self.unknown_cause(from, first)))
                    .ok()?,
            };
        self.outcome(found, rest, diags).map(|outcome| (found, outcome))
    }

    fn unknown_cause(&self, from: Found, name: &Name) -> Diagnostic {
        let owner = self.paths.name(from);
        let message = message!("'{}' cannot end by '{}'", owner, name.text);
        let causes = self.paths.causes(from);
        let known = causes.iter().filter(|(_, outcome)| *outcome != Outcome::Special);
        let known = known.map(|(found, outcome)| match *found == from {
            true => self.outcome_name(from, *found, *outcome),
            false => self.paths.name(*found).to_owned(),
        });
        let mut known: Vec<_> = known.collect();
        known.dedup();
        let known = known.iter().map(String::as_str);
        let error = unknown(Code::E0602, name.span, message, &name.text, known, "remove 'by'");
        match self.paths.of_another(from, &name.text) {
            Some((place, other)) => {
                error.note(place, message!("this claim is possible only for '{}'", other))
            }
            None => error,
        }
    }

    /// The outcome after a component's name, if named.
    fn outcome(
        &self,
        found: Found,
        rest: &[Name],
        diags: &mut Diagnostics,
    ) -> Option<Option<Outcome>> {
        match rest {
            [] => Some(None),
            [name] => match self.paths.outcome(found, &name.text) {
                Some(outcome) => Some(Some(outcome)),
                None => {
                    diags.push(self.no_outcome(found, name));
                    None
                }
            },
            [first, _, ..] if self.paths.outcome(found, &first.text).is_none() => {
                let owner = self.paths.name(found);
                let message = message!("'{}' has no supervisor '{}'", owner, first.text);
                let known = self.paths.supervisors(found);
                let none = "name only one of its states";
                diags.push(match found.part {
                    Part::Element(_) => {
                        unknown(Code::E0602, first.span, message, &first.text, known, none)
                    }
                    Part::Supervisor(_) => self.no_outcome(found, first),
                });
                None
            }
            [_, more, ..] => {
                diags.push(
                    Diagnostic::new(Code::E0210, more.span, "a state or event has no parts")
                        .help("remove the part after it"),
                );
                None
            }
        }
    }

    /// Reports a name that is unknown in the plan and the robot.
    fn no_fact(&self, path: &Path, error: Diagnostic) -> Diagnostic {
        let (written, facts) = (path.text(), self.facts());
        let facts = || facts.iter().map(String::as_str);
        if error.fix.is_none()
            && let Some(better) = ends::meant(&written)
        {
            let better = format!("end by {better}");
            return error.bare().write(better);
        }
        let error = self.owner_meant(&path.names(), None, error);
        match error.fix.is_none() && words::nearest(&written, facts()).is_some() {
            true => offer(error.bare(), &written, facts(), ""),
            false => error,
        }
    }

    fn fact(&self, path: &Path, diags: &mut Diagnostics) -> Option<Claim> {
        let names = path.names();
        let (found, rest) = match self.paths.find(self.paths.main(), &names) {
            Ok(found) => found,
            Err(_) if self.is_of_robot(&names) => return self.fact_of_robot(path, diags),
            Err(error) => {
                diags.push(self.no_fact(path, *error));
                return None;
            }
        };
        if rest.is_empty() {
            let name = path.text();
            let message = message!("the claim about '{}' is missing", name);
            let outcome = self.paths.outcomes(found).first().map(|first| format!("{name}.{first}"));
            let help = match (found.part, outcome) {
                (Part::Element(_), _) => message!("write '{} active'", name),
                (_, Some(outcome)) => message!("write '{}'", outcome),
                (_, None) => "name one of its events".into(),
            };
            diags.push(Diagnostic::new(Code::E0604, path.span(), message).help(help));
            return None;
        }
        let outcome = self.outcome(found, rest, diags)?;
        if let Some(outcome) = outcome
            && let targets = self.paths.targets(found, outcome)
            && !targets.is_empty()
            && targets.iter().all(|target| *target == Target::Ignore)
        {
            let message = message!("'{}' is ignored, so it is never taken", path.text());
            diags.push(
                Diagnostic::new(Code::E0603, path.span(), message)
                    .about(Subject::Path(path.text()))
                    .note(self.paths.edge(found, outcome), "ignored here")
                    .help("expect an event that is connected"),
            );
            return None;
        }
        Some(Claim::Happens(Cause { component: self.paths.number(found), outcome }))
    }
}

fn written(target: &ClaimTarget) -> String {
    target.text(Path::text).to_string()
}
