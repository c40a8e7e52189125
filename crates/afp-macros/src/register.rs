//! Registers the templates of a toolbox that a platform supports.

use afp_codegen::{Support, register_supported};
use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Expr, LitStr, Path, Token, Type, bracketed};

use crate::read_toolbox;

/// `path of core, "file", path of the implementation, registry, platform, [traits]`.
pub struct Input {
    file: String,
    support: Support,
}

impl Parse for Input {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let path = |input: ParseStream<'_>| -> syn::Result<TokenStream> {
            let path = input.call(Path::parse_mod_style)?.into_token_stream();
            input.parse::<Token![,]>()?;
            Ok(path)
        };
        let core = path(input)?;
        let file = input.parse::<LitStr>()?.value();
        input.parse::<Token![,]>()?;
        let home = path(input)?;
        let registry = input.parse::<Expr>()?.into_token_stream();
        input.parse::<Token![,]>()?;
        let platform = input.parse::<Type>()?.into_token_stream();
        input.parse::<Token![,]>()?;
        let list;
        bracketed!(list in input);
        let traits =
            Punctuated::<Path, Token![,]>::parse_terminated_with(&list, Path::parse_mod_style)?;
        let traits = traits.into_iter().map(ToTokens::into_token_stream).collect();
        Ok(Input { file, support: Support { core, home, registry, platform, traits } })
    }
}

/// The statements that register them.
///
/// # Errors
/// Compile errors: a toolbox file that cannot be read or is wrong.
pub fn statements(input: &Input) -> Result<TokenStream, TokenStream> {
    let (toolbox, errors, _) = read_toolbox(&input.file)?;
    if !errors.is_empty() {
        return Err(errors);
    }
    Ok(register_supported(&toolbox, &input.support))
}
