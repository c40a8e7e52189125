//! Claims about the end of the plan, and foreign words for it.

use super::Checker;
use crate::check::scenario::paths::{Found, Part};
use crate::check::synonyms::{self, Leads};
use crate::graph::Target;
use crate::scenario::{Cause, Claim, EndCause, Outcome};
use afp_syntax::ast::{ENDS, Name, Path};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Subject, list};
use afp_syntax::message;

pub(super) fn meant(word: &str) -> Option<&'static str> {
    let same = |end: &&str| end.eq_ignore_ascii_case(word);
    let ours = || match synonyms::target(word, Leads::Edge).unwrap_or(word) {
        "terminate" => Some("OK"),
        "fail" => Some("Error"),
        _ => None,
    };
    ENDS.into_iter().find(same).or_else(ours)
}

impl Checker<'_> {
    /// The target of a transition: an element; a keyword is reported.
    pub(super) fn target(&self, path: &Path, diags: &mut Diagnostics) -> Option<Found> {
        let text = path.text();
        let meant = synonyms::target(&text, Leads::Event).filter(|word| *word != "ignore");
        let names = path.names();
        let (Some(meant), Err(error)) = (meant, self.paths.find(self.paths.main(), &names)) else {
            return self.element(path, diags);
        };
        // A similar name is likely meant, as in an edge.
        if error.fix.is_some() {
            diags.push(*error);
            return None;
        }
        diags.push(error.bare().write(meant));
        None
    }

    /// `end == OK`: the correct claim about the plan's end.
    pub(in crate::check::scenario) fn end_compared(
        &self,
        left: &str,
        sign: &str,
        value: &[Name],
    ) -> Option<String> {
        let ([value], "end", "==" | "!=") = (value, left, sign) else { return None };
        meant(&value.text).map(|end| format!("end by {end}"))
    }

    pub(super) fn end(&self, by: Option<&Path>, diags: &mut Diagnostics) -> Option<Claim> {
        let Some(path) = by else { return Some(Claim::End(None)) };
        let names = path.names();
        let found = self.paths.find(self.paths.main(), &names);
        let ending = match path.text().as_str() {
            "OK" => Some(EndCause::Ok),
            "Interrupted" => Some(EndCause::Interrupted),
            "Error" => Some(EndCause::Error),
            _ => None,
        };
        let (found, rest) = match (found, ending) {
            (Err(_), Some(ending)) => return Some(Claim::End(Some(ending))),
            (Err(error), None) => {
                diags.push(match meant(&path.text()).filter(|_| error.fix.is_none()) {
                    Some(better) => error.bare().write(better),
                    None => *error,
                });
                return None;
            }
            (Ok(found), _) => found,
        };
        let outcome = self.outcome(found, rest, diags)?;
        self.ends(found, outcome, path, diags)?;
        let cause = Cause { component: self.paths.number(found), outcome };
        Some(Claim::End(Some(EndCause::Cause(cause))))
    }

    /// Reports a cause that cannot end the plan.
    fn ends(
        &self,
        found: Found,
        outcome: Option<Outcome>,
        path: &Path,
        diags: &mut Diagnostics,
    ) -> Option<()> {
        let declared = u16::try_from(self.paths.outcomes(found).len()).unwrap_or(0);
        let all = (0..declared).map(Outcome::Declared).chain([Outcome::Special]);
        let element = matches!(found.part, Part::Element(_));
        let ends = |each: Outcome| {
            let targets = self.paths.targets(found, each);
            let unconnected = targets.is_empty() && each == Outcome::Special && element;
            unconnected || targets.into_iter().any(ends_plan)
        };
        let main = found.instance == self.paths.main();
        if main && all.filter(|each| outcome.is_none_or(|wanted| wanted == *each)).any(ends) {
            return Some(());
        }
        let plan = &self.paths.graph.main().name;
        let message = message!("'{}' does not end '{}'", path.text(), plan);
        let error = Diagnostic::new(Code::E0603, path.span(), message).help(self.endings());
        let error = error.about(Subject::Path(path.text()));
        diags.push(match outcome.filter(|_| main) {
            Some(outcome) => error.note(self.paths.edge(found, outcome), "it leads elsewhere"),
            None => error,
        });
        None
    }

    /// The causes that end the plan, for a help.
    fn endings(&self) -> Message {
        let paths = &self.paths;
        let ending = paths.components().flat_map(|(name, found)| {
            let outcomes = paths.outcomes(found).into_iter().chain([paths.special(found)]);
            outcomes.filter_map(move |outcome| {
                let targets = paths.targets(found, paths.outcome(found, outcome)?);
                targets.into_iter().any(ends_plan).then(|| format!("{name}.{outcome}"))
            })
        });
        let ending: Vec<_> = ending.collect();
        match ending.is_empty() {
            true => "nothing leads to 'terminate'; only an error ends it: 'end by Error'".into(),
            false => {
                message!("write {}, which ends it", list(ending.iter().map(String::as_str), "or"))
            }
        }
    }
}

fn ends_plan(target: Target) -> bool {
    matches!(target, Target::Terminate | Target::Fail(_))
}
