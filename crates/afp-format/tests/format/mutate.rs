//! Plans in many forms: with other white space, commas and comments between the tokens.

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::{Token, kind::Kind, parse};

/// The text in another form: the same names, numbers and signs in the same order.
///
/// Every comment occurs once. The form may have syntax errors, but most forms have none.
pub fn mutated(text: &str, seeds: &[u8]) -> String {
    let root = parse(text, 0, &mut Diagnostics::default()).root();
    let mut mutated = String::new();
    let mut seeds = seeds.iter().cycle();
    let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    for (place, token) in tokens.enumerate() {
        let seed = seeds.next().copied().unwrap_or(0);
        match token.kind() {
            Kind::Whitespace if begins_item(&token) => {
                mutated += &between_items(&token, seed, place);
            }
            Kind::Whitespace if may_break(&token) => mutated += &within_item(seed, place),
            Kind::Comment | Kind::Doc => mutated += &format!("{} {place}\n", token.text()),
            _ => mutated += token.text(),
        }
    }
    mutated
}

fn between_items(gap: &Token, seed: u8, place: usize) -> String {
    let before = gap.prev_token().map(|token| token.kind());
    let comma = !matches!(
        before,
        None | Some(Kind::Comma | Kind::OpenBrace | Kind::OpenParen | Kind::Comment | Kind::Doc)
    );
    match seed % 24 {
        0 => format!(" // beside {place}\n"),
        1 => format!("\n    // above {place}\n"),
        2 => format!("\n\n// free {place}\n\n"),
        3 => format!("\n/// help {place}\n"),
        4 => format!("  // beside {place}\n    // above {place}\n"),
        5 => format!("\n\n\t// far above {place}\n\n\n// above {place}\n  "),
        6 => "\n\n\n".to_owned(),
        7 => "\t".to_owned(),
        8 if comma => ",\n  ".to_owned(),
        9 if comma => format!(", // behind a comma {place}\n"),
        10 if comma => format!(" // before a comma {place}\n, "),
        11..14 => "\n".to_owned(),
        14..17 => " ".to_owned(),
        _ => gap.text().to_owned(),
    }
}

fn within_item(seed: u8, place: usize) -> String {
    match seed % 40 {
        0 => format!(" // within {place}\n"),
        1 => format!("\n// within {place}\n"),
        2 => "\n\n".to_owned(),
        _ => " ".to_owned(),
    }
}

/// Whether an item begins, or a list ends, after white space.
fn begins_item(gap: &Token) -> bool {
    let Some(next) = next(gap) else { return false };
    if matches!(next.kind(), Kind::CloseBrace | Kind::CloseParen) {
        return true;
    }
    let Some(parent) = next.parent() else { return false };
    let items = [
        Kind::Plan,
        Kind::Entry,
        Kind::Start,
        Kind::Element,
        Kind::Guard,
        Kind::Reactions,
        Kind::Edge,
        Kind::BindIn,
        Kind::BindOut,
        Kind::Template,
        Kind::InPort,
        Kind::OutPort,
        Kind::Outcome,
        Kind::Device,
        Kind::Press,
        Kind::Fault,
        Kind::Signal,
        Kind::Expect,
        Kind::Stimulus,
    ];
    let mut tokens = parent.descendants_with_tokens().filter_map(|each| each.into_token());
    let first = tokens.find(|token| !token.kind().is_trivia());
    items.contains(&parent.kind()) && first.as_ref() == Some(&next)
}

/// Whether a line may end here in the middle of an item.
fn may_break(gap: &Token) -> bool {
    let kinds = [Kind::Equal, Kind::FatArrow, Kind::OpenBrace, Kind::Plus, Kind::Star, Kind::Slash];
    next(gap).is_some_and(|next| kinds.contains(&next.kind()))
}

fn next(gap: &Token) -> Option<Token> {
    let mut next = gap.next_token();
    while let Some(token) = next {
        if !token.kind().is_trivia() {
            return Some(token);
        }
        next = token.next_token();
    }
    None
}
