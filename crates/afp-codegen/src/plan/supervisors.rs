//! The second section: the supervisors, and their bindings to the configuration.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::bindings::Bound;
use super::context::{ComponentNames, Context};
use crate::layout::{at, comment, doc};
use afp_dsl::graph::Supervisor;

/// Numbers, the struct of the supervisors, and the bindings of each.
pub fn supervisors(context: &Context<'_>) -> TokenStream {
    let numbers = (0..).zip(&context.supervisors).map(|(index, names)| {
        let (number, index) = (&names.number, Literal::u16_unsuffixed(index));
        quote!(const #number: SupervisorId = SupervisorId(#index);)
    });
    let all = || context.plan.supervisors.iter().zip(&context.supervisors);
    let fields = all().map(|(supervisor, names)| {
        let bound = bound(context, supervisor, names);
        let (field, ty) = (&names.field, &bound.paths.implementation);
        let whose = if supervisor.owner.is_none() { "global" } else { "local" };
        let note = comment(&format!("{whose} supervisor {}: {}", names.text, bound.template.name));
        let at = at(supervisor.span);
        quote!(#note #at #field: Option<#ty>,)
    });
    let bindings = all().map(|(supervisor, names)| {
        let bound = bound(context, supervisor, names);
        let (inputs, live, outputs) =
            (bound.inputs().item, bound.live().item, bound.outputs().item);
        quote!(#inputs #live #outputs)
    });
    let about = doc("", "The supervisors, each while it watches.");
    quote! {
        #(#numbers)*
        #about
        #[derive(Clone, Default)]
        struct Supervisors {
            #(#fields)*
        }
        #(#bindings)*
    }
}

pub fn bound<'a>(
    context: &'a Context<'a>,
    supervisor: &'a Supervisor,
    names: &'a ComponentNames,
) -> Bound<'a> {
    Bound {
        context,
        names,
        template: context.template(supervisor.template),
        paths: context.paths(supervisor.template, supervisor.generic.as_ref()),
        generic: supervisor.generic.as_ref(),
        inputs: &supervisor.inputs,
        outputs: &supervisor.outputs,
        span: supervisor.span,
    }
}
