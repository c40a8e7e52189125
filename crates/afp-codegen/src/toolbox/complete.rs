//! A compile-time proof that every template of a toolbox is implemented.

use proc_macro2::TokenStream;
use quote::quote;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::{Token, TypeParamBound};

use super::{bound, words};
use crate::names::{camel, ident, snake};
use afp_dsl::toolbox::{Template, TemplateKind, Toolbox};

/// The requirements of a toolbox's templates for a robot.
pub enum Asked {
    /// The traits of a robot that can use all templates: `Lights + Wheels`.
    Traits(TokenStream),
    /// The only robot type of the implementations.
    Type(TokenStream),
}

impl Asked {
    fn names(&self) -> Vec<String> {
        let Asked::Traits(traits) = self else { return Vec::new() };
        let bounds = Punctuated::<TypeParamBound, Token![+]>::parse_terminated;
        let bounds = bounds.parse2(traits.clone()).unwrap_or_default();
        let names = bounds.iter().filter_map(|bound| match bound {
            TypeParamBound::Trait(of) => of.path.segments.last().map(|last| last.ident.to_string()),
            _ => None,
        });
        names.collect()
    }
}

/// A function that compiles if the Rust code implements every template for such a robot, and the
/// names of the required traits.
///
/// Generic code is compiled before its robot is known. Without this function, a missing
/// implementation would only appear when a plan is built.
pub fn complete(core: &TokenStream, toolbox: &Toolbox, asked: &Asked) -> TokenStream {
    let robot = match asked {
        Asked::Traits(_) => quote!(Robot),
        Asked::Type(robot) => robot.clone(),
    };
    let parameter = match asked {
        Asked::Traits(traits) if traits.is_empty() => quote!(<Robot: #core::Environment + ?Sized>),
        Asked::Traits(traits) => quote!(<Robot: #core::Environment + ?Sized + #traits>),
        Asked::Type(_) => TokenStream::new(),
    };
    let asserted = super::implemented(toolbox).map(|template| asserted(core, template, &robot));
    let names = asked.names();
    quote! {
        /// The traits that the templates ask of a robot.
        #[doc(hidden)]
        pub const ASKED: &[&str] = &[#(#names),*];

        #[allow(dead_code)]
        const _: () = {
            fn actor<T: #core::ActorTemplate, E: ?Sized, C: #core::Actor<T, E>>() {}
            fn supervisor<T: #core::SupervisorTemplate, E: ?Sized, C: #core::Supervisor<T, E>>() {}
            fn computation<T: #core::ComputationTemplate, C: #core::Computation<T>>() {}
            fn implemented #parameter () {
                #(#asserted)*
            }
        };
    }
}

/// The assertion that one template is implemented.
fn asserted(core: &TokenStream, template: &Template, robot: &TokenStream) -> TokenStream {
    let is = ident(&snake(&words(template.kind).component.to_string()));
    let name = ident(&camel(&template.name));
    let generic = bound(template).map(|_| quote!(<#core::Value>));
    let on = (template.kind != TemplateKind::Computation).then(|| quote!(#robot,));
    quote!(#is::<self::#name #generic, #on super::#name #generic>();)
}
