use std::collections::BTreeMap;

use super::{RULES, Rule, USAGE_RULES};

/// The contrast in the guidelines for accessible pages, for texts, and for lines and signs.
const TEXT: f64 = 4.5;
const LINE: f64 = 3.0;

/// Boxes with texts without their own class.
const HOLDERS: &[&str] = &["actor", "computation", "subplan", "supervisor", "configuration"];

/// The relative luminance of a colour such as `#5b6675`.
fn luminance(colour: &str) -> f64 {
    let part = |at: usize| {
        let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
        if value <= 0.039_28 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
}

fn contrast(one: &str, two: &str) -> f64 {
    let (one, two) = (luminance(one), luminance(two));
    (one.max(two) + 0.05) / (one.min(two) + 0.05)
}

/// The value of a property.
fn property<'r>(declarations: &'r str, name: &str) -> Option<&'r str> {
    let pairs = declarations.split(';').filter_map(|each| each.split_once(':'));
    let value = pairs.into_iter().find(|(known, _)| *known == name)?.1;
    (value != "none").then_some(value)
}

/// The colours of a theme, with later tables over earlier ones.
fn colours<'r>(tables: &[&[Rule]], of: impl Fn(&Rule) -> &'r str) -> BTreeMap<String, &'r str> {
    let rules = tables.iter().copied().flatten();
    let each = |rule: &Rule| {
        let declared = of(rule);
        rule.0.split(',').map(move |one| (one.to_owned(), declared)).collect::<Vec<_>>()
    };
    rules.flat_map(each).collect()
}

fn check(theme: &BTreeMap<String, &str>) {
    let page = property(theme[".page"], "fill").unwrap();
    let fill = |name: &str| {
        let own = theme.get(&format!(".box.{name}")).and_then(|each| property(each, "fill"));
        own.unwrap_or(page)
    };
    let hold = |what: &str, one: &str, two: &str, least: f64| {
        let found = contrast(one, two);
        assert!(found >= least, "{what}: {one} on {two} is {found:.2}, less than {least}");
    };
    for (selector, declared) in theme {
        let Some((kind, name)) = selector.split_once('.') else { continue };
        match (kind, name.split_once('.')) {
            ("text", _) if matches!(name, "template" | "port") => {
                let text = property(declared, "fill").unwrap();
                HOLDERS.iter().for_each(|holder| hold(selector, text, fill(holder), TEXT));
                hold(selector, text, page, TEXT);
            }
            ("text", _) => hold(selector, property(declared, "fill").unwrap(), fill(name), TEXT),
            ("", Some(("box", name))) => {
                let line = property(declared, "stroke").unwrap_or_else(|| fill(name));
                hold(selector, line, page, LINE);
            }
            ("", Some(("icon", name))) => {
                hold(selector, property(declared, "color").unwrap(), fill(name), LINE);
            }
            ("", Some(("flow" | "thin" | "tip" | "inner", _))) => {
                let line = property(declared, "stroke").or(property(declared, "fill"));
                hold(selector, line.unwrap(), page, LINE);
            }
            _ => {
                assert!(matches!(name, "page" | "halo" | "hollow"), "'{selector}' is not measured")
            }
        }
    }
}

#[test]
fn texts_lines_and_signs_have_enough_contrast() {
    for tables in [&[RULES][..], &[RULES, USAGE_RULES]] {
        check(&colours(tables, |rule| rule.1));
        check(&colours(tables, |rule| rule.2));
    }
}
