//! What stands between the brackets.

use std::iter::Peekable;

use proc_macro2::token_stream::IntoIter;
use proc_macro2::{Literal, TokenStream, TokenTree};
use quote::quote;

/// The arguments of a macro.
pub struct Input {
    /// The path of `afp_core`, which a crate that re-exports it passes.
    pub core: TokenStream,
    /// The file, as written.
    pub path: String,
    /// Toolboxes that are not built in: the file and the path of the module that implements it.
    pub toolboxes: Vec<(String, String)>,
}

/// Reads `[path of core,] "file" [, toolboxes = { "file" => path of module, ... }]`.
///
/// # Errors
/// What is expected.
pub fn parse(input: TokenStream) -> Result<Input, String> {
    let mut tokens = input.into_iter().peekable();
    let mut core = until(&mut tokens, is_literal);
    let path = next_text(&mut tokens)?;
    if core.is_empty() {
        core = quote!(::afp_core);
    } else {
        core = core.into_iter().filter(|token| !is_punct(token, ',')).collect();
    }
    let mut toolboxes = Vec::new();
    let option = until(&mut tokens, |token| matches!(token, TokenTree::Group(_))).to_string();
    match tokens.next() {
        None if option.is_empty() || option == "," => {}
        Some(TokenTree::Group(group)) if option.replace(' ', "") == ",toolboxes=" => {
            let mut inner = group.stream().into_iter().peekable();
            while inner.peek().is_some() {
                let file = next_text(&mut inner)?;
                let module = until(&mut inner, |token| is_punct(token, ','));
                inner.next();
                let module = module.to_string().replace(' ', "");
                let module = module.strip_prefix("=>").ok_or("expected '=>' and a path")?;
                toolboxes.push((file, module.to_owned()));
            }
        }
        _ => return Err("expected 'toolboxes = { \"file\" => module }'".to_owned()),
    }
    Ok(Input { core, path, toolboxes })
}

/// The tokens before the first that is wanted.
fn until(tokens: &mut Peekable<IntoIter>, wanted: impl Fn(&TokenTree) -> bool) -> TokenStream {
    let mut before = TokenStream::new();
    while let Some(token) = tokens.next_if(|token| !wanted(token)) {
        before.extend([token]);
    }
    before
}

fn is_punct(token: &TokenTree, wanted: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == wanted)
}

/// A literal, perhaps in the invisible brackets that another macro put around it.
fn is_literal(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Literal(_) | TokenTree::Group(_))
}

fn next_text(tokens: &mut Peekable<IntoIter>) -> Result<String, String> {
    let literal = match tokens.next() {
        Some(TokenTree::Group(group)) => group.stream().into_iter().next(),
        token => token,
    };
    let text = match literal {
        Some(TokenTree::Literal(literal)) => text(&literal),
        _ => None,
    };
    text.ok_or_else(|| "expected a file name in quotes".to_owned())
}

/// The text of a plain string literal; a path has no use for escapes but `\\`.
fn text(literal: &Literal) -> Option<String> {
    let text = literal.to_string();
    let inner = text.strip_prefix('"')?.strip_suffix('"')?;
    Some(inner.replace("\\\\", "\\"))
}
