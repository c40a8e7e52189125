//! Plans and toolboxes in the book.

use std::collections::BTreeMap;

use afp_book::Block;
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_format::format;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::parse;
use afp_syntax::source::Source;

use crate::{blocks, toolboxes};

/// Texts around a fragment that make it a file: none, a plan's body, an element's, a template's.
const FRAMES: &[(&str, &str)] = &[
    ("", ""),
    ("plan P {\n", "}\n"),
    ("plan P { actor a: T {\n", "}}\n"),
    ("toolbox t\nactor T {\n", "}\n"),
];

#[test]
fn plans_and_toolboxes_of_the_book_compile() {
    let mut shown: BTreeMap<String, Shown> = BTreeMap::new();
    let mut wrong = Vec::new();
    for block in blocks("afp") {
        let nothing = || Shown { toolboxes: toolboxes(), files: Texts::default() };
        let own = shown.entry(block.page.clone()).or_insert_with(nothing);
        if let Some(why) = check(&block, own) {
            wrong.push(format!("{}: {why}", block.place()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The blocks shown so far on a page.
struct Shown {
    toolboxes: Toolboxes,
    files: Texts,
}

/// Returns the error of a block; later plans of the page can use its toolboxes and files.
fn check(block: &Block, shown: &mut Shown) -> Option<String> {
    let name = block.value("file").unwrap_or("block.afp");
    let source = Source::new(name, block.text.as_str());
    if block.has("fragment") {
        return fragment(&block.text);
    }
    let (diags, rendered) = match is_toolbox(&block.text) {
        true => {
            let mut alone = Toolboxes::default();
            alone.add(source.clone(), "crate");
            if block.value("file").is_some() {
                shown.toolboxes.add(source, "crate");
            }
            (alone.diagnostics().clone(), alone.diagnostics().render(alone.sources(), false))
        }
        false => {
            let compiled = compile(&source, &shown.toolboxes, &shown.files);
            shown.files.add(name, block.text.as_str());
            (compiled.diags.clone(), compiled.render(false))
        }
    };
    match block.value("error") {
        Some(codes) => {
            let found: Vec<_> = diags.iter().map(|each| each.code.as_str()).collect();
            let found = found.join("+");
            (found != codes).then(|| format!("expected {codes}, found '{found}'\n{rendered}"))
        }
        None if !diags.is_empty() => Some(rendered),
        None => match format(&block.text) {
            Ok(canonical) if canonical == block.text => None,
            Ok(canonical) => Some(format!("'afpc fmt' writes it so:\n{canonical}")),
            Err(_) => Some("it cannot be formatted".to_owned()),
        },
    }
}

/// The reason why a fragment fits no frame.
fn fragment(text: &str) -> Option<String> {
    let fits = |(before, after): &(&str, &str)| {
        let mut diags = Diagnostics::default();
        parse(&format!("{before}{text}{after}"), 0, &mut diags);
        diags.is_empty()
    };
    (!FRAMES.iter().any(fits)).then(|| "the fragment fits nowhere".to_owned())
}

fn is_toolbox(text: &str) -> bool {
    text.lines().any(|line| line.starts_with("toolbox "))
}
