//! The spaces between two tokens of one item.

use afp_syntax::Token;
use afp_syntax::kind::Kind;

/// Whether there is a space between two neighbours on a line.
pub(super) fn is_apart(before: &Token, next: &Token) -> bool {
    let of_type = |token: &Token| matches!(parent(token), Kind::Type | Kind::Factor);
    match (before.kind(), next.kind()) {
        (Kind::OpenParen | Kind::Dot | Kind::Caret, _) => false,
        (_, Kind::CloseParen | Kind::Dot | Kind::Comma | Kind::Colon | Kind::Caret) => false,
        (_, Kind::OpenParen) => match parent(next) {
            Kind::Args | Kind::Call | Kind::Columns | Kind::Fault => false,
            _ => !is_sign(before),
        },
        (Kind::Star | Kind::Slash | Kind::Minus, _) if of_type(before) => false,
        (_, Kind::Star | Kind::Slash) if of_type(next) => false,
        _ => !is_sign(before),
    }
}

/// Whether a token is the minus of a negation.
fn is_sign(token: &Token) -> bool {
    token.kind() == Kind::Minus && parent(token) == Kind::Negation
}

fn parent(token: &Token) -> Kind {
    token.parent().map_or(Kind::File, |node| node.kind())
}
