//! Times in the source: `every`, `deadline`, `budget`, `stop`.

use crate::check::convert;
use crate::check::formula::Scope;
use crate::types::text::a_dimension;
use crate::types::text::duration;
use crate::types::{Constant, Dimension, Type};
use afp_syntax::ast::{Formula, FormulaKind, Name, Timing};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::literal::Literal;
use afp_syntax::message;

/// Default poll period, nanoseconds.
pub(crate) const DEFAULT_EVERY: u64 = 10_000_000;

/// One hour.
const LONGEST: u64 = 3_600_000_000_000;

/// A time in nanoseconds, 1 ns to 1 h; reports other values.
pub(crate) fn nanoseconds(timing: &Timing, diags: &mut Diagnostics) -> Option<u64> {
    let value = timing.value()?;
    above_zero(&value, value.kind(), diags)
}

fn above_zero(value: &Formula, kind: FormulaKind, diags: &mut Diagnostics) -> Option<u64> {
    match time_of(value, kind, &["ms"], diags)? {
        0 => refuse(value, "a time must be longer than zero", diags),
        time => Some(time),
    }
}

/// [`nanoseconds`] for the times of a supervisor, which may be constants of the plan.
pub(crate) fn of_supervisor(
    timing: &Timing,
    scope: &Scope<'_>,
    diags: &mut Diagnostics,
) -> Option<u64> {
    let value = timing.value()?;
    match value.kind() {
        FormulaKind::Ref(_) => {}
        kind => return above_zero(&value, kind, diags),
    }
    let duration = Type::Quantity(Dimension::DURATION);
    let (_, constant) = scope.check(&value, Some(&duration), diags)?;
    let Some(Constant::Float(seconds)) = constant else {
        diags.push(
            Diagnostic::new(Code::E0401, value.span(), "a time must be known before the plan runs")
                .help("write a number with a unit, or name a 'const'"),
        );
        return None;
    };
    // To the nearest nanosecond; far values stay out of range.
    match (seconds * 1e9).round() {
        nanos if (1.0..=LONGEST as f64).contains(&nanos) => Some(nanos as u64),
        _ => refuse(&value, "a time must be longer than zero and at most one hour", diags),
    }
}

/// A time in nanoseconds, 0 to 1 h; reports other values. `usual` are its likely units; if empty,
/// they depend on the number.
pub(crate) fn time(value: &Formula, usual: &[&str], diags: &mut Diagnostics) -> Option<u64> {
    time_of(value, value.kind(), usual, diags)
}

fn time_of(
    value: &Formula,
    kind: FormulaKind,
    usual: &[&str],
    diags: &mut Diagnostics,
) -> Option<u64> {
    let span = value.span();
    let FormulaKind::Number { number, unit, broken, .. } = kind else {
        return refuse(value, "a time must be a positive number with a unit", diags);
    };
    if broken {
        return None;
    }
    let Some(unit) = unit else {
        let units = match usual {
            [] => convert::likely(&number.text, Dimension::DURATION, None),
            usual => usual.iter().map(|unit| (*unit).to_owned()).collect(),
        };
        let better: Vec<_> = units.iter().map(|unit| format!("{} {unit}", number.text)).collect();
        diags.push(convert::bare(span, Dimension::DURATION, &better));
        return None;
    };
    let literal = Literal::of_tokens(&number.text, Some(&unit.text))?;
    let dimension = literal.dimension();
    if dimension != Dimension::DURATION {
        diags.push(no_duration(value, &unit, &literal));
        return None;
    }
    match literal.nanoseconds() {
        Some(time @ 0..=LONGEST) => Some(time),
        Some(_) => refuse(value, "a time must be at most one hour", diags),
        None => refuse(
            value,
            "a time must be a whole number of nanoseconds and at most one hour",
            diags,
        ),
    }
}

/// Reports a quantity that is not a duration. A rate suggests its period.
fn no_duration(value: &Formula, unit: &Name, literal: &Literal) -> Diagnostic {
    let dimension = literal.dimension();
    let message = message!("expected a duration, found {}", Words(a_dimension(dimension)));
    let error = Diagnostic::new(Code::E0204, unit.span, message);
    let rate =
        literal.value().filter(|_| dimension.times(Dimension::DURATION) == Some(Dimension::NONE));
    let Some(rate) = rate else { return error.help("write a time in 's', 'ms', 'us' or 'ns'") };
    let nanos = (1e9 / rate).round();
    if !(1.0..=LONGEST as f64).contains(&nanos) {
        return error.help("write the time between two polls, such as '10 ms'");
    }
    let period = duration(nanos as u64);
    match nanos * rate == 1e9 {
        true => error.help(message!("write its period: '{}'", period)).fix(value.span(), period),
        false => error.help(message!("write its period, which is about '{}'", period)),
    }
}

fn refuse(value: &Formula, message: &'static str, diags: &mut Diagnostics) -> Option<u64> {
    diags.push(
        Diagnostic::new(Code::E0401, value.span(), message)
            .help("write a time from '1 ns' to '1 h', such as '10 ms'"),
    );
    None
}

/// Reports a deadline after the next release.
pub(crate) fn deadline_fits(
    deadline: u64,
    every: u64,
    span: afp_syntax::source::Span,
    diags: &mut Diagnostics,
) {
    if deadline > every {
        let message = "the deadline is longer than the period";
        diags.push(
            Diagnostic::new(Code::E0402, span, message)
                .help(message!("write at most '{}'", duration(every))),
        );
    }
}
