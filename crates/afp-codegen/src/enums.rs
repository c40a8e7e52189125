//! Enums of toolboxes and plan files as Rust enums.

use std::sync::Arc;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use crate::layout::doc;
use crate::rust_type::variant;
use afp_dsl::types::Enum;

/// An enum of a plan file, with its Rust name.
pub type FileEnum = (Arc<Enum>, Ident);

/// The enum, under a Rust name, with all its trait implementations for entries and ports.
pub fn choices(core: &TokenStream, choices: &Enum, name: &Ident) -> TokenStream {
    let help = doc(&choices.doc, &format!("The enum `{}`.", choices.name));
    let indices = || 0..choices.variants.len() as u16;
    let variants: Vec<_> = indices().map(|index| variant(choices, index)).collect();
    let texts = &choices.variants;
    let docs = texts.iter().map(|text| doc("", &format!("`{text}`")));
    let defaults = indices().map(|index| (index == 0).then(|| quote!(#[default])));
    let numbers: Vec<_> = indices().map(Literal::u16_unsuffixed).collect();
    quote! {
        #help
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub enum #name {
            #(#docs #defaults #variants,)*
        }

        impl #core::rt::Choice for #name {
            const NAMES: &'static [&'static str] = &[#(#texts),*];

            fn index(self) -> u16 {
                match self {
                    #(#name::#variants => #numbers,)*
                }
            }

            fn from_index(index: u16) -> ::core::option::Option<Self> {
                match index {
                    #(#numbers => ::core::option::Option::Some(#name::#variants),)*
                    _ => ::core::option::Option::None,
                }
            }
        }

        impl #core::rt::Stored for #name {
            fn as_value(&self) -> #core::ValueRef<'_> {
                #core::ValueRef::Choice(#core::rt::Choice::index(*self))
            }
        }

        impl #core::rt::Any for #name {}
        impl #core::rt::Discrete for #name {}

        impl #core::rt::Writable for #name {
            fn from_value(value: &#core::Value) -> ::core::result::Result<Self, #core::WriteError> {
                match value {
                    #core::Value::Choice(index) => {
                        #core::rt::Choice::from_index(*index).ok_or(#core::WriteError::Type)
                    }
                    _ => ::core::result::Result::Err(#core::WriteError::Type),
                }
            }
        }
    }
}
