//! The names in a trace, with all sub-plans unfolded.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::context::Context;
use crate::layout::doc;
use crate::names::units_name;
use crate::rust_type::float;
use afp_dsl::graph::{EntryKind, Graph, PlanId};
use afp_dsl::types::{Dimension, Type};
use afp_dsl::unfold::{
    ComponentKind, ComponentNames, EntryNames, PlanTexts, PortNames, Reaction, TextPlace, unfold,
};

pub fn names(context: &Context<'_>, id: PlanId) -> TokenStream {
    let all = unfold(&Graph { main: id, ..context.graph.clone() });
    let components = all.components.iter().map(|names| component(names, &all.texts));
    let entries = all.entries.iter().map(|names| entry(names, &all.texts));
    let (ty, access) = (&context.ty, access(context));
    let about = doc("", "The names of the ids of a trace.");
    quote! {
        #about
        pub static NAMES: NameTable =
            NameTable { components: &[#(#components),*], entries: &[#(#entries),*] };

        impl NamedPlan for #ty {
            type Names = NameTable;

            fn names(&self) -> NameTable {
                NAMES
            }

            #access
        }
    }
}

fn access(context: &Context<'_>) -> TokenStream {
    let entries = || context.plan.entries.iter().zip(&context.entries).enumerate();
    let units: Vec<_> = entries()
        .filter_map(|(index, (entry, _))| match entry.ty {
            Type::Quantity(dimension) if dimension != Dimension::NONE => {
                let (index, units) = (Literal::usize_unsuffixed(index), units_name(dimension));
                let open = matches!(entry.kind, EntryKind::In | EntryKind::Var);
                open.then(|| quote!(#index => &super::units::#units,))
            }
            _ => None,
        })
        .collect();
    let (unit_of, units) = if units.is_empty() {
        (quote!(_), quote!(&[]))
    } else {
        (quote!(entry), quote!(match entry { #(#units)* _ => &[] }))
    };
    quote! {
        fn units(&self, #unit_of: u16) -> impl Iterator<Item = Unit<'_>> {
            let units: &[Unit<'static>] = #units;
            units.iter().copied()
        }
    }
}

fn component(names: &ComponentNames, texts: &PlanTexts) -> TokenStream {
    let ComponentNames { path, kind, template, outcomes, special, .. } = names;
    let kind = match kind {
        ComponentKind::Plan => quote!(Plan),
        ComponentKind::Actor => quote!(Actor),
        ComponentKind::Computation => quote!(Computation),
        ComponentKind::SubPlan => quote!(SubPlan),
        ComponentKind::Supervisor => quote!(Supervisor),
    };
    let outcome_names = outcomes.iter().map(|(name, _)| name);
    let outcomes = outcomes.iter().map(|(name, target)| quote!((#name, #target)));
    let inputs = names.inputs.iter().map(|names| port(names, texts));
    let writing = (!names.outputs.is_empty()).then(|| {
        let outputs = names.outputs.iter().map(|(position, names)| {
            let (row, entry) = (port(names, texts), &names.entry);
            let position = Literal::u16_unsuffixed(*position);
            quote!(#row.into(#position, #entry))
        });
        quote!(.writing(&[#(#outputs),*]))
    });
    let reactions = (!names.reactions.is_empty()).then(|| {
        let reactions = names.reactions.iter().map(|(each, target)| reaction(each, target));
        quote!(.reacting(&[#(#reactions),*]))
    });
    let states = (!names.states.is_empty()).then(|| {
        let states = outcome_names.zip(&names.states).map(|(name, span)| {
            let at = placed(texts.place(*span));
            quote!(PortRow::new(#name, "") #at)
        });
        quote!(.declared(&[#(#states),*]))
    });
    quote! {
        ComponentRow::new(
            #path, ComponentKind::#kind, #template, &[#(#outcomes),*], #special, &[#(#inputs),*],
        ) #writing #reactions #states
    }
}

/// A port and its binding.
fn port(names: &PortNames, texts: &PlanTexts) -> TokenStream {
    let PortNames { name, unit, .. } = names;
    let (ty, choices) = (names.ty.declared_name(), names.ty.choices());
    let of = (!ty.is_empty()).then(|| quote!(.of(#ty, &[#(#choices),*])));
    let (within, at) = (within(names.range), placed(texts.place(names.span)));
    quote!(PortRow::new(#name, #unit) #of #within #at)
}

fn within(range: Option<(f64, f64)>) -> Option<TokenStream> {
    range.map(|(least, greatest)| {
        let (least, greatest) = (float(least), float(greatest));
        quote!(.within(#least, #greatest))
    })
}

fn placed(place: Option<TextPlace<'_>>) -> Option<TokenStream> {
    place.map(|TextPlace { file, line, column }| {
        let [line, column] = [line, column].map(Literal::u32_unsuffixed);
        quote!(.at(#file, #line, #column))
    })
}

/// An edge of an element that replaces an edge of a global supervisor.
fn reaction(reaction: &Reaction, target: &str) -> TokenStream {
    let supervisor = Literal::u32_unsuffixed(reaction.supervisor);
    let event = match reaction.event.map(Literal::u16_unsuffixed) {
        Some(event) => quote!(Some(#event)),
        None => quote!(None),
    };
    quote!(Reaction::new(ComponentId(#supervisor), #event, #target))
}

fn entry(names: &EntryNames, texts: &PlanTexts) -> TokenStream {
    let EntryNames { path, kind, type_text, unit, range, .. } = names;
    let kind = match kind {
        EntryKind::In => quote!(In),
        EntryKind::Out => quote!(Out),
        EntryKind::Var => quote!(Var),
        EntryKind::Const => quote!(Const),
    };
    let choices = names.ty.choices();
    let (within, at) = (within(*range), placed(names.initial.and_then(|span| texts.place(span))));
    quote!(EntryRow::new(#path, EntryKind::#kind, #type_text, #unit, &[#(#choices),*]) #within #at)
}
