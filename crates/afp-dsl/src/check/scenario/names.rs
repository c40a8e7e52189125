//! Records the names in a scenario of a valid or invalid plan, line by line.

use super::compare::Named;
use super::resolve::{Cause, Part, Resolver, Walk};
use super::robot::{Found, Robot};
use crate::check::Context;
use crate::check::formula::Scope;
use crate::check::names::Indices;
use crate::index::{Recorder, Word};
use crate::scenario::Field;
use crate::toolbox::{Control, Fault, Signal};
use afp_syntax::ast::{
    self, Bind, ClaimKind, ClaimTarget, Formula, FormulaKind, Line, LineKind, Name, Path,
};

/// Records the names in lines; `plan` is the scenario's, if known.
pub(super) fn record(
    context: Context<'_>,
    resolver: &Resolver<'_>,
    robot: &Robot<'_>,
    plan: Option<usize>,
    lines: &[Line],
) {
    let record = context.program.record;
    let names = NameRecorder { context, resolver, robot, record, plan };
    lines.iter().for_each(|line| names.line(line));
}

struct NameRecorder<'a> {
    context: Context<'a>,
    resolver: &'a Resolver<'a>,
    robot: &'a Robot<'a>,
    record: &'a Recorder,
    plan: Option<usize>,
}

