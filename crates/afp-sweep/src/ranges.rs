//! Seeds, worlds and values in command-line syntax: `0..1000`, `random:7..99`,
//! `distance=20cm..60cm:5cm`.

use afp_excerpt::words::unquoted;

use crate::grid::{Axis, Point};
use crate::seeds::Seeds;

/// The number of values in a range without a step.
const POINTS: u64 = 5;
const MOST: f64 = 1e6;

/// Parses `0..1000` (the last is 999), `0..=999`, a single seed, or several of these with commas.
///
/// # Errors
/// The expected syntax.
pub fn seeds(text: &str) -> Result<Seeds, String> {
    if !text.contains(',') {
        return one_after_the_other(text);
    }
    let mut all = Vec::new();
    for part in text.split(',') {
        let part = one_after_the_other(part)?;
        if (all.len() as u64).saturating_add(part.len()) as f64 > MOST {
            return Err(format!("'{text}' are more than {MOST} seeds; give one range of them"));
        }
        all.extend((0..part.len()).map(|number| part.nth(number)));
    }
    Seeds::list(all)
}

fn one_after_the_other(text: &str) -> Result<Seeds, String> {
    let wrong = || "expected seeds such as 0..1000 (the last is 999)".to_owned();
    let number = |text: &str| text.trim().parse::<u64>().map_err(|_| wrong());
    let range = match text.split_once("..") {
        None => number(text)?..number(text)?.checked_add(1).ok_or_else(wrong)?,
        Some((from, to)) => match to.strip_prefix('=') {
            Some(last) => number(from)?..number(last)?.checked_add(1).ok_or_else(wrong)?,
            None => number(from)?..number(to)?,
        },
    };
    if range.is_empty() {
        return Err(format!("'{text}' has no seeds"));
    }
    Ok(Seeds::new(range))
}

/// Parses one or several worlds as in `--world`: `random:7..99` means `random:7` to `random:98`.
///
/// # Errors
/// An invalid range.
pub fn worlds(text: &str) -> Result<Vec<String>, String> {
    match text.strip_prefix("random:") {
        Some(range) if range.contains("..") => {
            let seeds = seeds(range)?;
            if seeds.len() as f64 > MOST {
                return Err(format!("'{text}' are more than {MOST} worlds; give a part of them"));
            }
            Ok((0..seeds.len()).map(|n| format!("random:{}", seeds.nth(n))).collect())
        }
        _ => Ok(vec![text.to_owned()]),
    }
}

/// Parses an axis: `distance=20cm..60cm`, `distance=20cm..60cm:5cm`, `distance=20cm,30cm`.
///
/// A range includes both ends. The default step is 1 for integers without a unit, and otherwise a
/// quarter of the range.
///
/// # Errors
/// The expected syntax.
pub fn axis(text: &str) -> Result<Axis, String> {
    let (name, values) = match text.split_once('=') {
        Some((name, values)) if !name.trim().is_empty() => (name.trim().to_owned(), values.trim()),
        _ => return Err("expected a name and its values, such as distance=20cm..60cm".to_owned()),
    };
    let texts = match values.split_once("..").filter(|_| !values.contains('"')) {
        Some((from, to)) => range(from, to)?,
        None => list(values)?,
    };
    let points = texts.into_iter().map(|text| Point { text, si: None }).collect();
    Ok(Axis { name, points, by_seed: false })
}

/// Splits values at commas; a quoted value loses its quotes.
fn list(values: &str) -> Result<Vec<String>, String> {
    // Whether a value is still empty, and whether a quote is open.
    let (mut before, mut open) = (true, false);
    let between = |c: char| {
        open = if open { c != '"' } else { c == '"' && before };
        let ends = c == ',' && !open;
        before = ends || (before && c.is_whitespace());
        ends
    };
    let all: Vec<&str> = values.split(between).map(str::trim).collect();
    if open {
        return Err(format!("a quote is missing in '{values}'"));
    }
    if all.iter().any(|value| value.is_empty()) {
        return Err(format!("a value is missing in '{values}'"));
    }
    Ok(all.into_iter().map(|value| unquoted(value).to_owned()).collect())
}

fn range(from: &str, to: &str) -> Result<Vec<String>, String> {
    let (to, step) = match to.split_once(':') {
        Some((to, step)) => (to, Some(step)),
        None => (to, None),
    };
    if let Some(all) = whole_range(from, to, step)? {
        return Ok(all);
    }
    let (first, unit) = number(from)?;
    let (last, other) = number(to)?;
    // In `20..60cm` the unit applies to both.
    let unit = if unit.is_empty() { other } else { unit };
    if unit != other {
        return Err(format!("write both ends of '{from}..{to}' in the same unit"));
    }
    let step = match step {
        Some(step) => match number(step)? {
            (step, own) if own == unit || own.is_empty() => step,
            _ if unit.is_empty() => {
                return Err(format!("write the step '{step}' without a unit, as the range is"));
            }
            _ => return Err(format!("write the step '{step}' in '{unit}', as the range is")),
        },
        None if unit.is_empty() && first.fract() == 0.0 && last.fract() == 0.0 => 1.0,
        None => (last - first) / (POINTS - 1) as f64,
    };
    let steps = (last - first) / step;
    if step > 0.0 && steps >= MOST {
        return Err(too_many(from, to));
    }
    if !(step > 0.0 && steps >= 0.0) {
        return Err(format!("no values are in '{from}..{to}' in steps of {}", written(step, unit)));
    }
    // A step that ends at the last value includes it despite rounding.
    let count = (steps + 1e-9).floor() as u64 + 1;
    Ok((0..count).map(|n| written(first + n as f64 * step, unit)).collect())
}

