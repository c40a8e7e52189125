//! Required counts of a claim: `never`, `always`, `once`, `3 times`.

use crate::scenario::{Claim, Wanted};
use afp_syntax::ast::Bound;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;

/// The required count of a claim; reports invalid words.
pub(super) fn wanted(
    never: bool,
    claim: &Claim,
    bounds: &[Bound],
    diags: &mut Diagnostics,
) -> Option<Wanted> {
    let often = bounds.iter().find(|bound| ["always", "once", "times"].contains(&&*bound.word()));
    let Some(bound) = often else {
        return Some(if never { Wanted::Never } else { Wanted::Once });
    };
    let always = bound.word() == "always";
    let message = match (never, always, claim.is_event()) {
        (true, true, _) => "'never' holds always",
        (true, false, _) => "'never' is zero times",
        (false, true, true) => "an event at an instant cannot hold always",
        (false, false, false) => "a condition that lasts cannot be counted",
        (false, true, false) => return Some(Wanted::Always),
        (false, false, true) => return count(bound, diags).map(Wanted::Times),
    };
    let help = match bound.number() {
        Some(number) => message!("remove '{} times'", number.text),
        None => message!("remove '{}'", bound.word()),
    };
    diags.push(Diagnostic::new(Code::E0604, bound.span(), message).help(help));
    None
}

fn count(bound: &Bound, diags: &mut Diagnostics) -> Option<u32> {
    let Some(number) = bound.number() else { return Some(1) };
    let count = number.text.parse().ok().filter(|count| *count > 0);
    if count.is_none() {
        let help = match number.text.parse::<u32>() {
            Ok(_) => "write 'never' if it must not happen",
            Err(_) => "write a smaller number",
        };
        let message = message!("an event cannot be expected {} times", Words(number.text));
        diags.push(Diagnostic::new(Code::E0604, number.span, message).help(help));
    }
    count
}
