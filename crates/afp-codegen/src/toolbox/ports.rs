//! The inputs of a template as structs, with their checks and their computation from formulas.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::{Parameters, bound, inputs as read_once, live as read_live, type_paths};
use crate::layout::doc;
use crate::names::{ident, snake};
use crate::rust_type::{degrees, int};
use afp_dsl::toolbox::{Constant, InPort, Template};
use afp_dsl::types::{Dimension, Type};

pub fn inputs(core: &TokenStream, template: &Template) -> TokenStream {
    let ports: Vec<_> = read_once(template).collect();
    structure(core, template, "Inputs", "The inputs that are read before the start.", &ports)
}

pub fn live(core: &TokenStream, template: &Template) -> TokenStream {
    let ports: Vec<_> = read_live(template).collect();
    structure(core, template, "Live", "The inputs that are read again at every poll.", &ports)
}

fn structure(
    core: &TokenStream,
    template: &Template,
    name: &str,
    about: &str,
    ports: &[(u16, &InPort)],
) -> TokenStream {
    let parameters = Parameters::of(ports.iter().map(|(_, port)| &port.ty));
    let (name, about, generics) = (ident(name), doc("", about), parameters.arguments());
    let derives = if parameters.opaque { quote!(Clone, Copy) } else { quote!(Clone, Copy, Debug) };
    let fields = ports.iter().map(|(_, port)| field(core, port));
    let checks = implement_ports(core, template, &name, parameters, ports);
    let pulled = implement_from_args(core, &name, parameters, ports);
    quote! {
        #about
        #[derive(#derives)]
        pub struct #name #generics {
            #(#fields)*
        }

        #checks
        #pulled
    }
}

