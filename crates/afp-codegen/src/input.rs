//! What stands between the brackets of `plan!` and `toolbox!`.

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};
use syn::parse::{Parse, ParseStream};
use syn::{Ident, LitStr, Path, Token, braced};

use crate::layout::located;

/// `[path of core,] "file" [, toolboxes = { "file" => path of module, ... }]`.
pub struct MacroInput {
    /// The path of `afp_core`, which a crate that re-exports it passes.
    pub core: TokenStream,
    /// The file, as written.
    pub path: String,
    /// Where that stands.
    span: Span,
    /// Toolboxes that are not built in: the file and the path of the module that implements it.
    pub toolboxes: Vec<(String, String)>,
}

impl Parse for MacroInput {
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
        Ok(MacroInput { core, path, span, toolboxes })
    }
}

impl MacroInput {
    /// What was made of it, as if it stood where the file is named: else what is wrong with the Rust beside the macro
    /// would be shown inside of `afp`.
    ///
    /// # Errors
    /// Nothing could be made.
    pub fn located(
        &self,
        made: Result<TokenStream, TokenStream>,
    ) -> Result<TokenStream, TokenStream> {
        let at = Span::call_site().located_at(self.span);
        made.map(|tokens| located(tokens, at)).map_err(|wrong| located(wrong, at))
    }
}

fn toolbox(input: ParseStream<'_>) -> syn::Result<(String, String)> {
    let file = input.parse::<LitStr>()?.value();
    input.parse::<Token![=>]>()?;
    let module = input.call(Path::parse_mod_style)?;
    Ok((file, module.into_token_stream().to_string().replace(' ', "")))
}
