//! What stands between the brackets: `["path of afp_core",] "file"`.

use proc_macro2::{Literal, TokenStream, TokenTree};
use quote::quote;

/// The arguments of a macro.
pub struct Input {
    /// The path of `afp_core`, which a crate that re-exports it passes.
    pub core: TokenStream,
    /// The file, as written.
    pub path: String,
}

/// Reads `"file"`, or `path::of::core, "file"`.
///
/// # Errors
/// A compile error that says what is expected.
pub fn parse(input: TokenStream) -> Result<Input, TokenStream> {
    let mut tokens: Vec<TokenTree> = input.into_iter().collect();
    if is_comma(tokens.last()) {
        tokens.pop();
    }
    let path = match tokens.pop() {
        Some(TokenTree::Literal(literal)) => text(&literal),
        Some(TokenTree::Group(group)) => {
            group.stream().into_iter().next().and_then(|token| match token {
                // A literal that has come through another macro.
                TokenTree::Literal(literal) => text(&literal),
                _ => None,
            })
        }
        _ => None,
    };
    let core = match tokens.pop() {
        None => quote!(::afp_core),
        comma if is_comma(comma.as_ref()) => tokens.into_iter().collect(),
        Some(_) => return Err(super::error("expected a file name in quotes")),
    };
    match path {
        Some(path) => Ok(Input { core, path }),
        None => Err(super::error("expected a file name in quotes")),
    }
}

fn is_comma(token: Option<&TokenTree>) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == ',')
}

/// The text of a plain string literal; a path has no use for escapes but `\\`.
fn text(literal: &Literal) -> Option<String> {
    let text = literal.to_string();
    let inner = text.strip_prefix('"')?.strip_suffix('"')?;
    Some(inner.replace("\\\\", "\\"))
}
