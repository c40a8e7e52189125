//! The lists of the functions of formulas.

use std::fs;

use afp_dsl::graph::Function;

use super::with_paragraph;
use crate::{compare, docs};

#[test]
fn the_page_of_unknown_functions_names_all_functions() {
    let names: Vec<_> = Function::ALL.iter().map(|it| format!("`{}`", it.name())).collect();
    let (last, names) = names.split_last().unwrap();
    let text = format!("Use {} or {last}. For anything else, use a computation.", names.join(", "));
    let page = fs::read_to_string(docs().join("errors/E0243.md")).unwrap();
    compare("errors/E0243.md", &page, &with_paragraph(&page, "Use `abs`", &text));
}

#[test]
fn the_language_explains_all_functions() {
    let page = fs::read_to_string(docs().join("language.md")).unwrap();
    for function in Function::ALL {
        let call = format!("`{}({})`", function.name(), function.operands().0.join(", "));
        assert!(page.contains(&call), "docs/language.md says nothing about {call}");
    }
}