/// Parses a range of integers without a unit, which is counted exactly; `None` for other ranges.
fn whole_range(from: &str, to: &str, step: Option<&str>) -> Result<Option<Vec<String>>, String> {
    let whole = |text: &str| text.trim().parse::<i64>().ok();
    let (Some(first), Some(last)) = (whole(from), whole(to)) else { return Ok(None) };
    let Some(step) = step.map_or(Some(1), whole) else { return Ok(None) };
    let steps = match last.checked_sub(first) {
        Some(distance) if step > 0 && distance >= 0 => distance / step,
        // Such a range is too long or invalid, so the general case reports it.
        _ => return Ok(None),
    };
    if steps as f64 >= MOST {
        return Err(too_many(from, to));
    }
    Ok(Some((0..=steps).map(|n| (first + n * step).to_string()).collect()))
}

fn too_many(from: &str, to: &str) -> String {
    format!("'{from}..{to}' has more than {MOST} values; write a wider step")
}

/// Splits a number and its unit.
fn number(text: &str) -> Result<(f64, &str), String> {
    let text = text.trim();
    let ends = text.char_indices().map(|(at, c)| at + c.len_utf8()).rev();
    let mut parsed = ends.filter_map(|end| Some((text.get(..end)?.parse::<f64>().ok()?, end)));
    match parsed.find(|(number, _)| number.is_finite()) {
        Some((number, end)) => Ok((number, text.get(end..).unwrap_or("").trim_start())),
        None => {
            Err(format!("'{text}' is not a number; write ranges as 20cm..60cm, others as lists"))
        }
    }
}

/// Writes a number with its unit, rounded to twelve digits; the written value is the one that
/// counts.
fn written(number: f64, unit: &str) -> String {
    let rounded = format!("{number:.11e}").parse::<f64>().unwrap_or(number);
    format!("{rounded}{unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<String> {
        axis(text).unwrap().points.into_iter().map(|point| point.text).collect()
    }

    #[test]
    fn ranges_have_steps_and_units() {
        assert_eq!(texts("d=20cm..60cm:20cm"), ["20cm", "40cm", "60cm"]);
        assert_eq!(texts("d=20..60cm:20"), ["20cm", "40cm", "60cm"]);
        assert_eq!(texts("d = 20cm..60cm"), ["20cm", "30cm", "40cm", "50cm", "60cm"]);
        assert_eq!(texts("d=0.1m..0.3m:0.1m"), ["0.1m", "0.2m", "0.3m"]);
        assert_eq!(texts("n=1..4"), ["1", "2", "3", "4"]);
        assert_eq!(texts("n=-1.5..0.5:1"), ["-1.5", "-0.5", "0.5"]);
        assert_eq!(texts("n=-3..4:3"), ["-3", "0", "3"]);
        let large = texts("n=1000000000000001..1000000000000003");
        assert_eq!(large, ["1000000000000001", "1000000000000002", "1000000000000003"]);
        assert_eq!(texts("side=left, right"), ["left", "right"]);
        assert_eq!(texts("d=5 m/s"), ["5 m/s"]);
        assert_eq!(texts(r#"mode="x,y", "z",q"#), ["x,y", "z", "q"]);
        assert_eq!(texts(r#"mode="","a..b",5" wide"#), ["", "a..b", r#"5" wide"#]);
        assert_eq!(texts(r#"world.name="5","x,y"," z ""#), ["5", "x,y", " z "]);
    }

    #[test]
    fn invalid_ranges_are_explained() {
        for (text, why) in [
            ("d", "such as distance=20cm..60cm"),
            ("d=20cm..1m", "same unit"),
            ("d=a..b", "not a number"),
            ("d=60cm..20cm:5cm", "no values are in"),
            ("d=0..1:0", "no values are in"),
            ("d=0cm..1cm:1m", "write the step '1m' in 'cm'"),
            ("d=0.1..0.5:20%", "write the step '20%' without a unit"),
            ("mode=\"x,y", "a quote is missing in '\"x,y'"),
            ("d=1,,2", "a value is missing"),
            ("d=0..1e9", "more than 1000000 values"),
        ] {
            let error = axis(text).unwrap_err();
            assert!(error.contains(why), "{text}: {error}");
        }
    }

    #[test]
    fn seeds_and_worlds_end_before_their_end() {
        let all = seeds("3..6").unwrap();
        assert_eq!((all.len(), all.nth(2)), (3, 5));
        assert_eq!(seeds("3..=5").unwrap(), all);
        assert_eq!(seeds("7").unwrap().len(), 1);
        assert!(worlds("random:0..99999999").unwrap_err().contains("more than 1000000 worlds"));
        let several = seeds("7,1..3,9").unwrap();
        assert_eq!((several.len(), several.nth(2), several.nth(3)), (4, 2, 9));
        assert_eq!(several.to_string(), "7,1,2,9");
        assert_eq!(seeds("3,4,5").unwrap(), all);
        assert_eq!(seeds("1,0..2").unwrap_err(), "the seed 1 is given twice");
        assert!(seeds("1,0..99999999").unwrap_err().contains("more than 1000000 seeds"));
        assert!(seeds("3..3").is_err() && seeds("-1..2").is_err() && seeds("x").is_err());
        assert_eq!(worlds("random:7..9").unwrap(), ["random:7", "random:8"]);
        assert_eq!(worlds("random:7").unwrap(), ["random:7"]);
        assert_eq!(worlds("hall.toml").unwrap(), ["hall.toml"]);
    }
}
