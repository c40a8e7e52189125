//! The names that a text contains, so that made-up edits meet what is there.

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::{kind::Kind, parse};
use arbitrary::{Result, Unstructured};

/// How many are looked at.
const MOST: usize = 200;

/// Names to choose from.
pub struct Names(Vec<String>);

impl Names {
    /// Those of the text, and a few that mean something everywhere.
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

    /// One of them.
    pub fn choose(&self, bytes: &mut Unstructured<'_>) -> Result<String> {
        bytes.choose(&self.0).cloned()
    }

    /// One of them or none.
    pub fn maybe(&self, bytes: &mut Unstructured<'_>) -> Result<Option<String>> {
        if bytes.arbitrary()? { self.choose(bytes).map(Some) } else { Ok(None) }
    }
}
