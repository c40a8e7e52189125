//! The README's plan, drawing and links are correct.

use std::path::{Path, PathBuf};

use afp_draw::Options;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_dsl::toolbox::Toolbox;
use afp_syntax::source::Source;

const README: &str = include_str!("../../README.md");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The first plan of a page.
fn plan(page: &str) -> &str {
    let (_, rest) = page.split_once("```afp\n").expect("the page has a plan");
    &rest[..rest.find("\n```").expect("the block ends") + 1]
}

#[test]
fn the_readme_shows_the_plan_of_the_introduction() {
    assert_eq!(plan(README), plan(include_str!("../../docs/introduction.md")));
}

#[test]
fn drawings_of_pages_are_up_to_date() {
    let paused = include_str!("../../crates/afp-draw/tests/draw/paused.afp");
    is_drawn("careful", plan(README));
    is_drawn("handler", paused);
}

/// Compares a picture of the book with the drawing of a plan.
fn is_drawn(name: &str, plan: &str) {
    let file = root().join(format!("docs/images/{name}.svg"));
    let source = Source::new("plan.afp", plan);
    let compiled = compile(&source, &afp_toolboxes::sources().collect(), &Texts::default());
    let icons = |_: &Toolbox, name: &str| afp_toolboxes::icon(name).map(str::to_owned);
    let options = Options { icons: Some(&icons), ..Options::default() };
    let drawing = afp_draw::svg(&compiled.outline, &options);
    if std::env::var_os("AFP_BLESS").is_some() {
        std::fs::write(&file, &drawing).unwrap();
    }
    assert!(std::fs::read_to_string(&file).unwrap_or_default() == drawing, "AFP_BLESS=1 draws it");
}

#[test]
fn links_of_the_readme_have_targets() {
    let root = root();
    let links = README.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    for (link, _) in links.filter(|(link, _)| !link.starts_with("http")) {
        let (path, heading) = link.split_once('#').unwrap_or((link, ""));
        assert!(root.join(path).exists(), "{link}");
        if !heading.is_empty() {
            let page = std::fs::read_to_string(root.join(path)).unwrap();
            let titles = page
                .lines()
                .filter_map(|line| Some(line.strip_prefix('#')?.trim_start_matches('#')));
            let slugs = titles.map(|title| title.trim().to_lowercase().replace(' ', "-"));
            assert!(slugs.into_iter().any(|slug| slug == heading), "{link}");
        }
    }
}
