//! Watches: formulas about a running plan.
//!
//! A watch is a formula of the language, typed as in the plan, or a comparison of two formulas:
//! `walldist - 5 cm`, `left % 2 == 0`. Debuggers stop on them and show them.

use std::fmt;
use std::sync::Arc;

use crate::check::convert::compared_as;
use crate::check::formula::Scope;
use crate::check::head::EntryDraft;
use crate::check::names::Indices;
use crate::check::types::Types;
use crate::graph::{EntryId, Formula, Graph, Plan, PlanId, constant};
use crate::index::Recorder;
use crate::scenario::Comparison;
use crate::types::{Constant, Enum, Type};
use afp_syntax::ast::{self, Item};
use afp_syntax::diagnostics::{Aim, Code, Diagnostic, Diagnostics};

/// A prefix that makes a formula parsable.
const BEFORE: &str = "plan Watched { var watched: float = ";
/// The matching suffix.
const BEHIND: &str = "\n}";

const WATCHED: &str =
    "write an entry by its name, or a formula of entries; two formulas may be compared";

/// Comparison operators; longer ones first.
const SIGNS: [&str; 6] = ["==", "!=", "<=", ">=", "<", ">"];

/// A formula, or a comparison.
#[derive(Clone, Debug)]
pub struct Watch {
    left: Formula,
    right: Option<(Comparison, Formula)>,
}

/// Why a watch is invalid, and a help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WatchError {
    pub message: String,
    /// The help; empty if unknown.
    pub help: String,
}

impl Watch {
    /// Parses a watch in the scope of a plan.
    ///
    /// # Errors
    /// The first error.
    pub fn new(graph: &Graph, plan: PlanId, text: &str) -> Result<Watch, WatchError> {
        let inside = Inside::new(graph, graph.plan(plan));
        let Some((left, sign, right)) = compared(text) else {
            if let Some((left, right)) = text.split_once('=').filter(|_| !text.contains('"')) {
                let (left, right) = (left.trim(), right.trim());
                return Err(WatchError {
                    message: "'=' compares nothing".to_owned(),
                    help: format!("write '{left} == {right}'"),
                });
            }
            return Ok(Watch { left: inside.formula(text, |_| None)?, right: None });
        };
        let left = inside.formula(left, |_| None)?;
        let right = inside.formula(right, |right| Some(compared_as(&left.ty, right)))?;
        if sign.is_order() && !left.ty.is_numeric() {
            return Err(WatchError {
                message: format!("values of '{}' have no order", left.ty),
                help: "write '==' or '!='".to_owned(),
            });
        }
        Ok(Watch { left, right: Some((sign, right)) })
    }

    pub fn ty(&self) -> &Type {
        match &self.right {
            Some(_) => &Type::Bool,
            None => &self.left.ty,
        }
    }

    /// Its value; `None` if an entry in it has none. `entry` returns values of the plan's entries.
    ///
    /// # Errors
    /// It cannot be computed, for example after a division by zero.
    pub fn value(
        &self,
        entry: &dyn Fn(EntryId) -> Option<Constant>,
    ) -> Result<Option<Constant>, afp_types::Error> {
        let entry = |id: u16| entry(EntryId(id));
        let left = constant::evaluate(&self.left, &entry)?;
        let Some((sign, right)) = &self.right else { return Ok(left) };
        let right = constant::evaluate(right, &entry)?;
        let both = left.zip(right);
        Ok(both.map(|(left, right)| Constant::Bool(sign.holds(&left, &right))))
    }
}

/// The scope of a plan's formulas.
struct Inside {
    entries: Vec<EntryDraft>,
    indices: Indices,
    types: Types,
}

impl Inside {
    fn new(graph: &Graph, plan: &Plan) -> Inside {
        let entries = plan.entries.iter();
        let entries = entries
            .map(|entry| EntryDraft::readable(&entry.name, entry.span, entry.kind, &entry.ty));
        let names = plan.entries.iter().map(|entry| Some(entry.name.as_str()));
        let mut types = Types::default();
        for toolbox in &graph.toolboxes {
            types.homes.push((toolbox.name.clone(), toolbox.span));
            let known = toolbox.enums.iter();
            types.enums.extend(known.map(|each| (Some(toolbox.name.clone()), each.clone())));
        }
        types.enums.extend(own_enums(graph).into_iter().map(|each| (None, each)));
        Inside { entries: entries.collect(), indices: Indices::of(names), types }
    }

