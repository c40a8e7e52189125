//! The lists of units.

use std::fmt::Write;
use std::fs;

use afp_syntax::units::Unit;

use super::with_list;
use crate::{compare, docs};

/// The width of a page of a code.
const WIDTH: usize = 100;

/// Each quantity with the symbols of its units.
fn quantities() -> Vec<(String, Vec<&'static str>)> {
    let mut found: Vec<(_, Vec<_>)> = Vec::new();
    for symbol in Unit::symbols() {
        let quantity = Unit::parse(symbol).unwrap().dimension.name();
        match found.last_mut() {
            Some((last, symbols)) if *last == quantity => symbols.push(symbol),
            _ => found.push((quantity, vec![symbol])),
        }
    }
    found
}

#[test]
fn the_language_has_a_table_of_units() {
    let mut list = "| quantity | units |\n|---|---|\n".to_owned();
    for (quantity, symbols) in quantities() {
        let _ = writeln!(list, "| {quantity} | `{}` |", symbols.join("`, `"));
    }
    let page = fs::read_to_string(docs().join("language.md")).unwrap();
    compare("language.md", &page, &with_list(&page, &list));
}

#[test]
fn the_page_of_unknown_units_names_all_units() {
    let symbols = |(_, symbols): (String, Vec<&str>)| format!("`{}`", symbols.join(" "));
    let units: Vec<_> = quantities().into_iter().map(symbols).collect();
    let text = format!(
        "The word behind the number is not a unit. Units are {}, and products of them without white space such as \
         `cm/s` or `m/s^2`.",
        units.join(", ")
    );
    let page = fs::read_to_string(docs().join("errors/E0236.md")).unwrap();
    let mut parts: Vec<_> = page.split("\n\n").collect();
    let text = wrapped(&text);
    parts[1] = &text;
    compare("errors/E0236.md", &page, &parts.join("\n\n"));
}

/// A text in lines of at most [`WIDTH`] letters.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.len() + 1 + word.len() <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}
