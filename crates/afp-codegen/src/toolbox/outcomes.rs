//! The states or events of a template as an enum with their outputs.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::{Parameters, bound, type_paths, words};
use crate::layout::doc;
use crate::names::{camel, ident, snake};
use afp_dsl::toolbox::{OutPort, Template};
use afp_dsl::types::{Dimension, Type};

pub fn outcomes(core: &TokenStream, template: &Template) -> TokenStream {
    if template.states_of.is_some() {
        return positions(core);
    }
    let words = words(template.kind);
    let parameters = Parameters::of(template.outputs.iter().map(|port| &port.ty));
    let name = &words.outcome;
    let about = doc("", &format!("The {}, each with its outputs.", words.outcomes));
    let generics = parameters.owned_arguments();
    let derives = match (parameters.opaque, parameters.owns) {
        (true, _) => quote!(Clone),
        (false, true) => quote!(Clone, Debug, PartialEq),
        (false, false) => quote!(Clone, Copy, Debug, PartialEq),
    };
    let variants = (0..).zip(&template.outcomes).map(|(index, outcome)| {
        let help = doc(&outcome.doc, &format!("`{}`", outcome.name));
        let variant = ident(&camel(&outcome.name));
        let fields = outputs(template, index).map(|(_, port)| field(core, port));
        let fields: Vec<_> = fields.collect();
        if fields.is_empty() {
            quote!(#help #variant,)
        } else {
            quote!(#help #variant { #(#fields)* },)
        }
    });
    let implemented = implement(core, template, name, parameters);
    quote! {
        #about
        #[derive(#derives)]
        pub enum #name #generics {
            #(#variants)*
        }

        #implemented
    }
}

/// The states of a template with one state for each value of an enum.
fn positions(core: &TokenStream) -> TokenStream {
    let about = doc("", "The state: the value's position in its enum.");
    quote! {
        #about
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct State(pub u16);

        impl #core::rt::Outcome for State {
            #[inline]
            fn index(&self) -> u16 {
                self.0
            }

            fn give(self, _: &mut dyn #core::rt::Outputs) {}
        }
    }
}

/// The outputs of an outcome, with their positions among all outputs.
pub fn outputs(template: &Template, outcome: u16) -> impl Iterator<Item = (u16, &OutPort)> {
    let all = (0..).zip(&template.outputs);
    all.filter(move |(_, port)| port.on.is_empty() || port.on.contains(&outcome))
}

fn field(core: &TokenStream, port: &OutPort) -> TokenStream {
    let (name, ty) = (ident(&snake(&port.name)), type_paths(core).value(&port.ty));
    let facts = format!("`{}`", port.ty);
    let help = if port.doc.is_empty() { facts } else { format!("{}\n\n{facts}", port.doc) };
    let help = doc(&help, "");
    quote!(#help #name: #ty,)
}

fn implement(
    core: &TokenStream,
    template: &Template,
    name: &Ident,
    parameters: Parameters,
) -> TokenStream {
    let bound = bound(template).filter(|_| parameters.generic);
    let generics = bound.map(|bound| quote!(<V: #core::rt::#bound>));
    let arguments = parameters.owned_arguments();
    let indexed = (0..).zip(&template.outcomes).map(|(index, outcome)| {
        let (variant, number) = (ident(&camel(&outcome.name)), Literal::u16_unsuffixed(index));
        let rest = outputs(template, index).next().map(|_| quote!({ .. }));
        quote!(#name::#variant #rest => #number,)
    });
    let given = (0..).zip(&template.outcomes).map(|(index, outcome)| {
        let variant = ident(&camel(&outcome.name));
        let ports: Vec<_> = outputs(template, index).collect();
        let fields = ports.iter().map(|(number, port)| {
            let (name, local) = (ident(&snake(&port.name)), local(*number));
            quote!(#name: #local)
        });
        let fields = (!ports.is_empty()).then(|| quote!({ #(#fields),* }));
        let gives = ports.iter().map(|(number, port)| give(core, *number, port));
        quote!(#name::#variant #fields => { #(#gives)* })
    });
    let silent = template.outputs.is_empty();
    let to = if silent { quote!(_) } else { quote!(to) };
    let body = (!silent).then(|| quote!(match self { #(#given)* }));
    quote! {
        impl #generics #core::rt::Outcome for #name #arguments {
            #[inline]
            fn index(&self) -> u16 {
                match *self { #(#indexed)* }
            }

            fn give(self, #to: &mut dyn #core::rt::Outputs) {
                #body
            }
        }
    }
}

/// The local for an output: its own name could hide a called function.
fn local(number: u16) -> Ident {
    format_ident!("value_{number}")
}

/// Passes on one output.
fn give(core: &TokenStream, number: u16, port: &OutPort) -> TokenStream {
    let (name, number) = (local(number), Literal::u16_unsuffixed(number));
    match &port.ty {
        Type::Bool => quote!(to.bool(#number, #name);),
        Type::Int => quote!(to.int(#number, #name);),
        Type::Quantity(Dimension::NONE) => quote!(to.float(#number, #name);),
        Type::Quantity(_) => quote!(to.float(#number, #name.si());),
        Type::Text => quote!(to.text(#number, &#name);),
        Type::Enum(_) => quote!(to.choice(#number, #core::rt::Choice::index(#name));),
        Type::Object(_) => quote!(to.object(#number, &mut Some(#name));),
        Type::Any | Type::Number | Type::Discrete => {
            quote!(to.value(#number, #core::rt::Stored::to_value(&#name));)
        }
    }
}
