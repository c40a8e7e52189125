use super::{Arrows, arrows, circles};

fn graph(files: &[(&str, &str)]) -> Arrows {
    arrows(&files.iter().map(|&(file, text)| (file.to_owned(), text.to_owned())).collect())
}

/// The arrows as `from -> to`.
fn shown(files: &[(&str, &str)]) -> Vec<String> {
    graph(files).into_keys().map(|(from, to)| format!("{from} -> {to}")).collect()
}

const ROOT: (&str, &str) = ("lib.rs", "mod a; mod b;");

#[test]
fn imports_paths_and_macro_calls_are_arrows() {
    for text in [
        "use crate::b::B;",
        "use crate::{b::{B as C, D}};",
        "use super::b; fn f() { b::g(); }",
        "use super::b as c; struct S(c::B);",
        "fn f() -> crate::b::B { todo!() }",
        "fn f() { use crate::b::B; }",
        "fn f() { print!(\"{}\", [super::b::B::new()]); }",
        "fn f() { let x = Vec::<self::super::b::B>::new(); }",
        "use crate::b::*;",
    ] {
        let b = ("b.rs", "pub struct B; pub struct D; pub fn g() {}");
        assert_eq!(shown(&[ROOT, ("a.rs", text), b]), ["a.rs -> b.rs"], "{text}");
    }
}

#[test]
fn other_crates_empty_modules_and_own_names_are_not_arrows() {
    for text in [
        "use crate::b;",
        "use ::b::B; use std::b::B;",
        "use other::b; fn f(x: ::b::B) { b::g(); let y: <u8 as T>::b; }",
        "mod b { pub fn g() {} } fn f() { b::g(); self::b::g(); Self::b::g(); }",
        "#[cfg(test)] use crate::b::B; #[cfg(test)] mod tests { use crate::b::B; }",
        "mod tests; #[cfg(all(test, unix))] mod more;",
        "use crate::b::Foreign;",
    ] {
        let b = ("b.rs", "pub use other::Foreign; pub struct B; pub fn g() {}");
        let tests = [("a/tests.rs", "use crate::b::B;"), ("a/more.rs", "use crate::b::B;")];
        let none: [&str; 0] = [];
        assert_eq!(shown(&[ROOT, ("a.rs", text), b, tests[0], tests[1]]), none, "{text}");
    }
}

#[test]
fn a_reexport_leads_to_the_definition() {
    for reexport in ["pub use inner::B;", "pub use inner::*;", "pub use self::inner::B;"] {
        let b = format!("mod inner; {reexport}");
        let files =
            [ROOT, ("a.rs", "use crate::b::B;"), ("b.rs", &b), ("b/inner.rs", "pub enum B {}")];
        assert_eq!(shown(&files), ["a.rs -> b/inner.rs", "b.rs -> b/inner.rs"], "{reexport}");
    }
}

#[test]
fn a_function_may_have_the_name_of_a_module() {
    let root = ("lib.rs", "mod a; mod b; pub use b::b;");
    let b = ("b.rs", "pub mod inner; pub fn b() {}");
    let inner = ("b/inner.rs", "pub struct B;");
    let shown = shown(&[root, ("a.rs", "fn f(x: crate::b::inner::B) {}"), b, inner]);
    assert_eq!(shown, ["a.rs -> b/inner.rs", "lib.rs -> b.rs"]);
}

#[test]
fn an_item_without_a_visible_definition_comes_from_a_macro() {
    assert_eq!(
        shown(&[ROOT, ("a.rs", "use crate::b::B;"), ("b.rs", "make!(B);")]),
        ["a.rs -> b.rs"]
    );
}

#[test]
fn a_child_may_use_each_module_that_contains_it() {
    let files = [
        ("lib.rs", "mod a; pub struct R;"),
        ("a.rs", "mod b; use b::c::C; pub struct A;"),
        ("a/b.rs", "pub mod c; pub struct B;"),
        ("a/b/c.rs", "use super::B; use crate::{R, a::A}; pub struct C;"),
    ];
    assert_eq!(shown(&files), ["a.rs -> a/b/c.rs"]);
}

#[test]
fn files_that_reach_each_other_are_a_circle() {
    let files = [
        ("lib.rs", "mod a; mod b; mod c; mod d; mod e;"),
        ("a.rs", "use crate::b::B; pub struct A;"),
        ("b.rs", "use crate::c::C; pub struct B;"),
        ("c.rs", "use crate::{a::A, d::D}; pub struct C;"),
        ("d.rs", "pub struct D;"),
        ("e.rs", "use crate::a::A;"),
    ];
    assert_eq!(circles(&graph(&files)), [["a.rs", "b.rs", "c.rs"].into()].into());
}