    /// A formula of the wanted type, or of any type.
    fn formula(
        &self,
        text: &str,
        want: impl Fn(&Type) -> Option<Type>,
    ) -> Result<Formula, WatchError> {
        let whole = format!("{BEFORE}{text}{BEHIND}");
        let mut diags = Diagnostics::default();
        let read = init(&whole, &mut diags);
        let record = Recorder::for_text(whole.len());
        let scope = Scope {
            types: &self.types,
            tables: &[],
            entries: &self.entries,
            indices: &self.indices,
            readable: &|_| true,
            unreadable: "",
            text: &whole,
            record: &record,
        };
        // A text that closes the surrounding plan is invalid.
        let end = BEFORE.len() + text.trim_end().len();
        let ends = read.as_ref().map(|read| read.span().end as usize);
        let whole_text = |read: &ast::Formula| read.span().end as usize == end;
        let typed = read.filter(|read| !diags.has_errors() && whole_text(read));
        let typed = typed.and_then(|formula| scope.infer(&formula, &mut diags));
        let typed = typed.and_then(|formula| {
            let want = want(&formula.ty);
            scope.finish(formula, want.as_ref(), None, &mut diags)
        });
        typed.map(|(formula, _)| formula).ok_or_else(|| refused(text, ends, &diags))
    }
}

/// The error of a text with a formula that ends too early.
fn refused(text: &str, ends: Option<usize>, diags: &Diagnostics) -> WatchError {
    let first = diags.iter().next();
    let from = |first: &Diagnostic| (first.span.start as usize).saturating_sub(BEFORE.len());
    let ends = ends.map(|ends| ends.saturating_sub(BEFORE.len()));
    let rest = ends.filter(|ends| first.is_none_or(|first| from(first) >= *ends));
    let rest = rest.and_then(|ends| text.get(ends..)).map(str::trim).unwrap_or_default();
    match first {
        _ if text.contains('}') => WatchError {
            message: format!("'{}' is not a formula", text.trim()),
            help: WATCHED.to_owned(),
        },
        _ if !rest.is_empty() => WatchError {
            message: format!("unexpected '{rest}' after the formula"),
            help: WATCHED.to_owned(),
        },
        // The closing brace of the suffix is not the user's.
        Some(first) => {
            WatchError { message: first.message_without(BEHIND.trim()), help: help(text, first) }
        }
        None => WatchError {
            message: format!("'{}' is not a formula", text.trim()),
            help: WATCHED.to_owned(),
        },
    }
}

/// The help for an error in a formula. A watch cannot change the plan.
fn help(text: &str, mistake: &Diagnostic) -> String {
    use Code::{E0101, E0102, E0109, E0209, E0239};

    let of_names = matches!(mistake.code, E0101 | E0102 | E0109 | E0209 | E0239);
    let behind = (mistake.span.end as usize).saturating_sub(BEFORE.len());
    // In 'Plan.entry' the first name is not a misspelled enum.
    let is_home = text.get(behind..).is_some_and(|behind| behind.starts_with('.'));
    let of_formula = mistake.fix.is_some() || mistake.aim == Aim::Write && !is_home;
    match of_names && !of_formula {
        true => WATCHED.to_owned(),
        false => mistake.help_text(),
    }
}

/// The initial value of the first entry of the first plan of a text.
fn init(whole: &str, diags: &mut Diagnostics) -> Option<ast::Formula> {
    let file = afp_syntax::parse(whole, 0, diags).file();
    let plan = file.items().into_iter().find_map(|item| match item {
        Item::Plan(plan) => Some(plan),
        _ => None,
    })?;
    plan.entries().first()?.init()
}

/// Enums of plan files in the types of entries.
fn own_enums(graph: &Graph) -> Vec<Arc<Enum>> {
    let mut all: Vec<Arc<Enum>> = Vec::new();
    for entry in graph.plans.iter().flat_map(|plan| &plan.entries) {
        if let Type::Enum(each) = &entry.ty
            && each.toolbox.is_none()
            && all.iter().all(|known| known.name != each.name)
        {
            all.push(each.clone());
        }
    }
    all
}

/// Splits a comparison outside of string literals.
fn compared(text: &str) -> Option<(&str, Comparison, &str)> {
    let mut quoted = false;
    for (at, letter) in text.char_indices() {
        quoted ^= letter == '"';
        let sign = || SIGNS.into_iter().find(|sign| text[at..].starts_with(sign));
        if let Some(sign) = (!quoted).then(sign).flatten() {
            return Some((&text[..at], Comparison::parse(sign)?, &text[at + sign.len()..]));
        }
    }
    None
}

impl fmt::Display for WatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match &*self.help {
            "" => Ok(()),
            help => write!(f, " (help: {help})"),
        }
    }
}

impl std::error::Error for WatchError {}