fn field(core: &TokenStream, port: &InPort) -> TokenStream {
    let name = ident(&snake(&port.name));
    let ty = match &port.ty {
        Type::Text => quote!(&'a str),
        Type::Object(_) => {
            let object = type_paths(core).value(&port.ty);
            quote!(&'a #object)
        }
        ty => type_paths(core).value(ty),
    };
    let help = doc(&help(port), "");
    quote!(#help pub #name: #ty,)
}

/// The help of a port with its type, range and default.
fn help(port: &InPort) -> String {
    let mut facts = vec![format!("`{}`", port.ty)];
    if let Some((least, greatest)) = port.range {
        facts.push(format!("from {} to {}", show(&port.ty, least), show(&port.ty, greatest)));
    }
    if let Some(default) = &port.default {
        facts.push(format!("{} if unbound", constant(&port.ty, default)));
    }
    let facts = facts.join("; ");
    if port.doc.is_empty() { facts } else { format!("{}\n\n{facts}", port.doc) }
}

/// A number of a port's type as readable text.
fn show(ty: &Type, value: f64) -> String {
    match ty {
        Type::Quantity(dimension) if *dimension != Dimension::NONE => {
            match degrees(*dimension, value) {
                Some(degrees) => format!("{degrees} {}", dimension.si_unit().replace("rad", "deg")),
                None => format!("{value} {}", dimension.si_unit()),
            }
        }
        _ => value.to_string(),
    }
}

fn constant(ty: &Type, value: &Constant) -> String {
    match (value, ty) {
        (Constant::Float(value), ty) => show(ty, *value),
        (Constant::Choice(index), Type::Enum(choices)) => {
            let name = choices.variants.get(usize::from(*index));
            format!("{}.{}", choices.name, name.map_or("", |name| name))
        }
        (value, _) => value.to_string(),
    }
}

fn implement_ports(
    core: &TokenStream,
    template: &Template,
    name: &proc_macro2::Ident,
    parameters: Parameters,
    ports: &[(u16, &InPort)],
) -> TokenStream {
    let checks = ports.iter().filter_map(|(index, port)| check(core, *index, port));
    let shown: Vec<_> =
        ports.iter().filter_map(|(index, port)| shown(core, *index, port)).collect();
    let see = if shown.is_empty() { quote!(_) } else { quote!(see) };
    let bound = bound(template).filter(|_| parameters.generic);
    let generics = bound.map(|bound| quote!(<V: #core::rt::#bound>));
    let arguments = match (parameters.borrows, parameters.generic) {
        (true, true) => quote!(<'_, V>),
        (true, false) => quote!(<'_>),
        (false, _) => parameters.arguments(),
    };
    quote! {
        impl #generics #core::rt::Ports for #name #arguments {
            #[inline]
            fn check(&self) -> Result<(), #core::rt::BadValue> {
                #(#checks)*
                Ok(())
            }

            fn each(&self, #see: &mut dyn FnMut(u16, #core::ValueRef<'_>)) {
                #(#shown)*
            }
        }
    }
}

/// Checks that a port's number is finite and in range.
fn check(core: &TokenStream, index: u16, port: &InPort) -> Option<TokenStream> {
    let (name, index) = (ident(&snake(&port.name)), Literal::u16_unsuffixed(index));
    match (&port.ty, port.range) {
        (Type::Int, Some((least, greatest))) => {
            let (least, greatest) = (int(least.ceil() as i64), int(greatest.floor() as i64));
            Some(quote!(#core::rt::within_int(#index, self.#name, #least, #greatest)?;))
        }
        (Type::Quantity(dimension), Some((least, greatest))) => {
            let si = (*dimension != Dimension::NONE).then(|| quote!(.si()));
            let type_paths = type_paths(core);
            let (least, greatest) =
                (type_paths.constant(*dimension, least), type_paths.constant(*dimension, greatest));
            Some(quote!(#core::rt::within(#index, self.#name #si, #least #si, #greatest #si)?;))
        }
        (Type::Quantity(_) | Type::Any | Type::Number | Type::Discrete, _) => {
            let value = quote!(#core::rt::Stored::as_value(&self.#name));
            Some(quote!(#core::rt::within_value(#index, #value)?;))
        }
        _ => None,
    }
}

/// Shows a port in the trace; an object appears with its writing commit, and not as an input.
fn shown(core: &TokenStream, index: u16, port: &InPort) -> Option<TokenStream> {
    let (name, index) = (ident(&snake(&port.name)), Literal::u16_unsuffixed(index));
    match port.ty {
        Type::Object(_) => None,
        Type::Text => Some(quote!(see(#index, #core::ValueRef::Text(self.#name));)),
        _ => Some(quote!(see(#index, #core::rt::Stored::as_value(&self.#name));)),
    }
}

fn implement_from_args(
    core: &TokenStream,
    name: &proc_macro2::Ident,
    parameters: Parameters,
    ports: &[(u16, &InPort)],
) -> TokenStream {
    let fields = ports.iter().map(|(index, port)| {
        let (name, value) = (ident(&snake(&port.name)), pull(core, *index, &port.ty));
        let index = Literal::u16_unsuffixed(*index);
        quote!(#name: #core::rt::input(#index, || Ok(#value))?)
    });
    let args = if ports.is_empty() { quote!(_) } else { quote!(args) };
    let arguments = match (parameters.borrows, parameters.generic) {
        (true, true) => quote!(<'a, #core::Value>),
        (false, true) => quote!(<#core::Value>),
        _ => parameters.arguments(),
    };
    quote! {
        impl<'a> #core::rt::FromArgs<'a> for #name #arguments {
            fn from_args(#args: &'a dyn #core::rt::Args) -> Result<Self, #core::rt::BadValue> {
                Ok(#name { #(#fields),* })
            }
        }
    }
}

/// The value of a port, from its formula.
fn pull(core: &TokenStream, index: u16, ty: &Type) -> TokenStream {
    let index = Literal::u16_unsuffixed(index);
    match ty {
        Type::Bool => quote!(args.bool(#index)?),
        Type::Int => quote!(args.int(#index)?),
        Type::Quantity(dimension) => {
            type_paths(core).quantity_from(*dimension, quote!(args.float(#index)?))
        }
        Type::Text => quote!(args.text(#index)?),
        Type::Enum(_) => quote! {
            #core::rt::Choice::from_index(args.choice(#index)?).ok_or(#core::Fault::INTERNAL)?
        },
        Type::Object(_) => quote! {
            args.object(#index)?.downcast_ref().ok_or(#core::Fault::INTERNAL)?
        },
        Type::Any | Type::Number | Type::Discrete => quote!(args.value(#index)?),
    }
}
