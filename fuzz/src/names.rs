//! The names in a text, so that random edits refer to existing items.

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::{kind::Kind, parse};
use arbitrary::{Result, Unstructured};

/// The limit of names.
const MOST: usize = 200;

/// Names to choose from.
pub struct Names(Vec<String>);

impl Names {
    /// The names in the text, and a few with a general meaning.
    pub fn of(text: &str) -> Names {
        let root = parse(text, 0, &mut Diagnostics::default()).root();
        let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
        let names = tokens.filter(|token| token.kind() == Kind::Name);
        let mut names: Vec<_> = names.map(|token| token.text().to_owned()).take(MOST).collect();
        names
            .extend(["terminate", "ignore", "start", "fresh", "Fresh", "1x", ""].map(String::from));
        names.sort();
        names.dedup();
        Names(names)
    }

    pub fn choose(&self, bytes: &mut Unstructured<'_>) -> Result<String> {
        bytes.choose(&self.0).cloned()
    }

    pub fn maybe(&self, bytes: &mut Unstructured<'_>) -> Result<Option<String>> {
        if bytes.arbitrary()? { self.choose(bytes).map(Some) } else { Ok(None) }
    }
}
