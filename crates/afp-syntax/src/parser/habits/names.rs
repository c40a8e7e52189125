//! Names with a '-', as in other languages.

use crate::diagnostics::{Code, Diagnostic};
use crate::keywords::{self, DECLARES};
use crate::kind::Kind;
use crate::message;
use crate::parser::Parser;

impl Parser<'_, '_> {
    /// `wall-dist`: the number of tokens of the name `ahead` tokens ahead, if '-' joins its parts
    /// without spaces.
    pub(in crate::parser) fn tokens_of_name(&self, ahead: usize) -> usize {
        let first = self.token_index(ahead);
        let mut tokens = 1;
        while self.nth(ahead + tokens) == Kind::Minus
            && matches!(self.nth(ahead + tokens + 1), Kind::Name | Kind::Int)
            && self.token_index(ahead + tokens + 1) == first + tokens + 1
        {
            tokens += 2;
        }
        tokens
    }

    /// Reports and takes a name with '-'. Returns whether it did.
    pub(in crate::parser) fn name_with_hyphens(&mut self) -> bool {
        let tokens = self.tokens_of_name(0);
        if !self.at(Kind::Name) || tokens == 1 {
            return false;
        }
        let parts: Vec<_> = (0..tokens).step_by(2).filter_map(|at| self.token(at)).collect();
        let parts: Vec<_> = parts.iter().map(|token| token.text).collect();
        let better = parts.join("_");
        let help = message!("write '{}' or '{}'", better, in_one_word(&parts));
        let error = Diagnostic::new(Code::E0102, self.ahead(tokens), "a name has no '-'");
        self.hyphens.insert(parts.join("-"));
        let declares = keywords::has(self.word_before(), DECLARES);
        let error = error.help(help);
        self.error(if declares { error.replace(better) } else { error });
        self.bump_together(tokens, Kind::Name);
        true
    }

    /// Whether a name with '-' is here that was read as a name before.
    pub(in crate::parser) fn has_hyphens_in_use(&self) -> bool {
        let tokens = self.tokens_of_name(0);
        tokens > 1 && self.hyphens.contains(&self.text_of(0, tokens))
    }

    /// Whether an edge begins here whose state or event has a '-' in its name.
    pub(in crate::parser) fn at_edge_with_hyphens(&self) -> bool {
        let tokens = self.tokens_of_name(0);
        self.at(Kind::Name) && tokens > 1 && self.nth(tokens) == Kind::Arrow
    }
}

/// `wallDist`
fn in_one_word(parts: &[&str]) -> String {
    let large = |part: &str| {
        let mut letters = part.chars();
        letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters).collect()
    };
    let rest: String = parts.iter().skip(1).map(|part| -> String { large(part) }).collect();
    parts.first().map_or_else(String::new, |first| format!("{first}{rest}"))
}
