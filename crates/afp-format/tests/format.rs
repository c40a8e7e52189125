//! The canonical form: shipped files have it, and only white space and commas change.
//!
//! `AFP_BLESS=1` rewrites shipped plans and toolboxes; read the diff like code.

#[path = "format/mutate.rs"]
mod mutate;

use std::fs;
use std::path::{Path, PathBuf};

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::{kind::Kind, parse};
use proptest::prelude::*;

/// Folders of `.afp` files that serve as examples.
const FOLDERS: &[&str] =
    &["plans", "plans/parts", "crates/afp-toolboxes/toolboxes", "bench/plans", "bench/toolbox"];

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let mut files: Vec<_> =
        fs::read_dir(folder).unwrap().map(|each| each.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "afp"));
    files.sort();
    files
}

#[test]
fn shipped_files_are_formatted() {
    let mut wrong = Vec::new();
    for path in FOLDERS.iter().flat_map(|folder| files(folder)) {
        let text = fs::read_to_string(&path).unwrap();
        let formatted = afp_format::format(&text).unwrap_or_else(|_| panic!("{}", path.display()));
        if formatted == text {
            continue;
        }
        match std::env::var_os("AFP_BLESS") {
            Some(_) => fs::write(&path, formatted).unwrap(),
            None => wrong.push(path),
        }
    }
    assert!(wrong.is_empty(), "run 'afpc fmt' on {wrong:?}");
}

const SCENARIO: &str = "\
scenario \"bumps into a crate while searching\" for WallFollowing {
    world \"worlds/room_with_crate.toml\"
    robot at (0.5 m, 2 m) heading -(0 deg + 1 deg)
    at 2 s: press touch
    at 8 s: fail ultrasonic.frozen for 500 ms
    expect searchFirstWall -> backupCollision by touch within 3 ms after 2 s
    expect walldist == -25 cm always
    until 60 s
}
";

const CASES: &[&str] = &[
    include_str!("../../../plans/wall_following.afp"),
    include_str!("../../afp-dsl/tests/graph/sub_plans.afp"),
    include_str!("../../afp-dsl/tests/graph/conversions.afp"),
    include_str!("../../afp-dsl/tests/graph/on.afp"),
    SCENARIO,
    afp_toolboxes::ALL[0].text,
    afp_toolboxes::ALL[1].text,
];

/// Solid tokens without list commas, and comments, each in order.
fn content(text: &str) -> (Vec<String>, Vec<String>) {
    let root = parse(text, 0, &mut Diagnostics::default()).root();
    let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    let tokens = tokens.filter(|token| !matches!(token.kind(), Kind::Whitespace | Kind::Comma));
    let (comments, solid): (Vec<_>, Vec<_>) = tokens.partition(|token| token.kind().is_trivia());
    let texts = |tokens: Vec<afp_syntax::Token>| {
        tokens.into_iter().map(|token| token.text().trim_end().to_owned()).collect()
    };
    (texts(solid), texts(comments))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn formatting_is_idempotent_and_keeps_tokens_and_comments(
        which in 0..CASES.len(),
        seeds in prop::collection::vec(any::<u8>(), 1..400),
    ) {
        let text = mutate::mutated(CASES[which], &seeds);
        if let Ok(once) = afp_format::format(&text) {
            let twice = afp_format::format(&once).unwrap();
            prop_assert_eq!(&twice, &once);
            prop_assert_eq!(content(&once), content(&text));
        }
    }

    /// Replaces a piece of a text with a piece of another.
    #[test]
    fn any_valid_patchwork_is_formatted_in_one_pass(
        bases in any::<(prop::sample::Index, prop::sample::Index)>(),
        places in any::<(u16, u16)>(),
        lengths in (0..40_usize, 0..60_usize),
    ) {
        let chars = |base: prop::sample::Index| CASES[base.index(CASES.len())].chars().collect::<Vec<_>>();
        let (mut text, other) = (chars(bases.0), chars(bases.1));
        let from = usize::from(places.0) % (text.len() + 1);
        let there = usize::from(places.1) % (other.len() + 1);
        let piece = other[there..].iter().take(lengths.1).copied();
        text.splice(from..(from + lengths.0).min(text.len()), piece);
        let text: String = text.into_iter().collect();
        if let Ok(once) = afp_format::format(&text) {
            prop_assert_eq!(&afp_format::format(&once).unwrap(), &once);
            prop_assert_eq!(content(&once), content(&text));
        }
    }
}
