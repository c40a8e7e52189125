//! Foldable ranges: bodies, brackets, blocks of comments and of `use` lines.

use crate::View;
use crate::view::token;
use afp_syntax::kind::Kind;
use afp_syntax::source::Span;
use afp_syntax::{Node, Token};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fold {
    /// From the first hidden byte to the last.
    pub span: Span,
    pub kind: FoldKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FoldKind {
    Body,
    Comment,
    Uses,
}

/// Returns all folds in source order.
pub fn folds(view: &View) -> Vec<Fold> {
    let mut folds: Vec<_> =
        view.root().descendants().filter_map(|node| body(view, &node)).collect();
    folds.extend(comments(view));
    folds.extend(uses(view));
    folds.retain(|fold| view.text_of(fold.span).trim_end().contains('\n'));
    folds.sort_unstable();
    folds
}

fn body(view: &View, node: &Node) -> Option<Fold> {
    let pairs = [
        (Kind::OpenBrace, Kind::CloseBrace),
        (Kind::OpenParen, Kind::CloseParen),
        (Kind::OpenBracket, Kind::CloseBracket),
    ];
    let (open, close) =
        pairs.iter().find_map(|(open, close)| Some((token(node, *open)?, token(node, *close)?)))?;
    let span = view.token_span(&open).after().to(view.token_span(&close).before());
    Some(Fold { span, kind: FoldKind::Body })
}

/// Consecutive lines of comments without a blank line.
fn comments(view: &View) -> Vec<Fold> {
    let tokens = view.root().descendants_with_tokens().filter_map(|each| each.into_token());
    let mut blocks: Vec<Span> = Vec::new();
    let mut open = false;
    for token in tokens {
        match token.kind() {
            Kind::Whitespace => open &= token.text().matches('\n').count() < 2,
            Kind::Comment | Kind::Doc if !begins_line(&token) => open = false,
            Kind::Comment | Kind::Doc => {
                let span = view.token_span(&token);
                match blocks.last_mut().filter(|_| open) {
                    Some(block) => *block = block.to(span),
                    None => blocks.push(span),
                }
                open = true;
            }
            _ => open = false,
        }
    }
    blocks.into_iter().map(|span| Fold { span, kind: FoldKind::Comment }).collect()
}

fn begins_line(token: &Token) -> bool {
    token.prev_token().is_none_or(|before| before.text().contains('\n'))
}

fn uses(view: &View) -> Vec<Fold> {
    let mut blocks: Vec<Span> = Vec::new();
    let mut open = false;
    for item in view.root().children() {
        if item.kind() != Kind::Use {
            open = false;
            continue;
        }
        let span = view.node_span(&item);
        match blocks.last_mut().filter(|_| open) {
            Some(block) => *block = block.to(span),
            None => blocks.push(span),
        }
        open = true;
    }
    blocks.into_iter().map(|span| Fold { span, kind: FoldKind::Uses }).collect()
}
