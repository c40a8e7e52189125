//! Actions of scenarios.

mod named;

pub(super) use named::Verb;

use super::Checker;
use super::paths::{Found, Part};
use crate::check::names::unknown;
use crate::check::timing;
use crate::graph::{Component, EntryKind, Target};
use crate::scenario::{Action, Injection, Outcome};
use crate::types::{Constant, Type};
use afp_syntax::ast::{self, Bind, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Subject, Words, list};
use afp_syntax::message;

pub const VERBS: &[&str] = &["press", "release", "fail", "fire", "finish", "idle", "set"];

/// How to control the result of a computation.
const COMPUTES: &str = "a computation takes no time; set the entries that it reads";

impl Checker<'_> {
    pub(super) fn action(&self, node: &ast::Action, diags: &mut Diagnostics) -> Option<Action> {
        let (verb, path) = (node.verb()?, node.path()?);
        let duration = match node.duration() {
            Some(time) => Some(timing::time(&time, &[], diags)?),
            None => None,
        };
        self.only(node, &verb, diags)?;
        match verb.text.as_str() {
            "set" => {
                let kinds = [EntryKind::In, EntryKind::Var];
                let (entry, value) = self.set(&path, &node.value()?, &kinds, diags)?;
                Some(Action::Set(entry, value))
            }
            "press" => Some(Action::Press(self.control(&path, diags)?, duration)),
            "release" => Some(Action::Release(self.control(&path, diags)?)),
            "fail" => Some(Action::Fail(self.failure(&path, &node.binds(), diags)?, duration)),
            "fire" => self.fire(&path, &node.binds(), diags),
            "finish" => self.finish(&path, &node.binds(), diags),
            "idle" => self.idle(&path, diags),
            _ => {
                let message = message!("there is no action '{}'", verb.text);
                // Only this verb has a value.
                let sets = node.value().is_some();
                let known = VERBS.iter().copied().filter(|verb| sets == (*verb == "set"));
                diags.push(unknown(Code::E0606, verb.span, message, &verb.text, known, ""));
                None
            }
        }
    }

    /// Reports superfluous parentheses and durations.
    fn only(&self, node: &ast::Action, verb: &Name, diags: &mut Diagnostics) -> Option<()> {
        let timed = ["press", "fail"].contains(&verb.text.as_str());
        if let (Some(time), false) = (node.duration(), timed)
            && VERBS.contains(&verb.text.as_str())
            && verb.text != "set"
        {
            let message = message!("'{}' takes no time", verb.text);
            diags.push(
                Diagnostic::new(Code::E0606, time.span(), message)
                    .help("remove 'for' and the time"),
            );
            return None;
        }
        if ["press", "release", "idle"].contains(&verb.text.as_str())
            && let Some(bind) = node.binds().first()
        {
            let port = bind.port();
            let message = message!("'{}' has no value '{}'", verb.text, port.text);
            diags
                .push(Diagnostic::new(Code::E0606, port.span, message).help("remove the brackets"));
            return None;
        }
        Some(())
    }

    fn fire(&self, path: &ast::Path, binds: &[Bind], diags: &mut Diagnostics) -> Option<Action> {
        let (found, name) = self.outcome_of(path, Verb::Fire, diags)?;
        let fails = name.text == self.paths.special(found);
        let help = match self.paths.component(found) {
            None => return self.injection(path, found, &name, binds, diags),
            Some(Component::Actor(_)) if fails => {
                return self.injection(path, found, &name, binds, diags);
            }
            Some(Component::SubPlan(_)) if fails => {
                "fire the 'Error' of the actor that is active inside".into()
            }
            Some(Component::Computation(_)) => COMPUTES.into(),
            Some(Component::SubPlan(_)) => "finish the actor that is active inside".into(),
            Some(Component::Actor(_)) if self.paths.outcome(found, &name.text).is_none() => {
                diags.push(self.event_meant(path, found, &name));
                return None;
            }
            Some(Component::Actor(_)) => message!("write 'finish {}' for a state", path.text()),
        };
        let what = match fails {
            true => message!("'{}' is for errors of actors, not of other elements", "fire"),
            false => message!("'{}' is for events of supervisors", "fire"),
        };
        diags.push(Diagnostic::new(Code::E0602, path.span(), what).help(help));
        None
    }

    fn finish(&self, path: &ast::Path, binds: &[Bind], diags: &mut Diagnostics) -> Option<Action> {
        let (found, name) = self.outcome_of(path, Verb::Finish, diags)?;
        let fails = name.text == self.paths.special(found);
        let help = match self.paths.component(found) {
            Some(Component::Actor(_)) if !fails => {
                return self.injection(path, found, &name, binds, diags);
            }
            Some(Component::Actor(_)) => message!("write 'fire {}' for an error", path.text()),
            None => message!("write 'fire {}' for an event", path.text()),
            Some(Component::Computation(_)) => COMPUTES.into(),
            Some(Component::SubPlan(_)) => "finish the actor that is active inside".into(),
        };
        diags.push(
            Diagnostic::new(
                Code::E0602,
                path.span(),
                message!("'{}' is for states of actors", "finish"),
            )
            .help(help),
        );
        None
    }

    /// Idle actors: one, those of a sub-plan, or all.
    fn idle(&self, path: &ast::Path, diags: &mut Diagnostics) -> Option<Action> {
        let names = path.names();
        let found = match self.paths.find(self.paths.main(), &names) {
            Ok((found, [])) => found,
            Ok((_, [more, ..])) => {
                let error =
                    Diagnostic::new(Code::E0602, more.span, message!("'{}' is for actors", "idle"));
                diags.push(error.help(message!("remove '.{}'", more.text)));
                return None;
            }
            Err(_) if path.text() == "all" => return Some(Action::Idle(None)),
            Err(error) => {
                diags.push(*error);
                return None;
            }
        };
        let help = match self.paths.component(found) {
            Some(Component::Actor(_) | Component::SubPlan(_)) => {
                return Some(Action::Idle(Some(self.paths.number(found))));
            }
            Some(Component::Computation(_)) => "a computation does not control the robot",
            None => "a supervisor does not control the robot; name the actor that it watches",
        };
        let message = message!("'{}' is for actors and sub-plans", "idle");
        let error = Diagnostic::new(Code::E0602, path.span(), message);
        diags.push(error.help(help));
        None
    }

    fn injection(
        &self,
        path: &ast::Path,
        found: Found,
        name: &Name,
        binds: &[Bind],
        diags: &mut Diagnostics,
    ) -> Option<Action> {
        let Some(outcome) = self.paths.outcome(found, &name.text) else {
            diags.push(self.no_outcome(found, name));
            return None;
        };
        let targets = self.paths.targets(found, outcome);
        let missed = outcome == Outcome::Special && matches!(found.part, Part::Supervisor(_));
        let ignored = !targets.is_empty() && targets.iter().all(|to| *to == Target::Ignore);
        if ignored || (missed && targets.is_empty()) {
            let (message, note) = match missed {
                true => ("is not connected, so it would have no effect", "this has no such edge"),
                false => ("is ignored, so it is never reported", "ignored here"),
            };
            let message = message!("'{}' {}", path.text(), Words(message));
            diags.push(
                Diagnostic::new(Code::E0603, path.span(), message)
                    .about(Subject::Path(path.text()))
                    .note(self.paths.edge(found, outcome), note)
                    .help("fire an event that is connected"),
            );
            return None;
        }
        let outputs = self.outputs(path, found, outcome, binds, diags)?;
        Some(Action::Inject(Injection { component: self.paths.number(found), outcome, outputs }))
    }

    /// Reports an unknown state or event of a component.
    pub(super) fn no_outcome(&self, found: Found, name: &Name) -> Diagnostic {
        let owner = self.paths.name(found);
        let what = if matches!(found.part, Part::Supervisor(_)) { "event" } else { "state" };
        let message = message!("'{}' has no {} '{}'", owner, Words(what), name.text);
        let known = self.paths.outcomes(found);
        unknown(Code::E0210, name.span, message, &name.text, known, "write another name")
    }

    /// Values of an outcome: one for each connected output.
    fn outputs(
        &self,
        path: &ast::Path,
        found: Found,
        outcome: Outcome,
        binds: &[Bind],
        diags: &mut Diagnostics,
    ) -> Option<Vec<(u16, Constant)>> {
        let wanted = match outcome {
            Outcome::Declared(outcome) => self.paths.outputs(found, outcome),
            // A fault or a missed deadline has no outputs.
            Outcome::Special => Vec::new(),
        };
        let mut values: Vec<Option<Constant>> = vec![None; wanted.len()];
        let mut valid = true;
        for bind in binds {
            let port = bind.port();
            let index = wanted.iter().position(|(_, known, _)| known.name == port.text);
            let Some(index) = index else {
                let message = message!("'{}' has no connected output '{}'", path.text(), port.text);
                let known = wanted.iter().map(|(_, port, _)| port.name.as_str());
                let none = "remove the value";
                diags.push(unknown(Code::E0608, port.span, message, &port.text, known, none));
                valid = false;
                continue;
            };
            let Bind::In { formula: Some(formula), .. } = bind else {
                diags.push(
                    Diagnostic::new(Code::E0608, port.span, "an output needs a value here")
                        .help(message!("write '{} = ...'", port.text)),
                );
                valid = false;
                continue;
            };
            values[index] = self.constant(formula, &wanted[index].2, diags).map(|(_, value)| value);
            valid &= values[index].is_some();
        }
        let missing = wanted.iter().zip(&values).filter(|(_, value)| value.is_none());
        let missing: Vec<_> = missing.map(|((_, port, ty), _)| (port, ty)).collect();
        if valid && !missing.is_empty() {
            let names = list(missing.iter().map(|(port, _)| port.name.as_str()), "and");
            let message = message!(
                "'{}' also has the output {}, which has no value here",
                path.text(),
                names
            );
            let object = missing.iter().any(|(_, ty)| matches!(ty, Type::Object(_)));
            let help = match object {
                true => "choose another outcome: only its component can make an object".into(),
                false => message!("write '({} = ...)' after it", missing[0].0.name),
            };
            diags.push(
                Diagnostic::new(Code::E0608, path.span(), message)
                    .note(missing[0].0.span, "declared here")
                    .help(help),
            );
            return None;
        }
        let values: Option<Vec<_>> =
            wanted.iter().zip(values).map(|((index, ..), value)| Some((*index, value?))).collect();
        values
    }
}
