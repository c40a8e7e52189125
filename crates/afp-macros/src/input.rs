//! What stands between the brackets.

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};
use syn::parse::{Parse, ParseStream};
use syn::{Ident, LitStr, Path, Token, braced};

/// `[path of core,] "file" [, toolboxes = { "file" => path of module, ... }]`.
pub struct Input {
    /// The path of `afp_core`, which a crate that re-exports it passes.
    pub core: TokenStream,
    /// The file, as written.
    pub path: String,
    /// Where that stands.
    pub span: Span,
    /// Toolboxes that are not built in: the file and the path of the module that implements it.
    pub toolboxes: Vec<(String, String)>,
}

impl Parse for Input {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut core = quote!(::afp_core);
        if !input.peek(LitStr) && !input.is_empty() {
            core = input.call(Path::parse_mod_style)?.into_token_stream();
            input.parse::<Token![,]>()?;
        }
        let path = input.parse::<LitStr>()?;
        let (path, span) = (path.value(), path.span());
        let mut toolboxes = Vec::new();
        if input.parse::<Option<Token![,]>>()?.is_some() && !input.is_empty() {
            let word: Ident = input.parse()?;
            if word != "toolboxes" {
                return Err(syn::Error::new(word.span(), "expected 'toolboxes'"));
            }
            input.parse::<Token![=]>()?;
            let list;
            braced!(list in input);
            let list = list.parse_terminated(toolbox, Token![,])?;
            toolboxes.extend(list);
            input.parse::<Option<Token![,]>>()?;
        }
        Ok(Input { core, path, span, toolboxes })
    }
}

fn toolbox(input: ParseStream<'_>) -> syn::Result<(String, String)> {
    let file = input.parse::<LitStr>()?.value();
    input.parse::<Token![=>]>()?;
    let module = input.call(Path::parse_mod_style)?;
    Ok((file, module.into_token_stream().to_string().replace(' ', "")))
}
