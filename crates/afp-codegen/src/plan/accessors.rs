//! Typed access for the code that starts the plan.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::context::Context;
use super::state::{entry_doc, is_open};
use crate::layout::{at, doc};
use crate::names::{UniqueNames, ident, shout, snake};
use crate::rust_type::float;
use afp_dsl::graph::{Entry, EntryKind};
use afp_dsl::types::Type;

/// The constructor, a getter for each entry, a setter for each `in` entry.
pub fn accessors(context: &Context<'_>) -> TokenStream {
    let ty = &context.ty;
    let new = doc("", "The plan, not yet started.");
    let mut names = UniqueNames::taken(["new", "default", "from", "into"]);
    let mut constants = UniqueNames::default();
    let typed: Vec<_> = (0..)
        .zip(&context.plan.entries)
        .filter(|(_, entry)| is_open(entry))
        .map(|(index, entry)| typed(context, entry, index, &constants.unique(shout(&entry.name))))
        .collect();
    let entries = context.plan.entries.iter().zip(&context.entries);
    let accessors = entries.map(|(entry, field)| {
        let get = ident(&names.unique(snake(&entry.name)));
        let get = getter(context, entry, field, &get);
        let set = (entry.kind == EntryKind::In).then(|| {
            let name = ident(&names.unique(format!("set_{}", snake(&entry.name))));
            setter(context, entry, field, &name)
        });
        quote!(#get #set)
    });
    quote! {
        impl #ty {
            #(#typed)*

            #new
            pub fn new() -> Self {
                Self::default()
            }

            #(#accessors)*
        }
    }
}

/// The constant for setting [`is_open`] entries.
fn typed(context: &Context<'_>, entry: &Entry, index: u16, name: &str) -> TokenStream {
    let (name, value) = (ident(name), context.value_type(&entry.ty));
    let help = doc("", &format!("The entry `{}`, for `Scheduler::set`.", entry.name));
    let (at, index) = (at(entry.span), Literal::u16_unsuffixed(index));
    quote! {
        #help
        #at
        pub const #name: TypedEntry<Self, #value> = TypedEntry::new(#index);
    }
}

fn getter(context: &Context<'_>, entry: &Entry, field: &Ident, name: &Ident) -> TokenStream {
    let (help, value) = (entry_doc(entry), context.value_type(&entry.ty));
    let at = at(entry.span);
    let (ty, body) = match entry.ty {
        Type::Text => (quote!(&str), quote!(value().map(|text| text.as_str()))),
        Type::Object(_) => (quote!(&#value), quote!(value().and_then(|object| object.get().ok()))),
        _ => (value, quote!(value().copied())),
    };
    quote! {
        #help
        #[doc = ""]
        #[doc = " `None` before the first write."]
        #at
        pub fn #name(&self) -> Option<#ty> {
            self.config.#field.#body
        }
    }
}

fn setter(context: &Context<'_>, entry: &Entry, field: &Ident, name: &Ident) -> TokenStream {
    let value = context.value_type(&entry.ty);
    let help = doc("", &format!("Sets `{}` before the start.", entry.name));
    let at = at(entry.span);
    let checked = match (&entry.ty, entry.range) {
        (_, Some((least, greatest))) => {
            let (least, greatest) = (float(least), float(greatest));
            let checked = quote!(limited(value, #least, #greatest).map_err(WriteError::of)?);
            Some((" [`WriteError::NotFinite`] or [`WriteError::Range`].", checked))
        }
        (Type::Quantity(_), None) => {
            let checked = quote!(finite(value).map_err(|_| WriteError::NotFinite)?);
            Some((" [`WriteError::NotFinite`].", checked))
        }
        _ => None,
    };
    match (&entry.ty, checked) {
        (_, Some((errors, checked))) => quote! {
            #help
            #[doc = ""]
            #[doc = " # Errors"]
            #[doc = #errors]
            #at
            pub fn #name(&mut self, value: #value) -> Result<(), WriteError> {
                let value = #checked;
                self.config.#field.set(value);
                Ok(())
            }
        },
        (Type::Object(_), None) => quote! {
            #help
            #at
            pub fn #name(&mut self, value: #value) {
                self.config.#field.set(Object::new(value));
            }
        },
        (_, None) => quote! {
            #help
            #at
            pub fn #name(&mut self, value: #value) {
                self.config.#field.set(value);
            }
        },
    }
}
