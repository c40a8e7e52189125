//! The arguments of `plan!` and `toolbox!`.

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Ident, LitStr, Path, Token, Type, TypeParamBound, braced};

use crate::layout::located;
use crate::toolbox::Asked;

/// `[path of core,] "file"`, followed by
/// - for `plan!`: `[, toolboxes = { "file" => path of module, ... }]`,
/// - for `toolbox!`: `[, robot: Trait + ...]` or `[, robot = Type]`.
pub struct MacroInput {
    /// The path of `afp_core`, which a crate that re-exports it passes.
    pub core: TokenStream,
    /// The file, as in the source.
    pub path: String,
    /// The place of the file's name.
    span: Span,
    /// Toolboxes that are not built in: the file and the path of the module that implements it.
    pub toolboxes: Vec<(String, String)>,
    /// A toolbox's requirements for a robot, if given.
    pub robot: Option<Asked>,
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
        let (mut toolboxes, mut robot) = (Vec::new(), None);
        if input.parse::<Option<Token![,]>>()?.is_some() && !input.is_empty() {
            let word: Ident = input.parse()?;
            match &*word.to_string() {
                "toolboxes" => toolboxes = list(input)?,
                "robot" => robot = Some(asked(input)?),
                _ => {
                    let expected = "expected 'toolboxes' of a plan or 'robot' of a toolbox";
                    return Err(syn::Error::new(word.span(), expected));
                }
            }
            input.parse::<Option<Token![,]>>()?;
        }
        Ok(MacroInput { core, path, span, toolboxes, robot })
    }
}

impl MacroInput {
    /// Returns the result with spans at the file's name; otherwise rustc would report errors in the
    /// Rust code next to the macro inside of `afp`.
    ///
    /// # Errors
    /// No result could be made.
    pub fn located(
        &self,
        made: Result<TokenStream, TokenStream>,
    ) -> Result<TokenStream, TokenStream> {
        let at = Span::call_site().located_at(self.span);
        made.map(|tokens| located(tokens, at)).map_err(|wrong| located(wrong, at))
    }
}

/// `= { "file" => path of module, ... }`
fn list(input: ParseStream<'_>) -> syn::Result<Vec<(String, String)>> {
    input.parse::<Token![=]>()?;
    let list;
    braced!(list in input);
    Ok(list.parse_terminated(toolbox, Token![,])?.into_iter().collect())
}

/// `: Trait + ...` or `= Type`
fn asked(input: ParseStream<'_>) -> syn::Result<Asked> {
    if input.parse::<Option<Token![=]>>()?.is_some() {
        return Ok(Asked::Type(input.parse::<Type>()?.into_token_stream()));
    }
    input.parse::<Token![:]>()?;
    let traits = Punctuated::<TypeParamBound, Token![+]>::parse_separated_nonempty(input)?;
    Ok(Asked::Traits(traits.into_token_stream()))
}

fn toolbox(input: ParseStream<'_>) -> syn::Result<(String, String)> {
    let file = input.parse::<LitStr>()?.value();
    input.parse::<Token![=>]>()?;
    let module = input.call(Path::parse_mod_style)?;
    Ok((file, module.into_token_stream().to_string().replace(' ', "")))
}
