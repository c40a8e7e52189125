//! The plan text for a condition, a time or a name of another language.

use super::matcher::QUOTES;
use crate::habits::Sensor;
use crate::units::Unit;

/// A time in source form. A bare number gets a unit: `1 s` for `1000` ms.
pub(super) fn time(text: &str, unit: &str) -> String {
    let Ok(number) = text.parse::<f64>() else { return text.to_owned() };
    let ms = if unit == "s" { number * 1000.0 } else { number };
    if ms >= 1000.0 && ms % 1000.0 == 0.0 {
        format!("{} s", ms / 1000.0)
    } else {
        format!("{ms} ms")
    }
}

/// The type of a number or a quantity.
pub(super) fn type_of(text: &str) -> String {
    match text.split_once(' ').and_then(|(_, unit)| Unit::parse(unit)) {
        Some(unit) => unit.dimension.name().to_string(),
        None if text.contains('.') => "float".to_owned(),
        None => "int".to_owned(),
    }
}

pub(super) fn with_first(name: Option<&String>, change: impl Fn(&str) -> String) -> String {
    let name = name.map_or("", String::as_str);
    name.split_at_checked(1).map_or_else(String::new, |(first, rest)| change(first) + rest)
}

/// The first of several conditions, without brackets around them.
pub(super) fn first_of(condition: &str) -> &str {
    let inner = condition.trim().trim_end_matches([':', ',']).trim();
    let inner = inner.strip_prefix('(').and_then(|it| it.strip_suffix(')')).unwrap_or(inner);
    let signs = ["&&", "&", "|", " and ", " or ", " und ", " oder ", " xor ", "=>", ", "];
    let end = signs.into_iter().filter_map(|sign| inner.find(sign)).min();
    inner[..end.unwrap_or(inner.len())].trim()
}

/// Both sides of a comparison and its sign.
pub(super) fn comparison(condition: &str) -> Option<(&str, &str, &str)> {
    let signs = ["==", "!=", "~=", "<=", ">=", "<", ">", "=", " is "];
    let first = first_of(condition);
    let sign = signs.into_iter().find(|sign| first.contains(sign))?;
    let (left, right) = first.split_once(sign)?;
    Some((simple(left), sign.trim(), number_of(right.trim())))
}

/// A value without the parts that formulas lack: its first name, if there is more.
fn simple(value: &str) -> &str {
    let value = value.trim();
    let mut words = value.split_whitespace().zip(value.split_whitespace().skip(1));
    let is_name = |word: &str| word.starts_with(|first: char| first.is_ascii_alphabetic());
    let is_sentence = words.any(|(one, next)| is_name(one) && is_name(next));
    let is_formula = !value.contains(['(', ':', '[', '{', '?']) && !value.contains("->");
    if is_formula && !is_sentence && !value.starts_with('/') {
        return value;
    }
    let inner = value.trim_start_matches(|each: char| !each.is_ascii_alphanumeric());
    // Of words without a sign, the one that a sensor is known by is the value.
    let word = inner.split_whitespace().find(|word| is_sentence && Sensor::named(word).is_some());
    let inner = word.unwrap_or(inner);
    let ends = inner.find(|each: char| !each.is_ascii_alphanumeric() && each != '_');
    &inner[..ends.unwrap_or(inner.len())]
}

/// The value that a call shows: `"n is " + n` for `"n is", n`.
pub(super) fn shown(arguments: &str) -> String {
    let mut parts: Vec<String> = Vec::new();
    let (mut depth, mut quote, mut part) = (0_usize, None, String::new());
    for each in arguments.chars() {
        match (quote, each) {
            (None, '(' | '[' | '{') => depth += 1,
            (None, ')' | ']' | '}') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                parts.push(std::mem::take(&mut part));
                continue;
            }
            (None, sign) if QUOTES.contains(&sign) => quote = Some(sign),
            (Some(open), sign) if sign == open => quote = None,
            _ => {}
        }
        part.push(each);
    }
    parts.push(part);
    let parts: Vec<_> = parts.iter().map(|part| part.trim()).filter(|it| !it.is_empty()).collect();
    let is_text = |part: &str| part.starts_with(QUOTES) && part.len() > 1;
    let has_more = parts.len() > 1;
    let texts = parts.iter().map(|part| match is_text(part) {
        true => {
            let inner = part.trim_matches(QUOTES).replace("\\n", "");
            let inner =
                ["%d", "%f", "%s", "%i", "{}"].iter().fold(inner, |it, of| it.replace(of, ""));
            format!("\"{}{}\"", inner.trim_end(), if has_more { " " } else { "" })
        }
        false => (*part).to_owned(),
    });
    let texts: Vec<_> = texts.collect();
    match texts.as_slice() {
        [] => "\"\"".to_owned(),
        [first, ..] if has_more && !first.starts_with('"') => {
            format!("\"\" + {}", texts.join(" + \" \" + "))
        }
        texts => texts.join(" + "),
    }
}

/// A number with its unit, without the text after it; any other text unchanged.
fn number_of(text: &str) -> &str {
    let number = text.find(' ').filter(|_| text.starts_with(|it: char| it.is_ascii_digit()));
    let Some(number) = number else { return simple(text) };
    let behind = text[number..].trim_start();
    let unit = behind.find(' ').map_or(behind, |end| &behind[..end]);
    let is_formula = unit.starts_with(['+', '-', '*', '/', '%']);
    match Unit::parse(unit).is_some() {
        _ if is_formula => text,
        true => &text[..text.len() - behind.len() + unit.len()],
        false => &text[..number],
    }
}

/// A computation that chooses by a condition: if it holds, an edge leads to `then`, otherwise to an
/// element.
pub(super) fn choose(condition: &str, then: &str, element: &str) -> String {
    let other = if then == "terminate" { element } else { "terminate" };
    let whole = |(left, _, right): &(&str, _, &str)| !left.is_empty() && !right.is_empty();
    let Some((left, sign, right)) = comparison(condition).filter(whole) else {
        let value = first_of(condition).trim_start_matches('=');
        let negated = value.strip_prefix("not ").or_else(|| value.strip_prefix('!'));
        let (value, equals) = negated.map_or((value, true), |value| (value.trim(), false));
        let value = match simple(value) {
            "" => "n",
            value => value,
        };
        return format!(
            "computation choose: Is(value = {value}, equals = {equals}) {{ Yes -> {then}, No -> {other} }}"
        );
    };
    let is_number = right.starts_with(|it: char| it.is_ascii_digit() || it == '-');
    let sign = if sign == "~=" { "!=" } else { sign };
    if matches!(sign, "==" | "!=" | "=" | "is") && !is_number {
        let right = match right {
            "HIGH" | "TRUE" | "True" => "true",
            "LOW" | "FALSE" | "False" => "false",
            right => right,
        };
        let (yes, no) = if sign == "!=" { (other, then) } else { (then, other) };
        return format!(
            "computation choose: Is(value = {left}, equals = {right}) {{ Yes -> {yes}, No -> {no} }}"
        );
    }
    let (holds, fails) = match sign {
        "<" => ("Less", "Equal, Greater"),
        "<=" => ("Less, Equal", "Greater"),
        ">" => ("Greater", "Less, Equal"),
        ">=" => ("Greater, Equal", "Less"),
        "!=" => ("Less, Greater", "Equal"),
        _ => ("Equal", "Less, Greater"),
    };
    format!(
        "computation choose: Compare(left = {left}, right = {right}) {{ {holds} -> {then}, {fails} -> {other} }}"
    )
}
