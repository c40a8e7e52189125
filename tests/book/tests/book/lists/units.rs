//! The lists of units.

use std::fmt::Write;
use std::fs;

use afp_syntax::units::Unit;

use super::{with_list, with_paragraph};
use crate::{compare, docs};

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
        "The word after the number is not a unit. Units are {}, and products of them without spaces, such as \
         `cm/s` or `m/s^2`.",
        units.join(", ")
    );
    let page = fs::read_to_string(docs().join("errors/E0236.md")).unwrap();
    compare("errors/E0236.md", &page, &with_paragraph(&page, "The word after", &text));
}
