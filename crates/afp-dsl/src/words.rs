//! Wording shared by diagnostics: lists, articles, and the name that was probably meant.

use crate::draw::formula::quantity;
use crate::types::{Dimension, Type};

/// `'a', 'b' and 'c'`, in single quotes.
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>, joint: &str) -> String {
    let quoted: Vec<_> = names.into_iter().map(|name| format!("'{name}'")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [front @ .., last] => format!("{} {joint} {last}", front.join(", ")),
    }
}

/// The candidate that differs least from `name`, when it is near enough to be a slip.
pub(crate) fn nearest<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let limit = (name.chars().count() / 3).clamp(1, 3);
    let scored = candidates.into_iter().map(|candidate| (distance(name, candidate), candidate));
    scored.filter(|(score, _)| *score <= limit).min_by_key(|(score, _)| *score).map(|(_, c)| c)
}

/// How many letters have to be changed, added, removed or swapped with their neighbour; case
/// counts for nothing.
fn distance(left: &str, right: &str) -> usize {
    let left: Vec<char> = left.to_lowercase().chars().collect();
    let right: Vec<char> = right.to_lowercase().chars().collect();
    let mut before: Vec<usize> = Vec::new();
    let mut row: Vec<usize> = (0..=right.len()).collect();
    for (i, a) in left.iter().enumerate() {
        let mut next = vec![i + 1];
        for (j, b) in right.iter().enumerate() {
            let changed = row[j] + usize::from(a != b);
            let mut best = changed.min(row[j + 1] + 1).min(next[j] + 1);
            let swapped = i > 0 && j > 0 && *a == right[j - 1] && left[i - 1] == *b;
            if swapped {
                best = best.min(before[j - 1] + 1);
            }
            next.push(best);
        }
        before = std::mem::replace(&mut row, next);
    }
    row[right.len()]
}

/// A type with its article, such as `a length` or `an int`.
pub(crate) fn a_type(ty: &Type) -> String {
    match ty {
        Type::Bool => "a bool".to_owned(),
        Type::Int => "an int".to_owned(),
        Type::Quantity(dimension) => a_dimension(*dimension),
        Type::Text => "a text".to_owned(),
        Type::Enum(home) => format!("a value of '{}'", home.name),
        Type::Object(home) => format!("a '{}'", home.name),
        Type::Any => "a value".to_owned(),
        Type::Number => "a number".to_owned(),
    }
}

/// A dimension with its article; none is a bare number.
pub(crate) fn a_dimension(dimension: Dimension) -> String {
    if dimension == Dimension::NONE {
        return "a bare number".to_owned();
    }
    let name = dimension.name();
    let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {name}")
}

/// A value in SI units as people write it, such as `31 cm/s` or `2 km`: as drawings do where that is
/// short, otherwise rounded and in the usual unit.
pub(crate) fn value(value: f64, ty: &Type) -> String {
    let Type::Quantity(dimension) = ty else { return plain(value) };
    let exact = quantity(value, *dimension);
    // Zero is as short in any unit.
    if exact.len() <= SHORT && value != 0.0 {
        return exact;
    }
    let symbol = dimension.usual_unit();
    let one = crate::types::literal::Literal::parse(&format!("1 {symbol}"));
    let factor = one.ok().and_then(|literal| literal.value()).unwrap_or(1.0);
    format!("{} {symbol}", plain(value / factor)).trim_end().to_owned()
}

/// A longer exact value, in letters, has come from a calculation.
const SHORT: usize = 14;

/// At most nine decimals, without zeros at the end.
fn plain(value: f64) -> String {
    let text = format!("{value:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::{list, nearest, value};
    use crate::types::{Dimension, Type};

    #[test]
    fn slips_find_the_name_that_was_meant() {
        let names = ["Forward", "Turn", "SearchWall"];
        assert_eq!(nearest("Froward", names), Some("Forward"));
        assert_eq!(nearest("forward", names), Some("Forward"));
        assert_eq!(nearest("SearchWal", names), Some("SearchWall"));
        assert_eq!(nearest("Curve", names), None);
    }

    #[test]
    fn lists_read_like_sentences() {
        assert_eq!(list(["a"], "or"), "'a'");
        assert_eq!(list(["a", "b", "c"], "or"), "'a', 'b' or 'c'");
    }

    #[test]
    fn values_are_shown_as_people_write_them() {
        let shown = |number, dimension| {
            value(number, &Type::Quantity(Dimension::named(dimension).unwrap()))
        };
        assert_eq!(shown(0.31, "speed"), "31 cm/s");
        assert_eq!(shown(2.0, "speed"), "2 m/s");
        assert_eq!(shown(0.3, "length"), "30 cm");
        assert_eq!(shown(1.0, "length"), "1 m");
        assert_eq!(shown(2000.0, "length"), "2 km");
        assert_eq!(shown(-2.5, "length"), "-2.5 m");
        assert_eq!(shown(2.0 / 3.0, "length"), "66.666666667 cm");
        assert_eq!(shown(0.0, "length"), "0 cm");
        assert_eq!(shown(0.02, "duration"), "20 ms");
        assert_eq!(shown(60.0, "duration"), "60 s");
        assert_eq!(shown(std::f64::consts::FRAC_PI_2, "angle"), "90 deg");
        assert_eq!(shown(std::f64::consts::TAU, "angle"), "360 deg");
        assert_eq!(value(2.5, &Type::FLOAT), "2.5");
    }
}
