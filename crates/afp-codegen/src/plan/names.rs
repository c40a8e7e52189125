//! The names that a trace shows, with all sub-plans unfolded.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::context::Context;
use super::shared::units_name;
use crate::layout::doc;
use crate::rust_type::float;
use afp_dsl::graph::{EntryKind, Graph, PlanId};
use afp_dsl::types::{Dimension, Type};
use afp_dsl::unfold::{ComponentNames, EntryNames, Kind, unfold};

/// The table of names, and access by name.
pub fn names(context: &Context<'_>, id: PlanId) -> TokenStream {
    let all = unfold(&Graph { main: id, ..context.graph.clone() });
    let components = all.components.iter().map(component);
    let entries = all.entries.iter().map(entry);
    let (ty, access) = (&context.ty, access(context));
    let about = doc("", "The names behind the ids of a trace.");
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

/// The units in which texts give entries their values.
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

fn component(names: &ComponentNames) -> TokenStream {
    let ComponentNames { path, kind, template, outcomes, special, inputs } = names;
    let kind = match kind {
        Kind::Plan => quote!(Plan),
        Kind::Actor => quote!(Actor),
        Kind::Computation => quote!(Computation),
        Kind::SubPlan => quote!(SubPlan),
        Kind::Supervisor => quote!(Supervisor),
    };
    let outcomes = outcomes.iter().map(|(name, target)| quote!((#name, #target)));
    quote! {
        ComponentRow::new(
            #path, Kind::#kind, #template, &[#(#outcomes),*], #special, &[#(#inputs),*],
        )
    }
}

fn entry(names: &EntryNames) -> TokenStream {
    let EntryNames { path, kind, ty, range, .. } = names;
    let kind = match kind {
        EntryKind::In => quote!(In),
        EntryKind::Out => quote!(Out),
        EntryKind::Var => quote!(Var),
        EntryKind::Const => quote!(Const),
    };
    let unit = match ty {
        Type::Quantity(dimension) => dimension.si_unit(),
        _ => String::new(),
    };
    let choices = match ty {
        Type::Enum(choices) => choices.variants.as_slice(),
        _ => &[],
    };
    let ty = ty.to_string();
    let within = range.map(|(least, greatest)| {
        let (least, greatest) = (float(least), float(greatest));
        quote!(.within(#least, #greatest))
    });
    quote!(EntryRow::new(#path, EntryKind::#kind, #ty, #unit, &[#(#choices),*]) #within)
}
