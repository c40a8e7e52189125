//! The function that names every implementation of a toolbox to those who load plans.

use proc_macro2::TokenStream;
use quote::quote;

use super::{bound, words};
use crate::layout::doc;
use crate::names::{camel, ident, snake};
use afp_dsl::toolbox::{Template, TemplateKind, Toolbox};

/// `register`, for every platform that all components of the toolbox accept.
pub fn register(core: &TokenStream, toolbox: &Toolbox) -> TokenStream {
    let about = doc("", "Names the Rust type of every template and object to a registry.");
    let bounds = toolbox.templates.iter().filter(|t| t.kind != TemplateKind::Computation);
    let bounds = bounds.map(|template| {
        let (marker, implementation) = types(core, template);
        let component = words(template.kind).component;
        quote!(#implementation: #core::#component<#marker, E>,)
    });
    let templates = toolbox.templates.iter().map(|template| {
        let (marker, implementation) = types(core, template);
        let method = ident(&snake(&words(template.kind).component.to_string()));
        let (home, name) = (&toolbox.name, &template.name);
        quote!(registry.#method::<#marker, #implementation>(#home, #name);)
    });
    let objects = toolbox.objects.iter().map(|object| {
        let (home, name, ty) = (&toolbox.name, &object.name, ident(&camel(&object.name)));
        quote!(registry.object::<super::#ty>(#home, #name);)
    });
    quote! {
        #about
        pub fn register<E, R>(registry: &mut R)
        where
            E: ?Sized,
            R: #core::rt::Registry<E>,
            #(#bounds)*
        {
            #(#templates)*
            #(#objects)*
        }
    }
}

/// The marker of a template and the type that implements it, for plans loaded at run time.
fn types(core: &TokenStream, template: &Template) -> (TokenStream, TokenStream) {
    let name = ident(&camel(&template.name));
    let generic = bound(template).map(|_| quote!(<#core::Value>));
    (quote!(#name #generic), quote!(super::#name #generic))
}
