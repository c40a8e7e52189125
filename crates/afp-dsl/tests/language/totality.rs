//! For any text: no panic, a graph exactly if there are no errors, and every diagnostic can be
//! shown and has a help.

use std::sync::LazyLock;

use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_syntax::diagnostics::Severity;
use proptest::prelude::*;

use crate::{index, outline, support};

static TOOLBOXES: LazyLock<Toolboxes> = LazyLock::new(support::toolboxes);

static TEXTS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let folders = ["tests/errors", "tests/graph", "tests/toolboxes"];
    let cases = folders.iter().flat_map(|folder| support::files(folder));
    let cases = cases.map(|path| support::read(&path));
    cases.chain(afp_toolboxes::ALL.iter().map(|each| each.text.to_owned())).collect()
});

fn examine(text: &str) {
    let compiled = support::compile(text, &TOOLBOXES);
    let errors = compiled.diags.iter().any(|each| each.severity == Severity::Error);
    let toolbox = text.lines().any(|line| line.starts_with("toolbox "));
    assert!(toolbox || compiled.graph.is_none() == errors, "{}", compiled.render(false));
    for diagnostic in compiled.diags.iter() {
        assert!(!diagnostic.help_text().is_empty(), "{diagnostic:?}");
        assert!(compiled.sources.get(diagnostic.span.file).is_some(), "{diagnostic:?}");
        if let Some(fix) = &diagnostic.fix {
            let source = compiled.sources.get(fix.span.file).unwrap();
            let range = fix.span.start as usize..fix.span.end as usize;
            assert!(source.text.get(range).is_some(), "{diagnostic:?}");
        }
    }
    if !toolbox {
        outline::examine(&Texts::in_one(text).0, &compiled);
        index::examine(&Texts::in_one(text).0, &compiled);
    }
    if let Some(graph) = &compiled.graph {
        graph.dump();
    }
    assert!(compiled.render(true).len() >= compiled.diags.len());
    assert_eq!(compiled.diags.json_lines(&compiled.sources).lines().count(), compiled.diags.len());
}

#[test]
fn every_prefix_of_a_toolbox_is_checked() {
    let devices = support::read(
        &support::files("tests/errors")
            .into_iter()
            .find(|path| path.ends_with("devices.afp"))
            .unwrap(),
    );
    let carbot = afp_toolboxes::ALL.iter().find(|each| each.name == "carbot").unwrap().text;
    // The devices come first.
    let end = carbot.find("actor Forward").unwrap();
    for text in [&devices, &carbot[..end]] {
        let places = text.char_indices().map(|(at, _)| at).filter(|at| at % 3 == 0);
        places.for_each(|at| examine(&text[..at]));
    }
}

proptest! {
    #[test]
    fn any_text_is_checked(text in any::<String>()) {
        examine(&text);
    }

    /// Replaces a piece of a text by a piece of another.
    #[test]
    fn any_patchwork_is_checked(
        base in any::<prop::sample::Index>(),
        patches in prop::collection::vec(
            (any::<prop::sample::Index>(), any::<(u16, u16)>(), (0..40_usize, 0..60_usize)), 1..6)
    ) {
        let mut text: Vec<char> = base.get(&TEXTS).chars().collect();
        for (from, (here, there), (cut, taken)) in patches {
            let other: Vec<char> = from.get(&TEXTS).chars().collect();
            let start = usize::from(there) % (other.len() + 1);
            let piece = other[start..].iter().take(taken).copied();
            let place = usize::from(here) % (text.len() + 1);
            let end = (place + cut).min(text.len());
            text.splice(place..end, piece);
        }
        examine(&text.into_iter().collect::<String>());
    }
}
