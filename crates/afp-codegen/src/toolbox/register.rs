//! Registers the implementations of a toolbox for plans loaded at run time: all of them, or those
//! that a platform supports.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Expr, LitStr, Path, Token, Type, bracketed};

use super::{bound, implemented, words};
use crate::layout::doc;
use crate::names::{camel, ident, snake};
use afp_dsl::toolbox::{Template, TemplateKind, Toolbox};

pub fn register(core: &TokenStream, toolbox: &Toolbox) -> TokenStream {
    let about = doc("", "Names the Rust type of every template and object to a registry.");
    let bounds = implemented(toolbox).filter(|t| t.kind != TemplateKind::Computation);
    let bounds = bounds.map(|template| {
        let (marker, implementation) = types(core, &quote!(super), template);
        let component = implements(template);
        quote!(#implementation: #core::#component<self::#marker, E>,)
    });
    let templates = implemented(toolbox).map(|template| {
        let (marker, implementation) = types(core, &quote!(super), template);
        let method = ident(&snake(&implements(template).to_string()));
        let (toolbox, name) = (&toolbox.name, &template.name);
        quote!(registry.#method::<self::#marker, #implementation>(#toolbox, #name);)
    });
    let objects = toolbox.objects.iter().map(|object| {
        let (toolbox, name, ty) = (&toolbox.name, &object.name, ident(&camel(&object.name)));
        quote!(registry.object::<super::#ty>(#toolbox, #name);)
    });
    quote! {
        #about
        pub fn register<E, R>(registry: &mut R)
        where
            E: ?::core::marker::Sized,
            R: #core::rt::Registry<E>,
            #(#bounds)*
        {
            #(#templates)*
            #(#objects)*
        }
    }
}

/// A platform, and the parts for registering a toolbox with it. Written as `path of core, "file",
/// path of the implementation, registry, platform, [traits]`.
pub struct Support {
    pub core: TokenStream,
    /// The file of the toolbox, as in the source.
    pub file: String,
    /// The module with `templates` and the implementing types.
    pub module: TokenStream,
    /// The expression of the registry, a `&mut`.
    pub registry: TokenStream,
    /// The type of the platform.
    pub platform: TokenStream,
    /// The paths of the toolbox's required traits, for messages about missing ones; without them,
    /// messages name all traits in `toolbox!`.
    pub traits: Option<Vec<TokenStream>>,
}

impl Parse for Support {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let core = next(input, Path::parse_mod_style)?;
        let file = input.parse::<LitStr>()?.value();
        input.parse::<Token![,]>()?;
        let module = next(input, Path::parse_mod_style)?;
        let registry = next(input, Expr::parse)?;
        let platform = next(input, Type::parse)?;
        let list;
        bracketed!(list in input);
        let traits =
            Punctuated::<_, Token![,]>::parse_terminated_with(&list, Path::parse_mod_style)?;
        let traits = Some(traits.into_iter().map(ToTokens::into_token_stream).collect());
        Ok(Support { core, file, module, registry, platform, traits })
    }
}

/// The trait of a template's implementation.
fn implements(template: &Template) -> Ident {
    match (template.kind, template.resumable) {
        (TemplateKind::Actor, true) => ident("Resumable"),
        (kind, _) => words(kind).component,
    }
}

/// The tokens before the next comma.
fn next<T: ToTokens>(
    input: ParseStream<'_>,
    parse: fn(ParseStream<'_>) -> syn::Result<T>,
) -> syn::Result<TokenStream> {
    let tokens = parse(input)?.into_token_stream();
    input.parse::<Token![,]>()?;
    Ok(tokens)
}

/// Statements that register every template that a platform supports, and record the missing traits
/// of the others.
pub fn register_supported(toolbox: &Toolbox, support: &Support) -> TokenStream {
    let Support { core, module, registry, platform, traits, .. } = support;
    let missing = match traits {
        Some(traits) => {
            let missing = traits.iter().map(|path| missing(platform, path));
            quote!(&[#(#missing),*])
        }
        None => quote!(#module::templates::ASKED),
    };
    let templates = implemented(toolbox).map(|template| {
        let (marker, implementation) = types(core, module, template);
        let method = ident(&snake(&implements(template).to_string()));
        let (toolbox, name) = (&toolbox.name, &template.name);
        let types = quote!(#module::templates::#marker, #implementation);
        match template.kind {
            TemplateKind::Computation => quote! {
                #core::rt::Registry::<#platform>::#method::<#types>(registry, #toolbox, #name);
            },
            TemplateKind::Actor | TemplateKind::Supervisor => quote! {
                (&#core::rt::Probe::<#types, #platform>::NEW)
                    .#method(registry, (#toolbox, #name), missing);
            },
        }
    });
    let objects = toolbox.objects.iter().map(|object| {
        let (toolbox, name, ty) = (&toolbox.name, &object.name, ident(&camel(&object.name)));
        quote! {
            #core::rt::Registry::<#platform>::object::<#module::#ty>(registry, #toolbox, #name);
        }
    });
    quote! {{
        #[allow(unused_imports)]
        use #core::rt::{
            ActorSupported as _, ResumableSupported as _, SupervisorSupported as _,
            Unsupported as _,
        };
        #[allow(unused_variables)]
        let missing: &[&'static str] = #missing;
        let registry = &mut *#registry;
        #(#templates)*
        #(#objects)*
    }}
}

/// An expression: the name of a trait that the platform does not implement; empty if it does.
///
/// An inherent constant, which exists if the trait is implemented, has precedence over a trait's
/// constant.
fn missing(platform: &TokenStream, path: &TokenStream) -> TokenStream {
    let name = path.to_string();
    let name = name.rsplit(':').next().unwrap_or("").trim();
    quote! {{
        trait Absent {
            const NAME: &'static str = #name;
        }
        struct Of<T: ?Sized>(::core::marker::PhantomData<T>);
        impl<T: ?Sized> Absent for Of<T> {}
        #[allow(dead_code)]
        impl<T: ?Sized + #path> Of<T> {
            const NAME: &'static str = "";
        }
        <Of<#platform>>::NAME
    }}
}

/// The marker of a template and the type that implements it in a module, for plans loaded at run time.
fn types(
    core: &TokenStream,
    module: &TokenStream,
    template: &Template,
) -> (TokenStream, TokenStream) {
    let name = ident(&camel(&template.name));
    let generic = bound(template).map(|_| quote!(<#core::Value>));
    (quote!(#name #generic), quote!(#module::#name #generic))
}