impl NameRecorder<'_> {
    fn line(&self, line: &Line) {
        match line.kind() {
            LineKind::Set(path, value) => {
                path.iter().for_each(|path| self.entry(path));
                value.iter().for_each(|value| self.formula(value));
            }
            LineKind::Robot(formulas) => formulas.iter().for_each(|value| self.formula(value)),
            LineKind::Stimulus(_, Some(action)) => self.action(&action),
            LineKind::Expect { claim: Some(claim), .. } => self.claim(&claim),
            LineKind::Moment(claim, lines) => {
                claim.iter().for_each(|claim| self.claim(claim));
                lines.iter().for_each(|line| self.line(line));
            }
            _ => {}
        }
    }

    fn action(&self, action: &ast::Action) {
        let Some(path) = action.path() else { return };
        let verb = action.verb().map(|verb| verb.text).unwrap_or_default();
        let binds = action.binds();
        for bind in &binds {
            let port = bind.port();
            self.record.unknown(port.span);
            match bind {
                Bind::In { formula: Some(formula), .. } => self.formula(formula),
                Bind::Out { entry, formula, .. } => {
                    entry.iter().for_each(|entry| self.record.unknown(entry.span));
                    formula.iter().for_each(|formula| self.formula(formula));
                }
                Bind::In { formula: None, .. } => {}
            }
        }
        match verb.as_str() {
            "set" => {
                self.entry(&path);
                action.value().iter().for_each(|value| self.formula(value));
            }
            "press" | "release" => {
                self.unknown(self.robot.record::<Control>(&path.names(), self.record));
            }
            "fail" => {
                self.unknown(self.robot.record::<Fault>(&path.names(), self.record));
                self.amounts(&path, &binds);
            }
            "idle" => match path.names().as_slice() {
                [name] if name.text == "all" && !self.is_component(name) => {
                    self.record.word(name.span, Word::All);
                }
                _ => self.component(&path),
            },
            "fire" | "finish" => {
                self.component(&path);
                self.outputs(&path, &binds);
            }
            _ => self.unknown(&path.names()),
        }
    }

    fn claim(&self, claim: &ast::Claim) {
        match claim.kind() {
            ClaimKind::Transition { from, to, by } => {
                self.component(&from);
                to.element().iter().for_each(|path| self.component(path));
                by.iter().for_each(|path| self.cause(&from, &to, path));
            }
            ClaimKind::Active(path) | ClaimKind::Suspended(path) | ClaimKind::Interrupt(path) => {
                self.component(&path)
            }
            ClaimKind::Compare(path, _, value) => {
                self.compared(&path.names());
                value.iter().for_each(|value| self.operand(value));
            }
            ClaimKind::End(Some(path)) => match (path.names().as_slice(), ending(&path)) {
                ([name], Some(word)) if !self.is_component(name) => {
                    self.record.word(name.span, word);
                }
                _ => self.component(&path),
            },
            ClaimKind::Commit { of, by } => {
                of.iter().for_each(|path| self.entry(path));
                by.iter().for_each(|path| self.component(path));
            }
            ClaimKind::Fact(path) => match path.names().as_slice() {
                [name, ..] if self.is_component(name) => self.component(&path),
                names if self.is_of_robot(names) => self.signal(names),
                _ => self.component(&path),
            },
            ClaimKind::Hole => claim.paths().iter().for_each(|path| self.component(path)),
            ClaimKind::Running | ClaimKind::End(None) => {}
        }
    }

    fn is_component(&self, name: &Name) -> bool {
        let found = |plan| self.resolver.component(plan, std::slice::from_ref(name)).end.is_ok();
        self.plan.is_some_and(found)
    }

    /// A component with an optional state or event.
    fn component(&self, path: &Path) {
        let names = path.names();
        match self.plan {
            Some(plan) => self.walked(&self.resolver.component(plan, &names), &names),
            None => self.unknown(&names),
        }
    }

    fn cause(&self, from: &Path, to: &ClaimTarget, path: &Path) {
        let (names, from) = (path.names(), from.names());
        let Some(main) = self.plan else { return self.unknown(&names) };
        let left = self.resolver.component(main, &from);
        let Ok(part) = left.end else { return self.component(path) };
        match self.resolver.cause(main, (left.plan, part), to, &names) {
            Some(Cause::Own(_)) => self.outcomes(left.plan, part, &names),
            Some(Cause::Near(local)) => {
                let member = self.resolver.member(left.plan, local);
                if let (Some(name), [first, ..]) = (member.and_then(|m| m.name.as_ref()), &*names) {
                    self.record.definition(first.span, name.span);
                }
                self.outcomes(left.plan, local, names.get(1..).unwrap_or_default());
            }
            Some(Cause::Inside(walk) | Cause::Outside(walk)) => self.walked(&walk, &names),
            None => {}
        }
    }

    fn walked(&self, walk: &Walk<Part>, names: &[Name]) {
        let rest = self.trail(walk, names);
        match walk.end {
            Ok(part) => self.outcomes(walk.plan, part, rest),
            Err(_) => self.unknown(rest),
        }
    }

    /// Records the resolved names, and returns the rest.
    fn trail<'n, T>(&self, walk: &Walk<T>, names: &'n [Name]) -> &'n [Name] {
        for (name, definition) in names.iter().zip(&walk.trail) {
            self.record.definition(name.span, *definition);
        }
        names.get(walk.trail.len()..).unwrap_or_default()
    }

    fn outcomes(&self, plan: usize, part: Part, names: &[Name]) {
        if let [name, rest @ ..] = names {
            self.resolver.record_outcome(plan, part, name, self.record);
            self.unknown(rest);
        }
    }

    fn entry(&self, path: &Path) {
        self.entry_named(&path.names());
    }

    fn entry_named(&self, names: &[Name]) {
        let rest = match self.plan {
            Some(plan) => self.trail(&self.resolver.entry(plan, names), names),
            None => names,
        };
        self.unknown(rest);
    }

    /// The outputs of an injected state or event.
    fn outputs(&self, path: &Path, binds: &[Bind]) {
        let Some(plan) = self.plan else { return };
        let walk = self.resolver.component(plan, &path.names());
        let end = walk.end.ok();
        let signature = end.and_then(|part| self.resolver.signature(walk.plan, part));
        let Some(signature) = signature else { return };
        for bind in binds {
            let port = bind.port();
            let declared = signature.outputs.iter().find(|output| *output.name == *port.text);
            if let Some(declared) = declared {
                self.record.definition(port.span, declared.span);
            }
        }
    }

    /// The amount of a fault.
    fn amounts(&self, path: &Path, binds: &[Bind]) {
        let Found::Row(_, fault, _) = self.robot.find::<Fault>(&path.names()) else { return };
        for bind in binds {
            let port = bind.port();
            let amount = fault.amount.as_ref().filter(|amount| amount.name == port.text);
            match amount.map(|amount| amount.span) {
                Some(Some(span)) => self.record.definition(port.span, span),
                Some(None) => self.record.word(port.span, Word::Amount),
                None => {}
            }
        }
    }

    fn compared(&self, names: &[Name]) {
        match !self.is_entry(names) && self.is_of_robot(names) {
            true => self.signal(names),
            false => self.entry_named(names),
        }
    }

    /// The other side of a comparison: an entry, a signal, or a value.
    fn operand(&self, formula: &Formula) {
        let named = match formula.kind() {
            FormulaKind::Ref(reference) => Named::of_ref(&reference).names,
            _ => Vec::new(),
        };
        let is_signal = matches!(self.robot.find::<Signal>(&named), Found::Row(..));
        match self.is_entry(&named) || is_signal {
            true => self.compared(&named),
            false => self.formula(formula),
        }
    }

    fn is_of_robot(&self, names: &[Name]) -> bool {
        !matches!(self.robot.find::<Signal>(names), Found::Nothing)
    }

    fn signal(&self, names: &[Name]) {
        let found = self.robot.find::<Signal>(names);
        let rest = self.robot.record::<Signal>(names, self.record);
        match (found, rest) {
            (Found::Row(_, signal, _), [name, more @ ..])
                if Field::of(signal.ty).iter().any(|field| field.word() == name.text) =>
            {
                self.record.word(name.span, Word::Field);
                self.unknown(more);
            }
            _ => self.unknown(rest),
        }
    }

    fn is_entry(&self, names: &[Name]) -> bool {
        let found = |plan| self.resolver.entry(plan, names).end.is_ok();
        self.plan.is_some_and(found)
    }

    fn unknown(&self, names: &[Name]) {
        names.iter().for_each(|name| self.record.unknown(name.span));
    }

    /// A value, which may use constants of the plan.
    fn formula(&self, formula: &Formula) {
        let none = Indices::default();
        let head = self.plan.map(|plan| &self.context.program.plans[plan]);
        let scope = Scope {
            types: &self.context.file.types,
            tables: &[],
            entries: head.map_or(&[], |head| &head.entries),
            indices: head.map_or(&none, |head| &head.indices),
            readable: &|_| true,
            unreadable: "",
            text: self.context.file.text,
            record: self.record,
        };
        scope.names_only(formula);
    }
}

fn ending(path: &Path) -> Option<Word> {
    match path.text().as_str() {
        "OK" => Some(Word::Ok),
        "Interrupted" => Some(Word::Interrupted),
        "Error" => Some(Word::Error),
        _ => None,
    }
}
