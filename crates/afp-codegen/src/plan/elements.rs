//! The first section: the elements, and their bindings to the configuration.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::bindings::{Bound, converted, limited, reads_entries, tried};
use super::context::{ComponentNames, Context};
use super::holder::Holder;
use crate::formula::{Formulas, is_literal};
use crate::layout::{at, comment, doc};
use afp_dsl::graph::{Component, Element, Entry, EntryKind, Formula, Plan, PlanId, TemplateId};
use afp_dsl::types::{Conversion, Dimension, Type};
use afp_types::ElementRow;

/// Numbers, the enum of the active element, and the bindings of each element.
pub fn elements(context: &Context<'_>) -> TokenStream {
    let numbers = (0..).zip(&context.elements).map(|(index, names)| {
        let (number, index) = (&names.number, Literal::u16_unsuffixed(index));
        quote!(const #number: ElementId = ElementId(#index);)
    });
    let active = Holder::all(context).into_iter().map(|holder| active(context, &holder));
    let rows = context.rows.elements.iter().zip(&context.elements);
    let bindings = context.plan.elements.iter().zip(rows).map(|(element, (row, names))| {
        match element.component {
            Component::Actor(id) | Component::Computation(id) => {
                let bound = bound(context, element, names, id);
                let is_actor = matches!(element.component, Component::Actor(_));
                let live = is_actor.then(|| bound.live().item);
                let (inputs, outputs) = (bound.inputs().item, bound.outputs().item);
                quote!(#inputs #live #outputs)
            }
            Component::SubPlan(id) => sub_plan(context, element, row, names, id),
        }
    });
    quote! {
        #(#numbers)*
        #(#active)*
        #(#bindings)*
    }
}

/// A template element for its bindings.
pub fn bound<'a>(
    context: &'a Context<'a>,
    element: &'a Element,
    names: &'a ComponentNames,
    id: TemplateId,
) -> Bound<'a> {
    Bound {
        context,
        names,
        template: context.template(id),
        paths: context.paths(id, element.generic.as_ref()),
        generic: element.generic.as_ref(),
        inputs: &element.inputs,
        outputs: &element.outputs,
        span: element.span,
    }
}

fn active(context: &Context<'_>, holder: &Holder) -> TokenStream {
    let variants = holder.elements(context).filter_map(|(element, names)| {
        let variant = &names.variant;
        let holds = match element.component {
            Component::Actor(id) => context.paths(id, element.generic.as_ref()).implementation,
            Component::SubPlan(id) => {
                let (module, ty) = context.child(id);
                quote!(Machine<super::#module::#ty>)
            }
            Component::Computation(_) => return None,
        };
        let note = comment(&description(context, element));
        let at = at(element.span);
        Some(quote!(#note #at #variant(#holds),))
    });
    let about = match (holder.handlers(), context.suspends()) {
        (true, _) => "The active handler.",
        (false, true) => "The active element, or the element that is set aside.",
        (false, false) => "The active element.",
    };
    let (about, ty) = (doc("", about), &holder.ty);
    quote! {
        #about
        #[derive(Clone, Default)]
        enum #ty {
            #[default]
            None,
            #(#variants)*
        }
    }
}

pub fn description(context: &Context<'_>, element: &Element) -> String {
    let (word, template) = match element.component {
        Component::Actor(id) => ("actor", &context.template(id).name),
        Component::Computation(id) => ("computation", &context.template(id).name),
        Component::SubPlan(id) => ("subplan", &context.graph.plan(id).name),
    };
    format!("{word} {}: {template}", element.name)
}

/// The start of a sub-plan's ids, its inputs and its results.
fn sub_plan(
    context: &Context<'_>,
    element: &Element,
    row: &ElementRow,
    names: &ComponentNames,
    id: PlanId,
) -> TokenStream {
    let (module, _) = context.child(id);
    let child = context.graph.plan(id);
    let fields = super::context::entry_names(child);
    let [components, entries] =
        [row.child.components, row.child.entries].map(Literal::u32_unsuffixed);
    let place = &names.place;
    let sets = given(context, element, child, &fields);
    let outs = child.entries.iter().zip(&fields).filter(|(entry, _)| entry.kind == EntryKind::Out);
    let gets: Vec<_> = (0..)
        .zip(outs)
        .filter_map(|(port, (entry, field))| result(context, element, port, entry, field))
        .collect();
    let at = at(element.span);
    let inputs = (!sets.is_empty()).then(|| {
        let (name, help) = (&names.inputs, doc("", &format!("Inputs of `{}`.", names.text)));
        let config = element.inputs.iter().any(reads_entries).then(|| quote!(config: &Config,));
        quote! {
            #help
            #at
            fn #name(#config to: &mut super::#module::Config) -> Result<(), BadValue> {
                #(#sets)*
                Ok(())
            }
        }
    });
    let outputs = (!gets.is_empty()).then(|| {
        let (name, help) = (&names.outputs, doc("", &format!("Results of `{}`.", names.text)));
        quote! {
            #help
            #at
            fn #name(staged: &mut Staged, from: &super::#module::Config) -> Result<(), BadValue> {
                #(#gets)*
                Ok(())
            }
        }
    });
    let live = live_item(context, element, child, names);
    let about = doc("", &format!("The first ids of `{}` begin.", names.text));
    quote! {
        #about
        #at
        const #place: Child = Child { components: #components, entries: #entries };
        #inputs
        #live
        #outputs
    }
}

