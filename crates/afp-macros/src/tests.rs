//! The macros' errors.

use proc_macro2::TokenStream;
use quote::quote;

use crate::{expand, plan_code, scenarios_code, toolbox_code};

/// The texts of all compile errors.
fn errors(tokens: &TokenStream) -> Vec<String> {
    let text = tokens.to_string();
    assert!(text.starts_with(":: core :: compile_error !"), "{text}");
    text.split(":: core :: compile_error !").skip(1).map(str::to_owned).collect()
}

#[test]
fn every_error_of_a_plan_is_a_compile_error_with_its_place() {
    let errors = errors(&expand(quote!("tests/wrong/plan.afp"), plan_code));
    assert_eq!(errors.len(), 2, "{errors:?}");
    assert!(errors[0].contains("tests/wrong/plan.afp:5:33"), "{}", errors[0]);
    assert!(errors[0].contains("error[E02"), "{}", errors[0]);
    assert!(errors[1].contains("tests/wrong/plan.afp:6:"), "{}", errors[1]);
}

#[test]
fn every_error_of_a_toolbox_is_a_compile_error_with_its_place() {
    let errors = errors(&expand(quote!("tests/wrong/toolbox.afp"), toolbox_code));
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].contains("tests/wrong/toolbox.afp:4:"), "{}", errors[0]);
}

#[test]
fn the_templates_of_a_broken_toolbox_are_still_generated() {
    let text = expand(quote!("tests/wrong/toolbox.afp"), toolbox_code).to_string();
    assert!(text.contains("pub struct Drive") && text.contains("pub mod drive"), "{text}");
}

#[test]
fn a_missing_file_is_named() {
    let errors = errors(&expand(quote!("no/such.afp"), plan_code));
    assert!(errors[0].contains("cannot read") && errors[0].contains("no/such.afp"), "{errors:?}");
    let errors = errors_of_toolbox("nobody.afp");
    assert!(errors[0].contains("nobody.afp"), "{errors:?}");
}

#[test]
fn a_plan_of_a_file_is_selected_by_its_name() {
    let errors = errors(&expand(quote!("tests/files/main.afp:Nobody"), plan_code));
    assert!(errors[0].contains("'Nobody'"), "{errors:?}");
    let text = expand(quote!("tests/files/sub/pause.afp:Pause"), plan_code).to_string();
    assert!(text.contains("pub struct Pause"), "{text}");
}

#[test]
fn errors_of_used_files_have_their_own_place() {
    let errors = errors(&expand(quote!("tests/wrong/files.afp"), plan_code));
    assert_eq!(errors.len(), 2, "{errors:?}");
    assert!(errors[0].contains("tests/wrong/files.afp:3:5"), "{}", errors[0]);
    assert!(errors[0].contains("tests/wrong/used/nowhere.afp"), "{}", errors[0]);
    assert!(errors[1].contains("tests/wrong/used/far.afp:5:"), "{}", errors[1]);
}

#[test]
fn every_file_of_a_plan_is_watched() {
    let text = expand(quote!("tests/files/main.afp"), plan_code).to_string();
    for file in ["tests/files/main.afp", "tests/files/sub/pause.afp"] {
        let end = format!("{file}\")");
        assert!(text.contains("include_str !") && text.contains(&end), "{file}");
    }
}

fn errors_of_toolbox(name: &str) -> Vec<String> {
    errors(&expand(quote!(#name), toolbox_code))
}

#[test]
fn an_invalid_file_name_is_a_compile_error() {
    for wrong in [quote!(), quote!(7), quote!("a.afp", boxes = {}), quote!("a.afp" "b.afp")] {
        let text = expand(wrong, plan_code).to_string();
        assert!(text.contains("compile_error"), "{text}");
    }
}

#[test]
fn every_scenario_of_a_folder_is_a_test() {
    let text = expand(quote!("tests/scenarios"), scenarios_code).to_string();
    for name in ["behind_a_tab", "in_two_lines", "behind_a_plan"] {
        assert!(text.contains(&format!("fn {name} ()")), "{name}: {text}");
    }
    assert_eq!(text.matches("# [test]").count(), 3, "{text}");
    assert!(text.contains("none.afp\")"), "a file without one is watched: {text}");
}

#[test]
fn a_built_in_toolbox_is_found_by_its_file_name() {
    let text = expand(quote!("std.afp"), toolbox_code).to_string();
    assert!(text.contains("pub mod wait"));
}