/// A live input of a sub-plan that can change: its entry, by position and in Rust, and its value.
pub struct LiveInput<'a> {
    pub index: usize,
    /// Its position among the `in` entries.
    port: u16,
    pub entry: &'a Entry,
    pub field: proc_macro2::Ident,
    formula: &'a Formula,
}

/// The live inputs of a sub-plan that can change.
pub fn live_inputs<'a>(element: &'a Element, child: &'a Plan) -> Vec<LiveInput<'a>> {
    let fields = super::context::entry_names(child);
    let ins = child.entries.iter().zip(fields).enumerate();
    let ins = ins.filter(|(_, (entry, _))| entry.kind == EntryKind::In);
    let ins = (0..).zip(ins.zip(&element.inputs));
    let live = ins.map(|(port, ((index, (entry, field)), formula))| LiveInput {
        index,
        port,
        entry,
        field,
        formula,
    });
    live.filter(|it| it.entry.live && reads_entries(it.formula)).collect()
}

/// The function of a sub-plan's live inputs.
fn live_item(
    context: &Context<'_>,
    element: &Element,
    child: &Plan,
    names: &ComponentNames,
) -> Option<TokenStream> {
    let live = live_inputs(element, child);
    if live.is_empty() {
        return None;
    }
    let types = live.iter().map(|it| context.entry_type(&it.entry.ty));
    let values = live.iter().map(|it| passed(context, it.port, it.entry, it.formula));
    let (name, help) = (&names.live, doc("", &format!("Live inputs of `{}`.", names.text)));
    let at = at(element.span);
    Some(quote! {
        #help
        #at
        fn #name(config: &Config) -> Result<(#(#types,)*), BadValue> {
            Ok((#(#values,)*))
        }
    })
}

/// The value for an `in` entry of a sub-plan.
fn passed(context: &Context<'_>, port: u16, entry: &Entry, formula: &Formula) -> TokenStream {
    let value = context
        .with_type_paths(|type_paths| Formulas::new(type_paths, &context.entries).value(formula));
    let value = match (is_literal(formula.part()), entry.range, &formula.ty) {
        (true, ..) => value,
        (false, None, Type::Quantity(_)) => quote!(finite(#value)?),
        (false, ..) => limited(entry, value),
    };
    tried("input", port, value)
}

/// Sets the `in` entries of a sub-plan.
fn given(
    context: &Context<'_>,
    element: &Element,
    child: &Plan,
    fields: &[proc_macro2::Ident],
) -> Vec<TokenStream> {
    let ins = child.entries.iter().zip(fields).filter(|(entry, _)| entry.kind == EntryKind::In);
    let ins = (0..).zip(ins.zip(&element.inputs));
    let sets = ins.map(|(port, ((entry, field), formula))| {
        let value = passed(context, port, entry, formula);
        quote!(to.#field.set(#value);)
    });
    sets.collect()
}

/// Stages one result of a sub-plan, if it was written.
fn result(
    context: &Context<'_>,
    element: &Element,
    port: u16,
    entry: &Entry,
    field: &proc_macro2::Ident,
) -> Option<TokenStream> {
    let output = element.outputs.iter().find(|output| output.port == port)?;
    let to = &context.entries[output.entry.index()];
    let value = context.with_type_paths(|type_paths| match (&output.conversion, &entry.ty) {
        (None, Type::Text | Type::Object(_)) => quote!(value.clone()),
        (None, Type::Quantity(_)) => quote!(finite(*value)?),
        (None, _) => quote!(*value),
        (Some(conversion), Type::Text) => {
            converted(type_paths, conversion, &Type::Text, quote!(value))
        }
        // A method call dereferences automatically.
        (Some(conversion @ Conversion::ToText(_)), Type::Quantity(dimension))
            if *dimension != Dimension::NONE =>
        {
            converted(type_paths, conversion, &entry.ty, quote!(value))
        }
        (Some(conversion), ty) => converted(type_paths, conversion, ty, quote!(*value)),
    });
    let value = limited(&context.plan.entries[output.entry.index()], value);
    let value = tried("output", port, value);
    Some(quote! {
        if let Some(value) = from.#field.value() {
            staged.#to = Some(#value);
        }
    })
}

/// Whether a sub-plan has inputs, and whether they read the configuration.
pub fn passes(element: &Element) -> (bool, bool) {
    let reads = element.inputs.iter().any(reads_entries);
    (!element.inputs.is_empty(), reads)
}

/// Whether a sub-plan has results.
pub fn results(element: &Element) -> bool {
    !element.outputs.is_empty()
}
