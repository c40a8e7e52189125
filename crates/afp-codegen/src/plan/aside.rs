//! Suspension and return of elements, for handlers and for debuggers that hold a plan. Other plans
//! have none of this code.

use proc_macro2::TokenStream;
use quote::quote;

use super::components::{pass_live, stage_results, used};
use super::context::{ComponentNames, Context};
use super::holder::{Matched, on_started};
use crate::layout::at;
use afp_dsl::graph::{Component, Element};

/// The functions of a plan whose elements can be suspended.
pub fn functions(context: &Context<'_>) -> Option<TokenStream> {
    context.suspendable.then(|| {
        let (suspend, refresh) = (suspend_element(context), refresh_element(context));
        let (resume, supervisors) = (resume_element(context), resume_supervisor(context));
        quote!(#suspend #refresh #resume #supervisors)
    })
}

fn suspend_element(context: &Context<'_>) -> Option<TokenStream> {
    let missing = quote!(Ok(Kept::No));
    let Matched { body, element, any } = on_started(context, missing, |ty, element, names| {
        let (variant, place, at) = (&names.variant, &names.place, at(element.span));
        match element.component {
            Component::Actor(id) if context.template(id).resumable => {
                Some(quote!(#at #ty::#variant(actor) => cx.suspend_actor(actor),))
            }
            Component::SubPlan(_) => Some(quote! {
                #at
                #ty::#variant(machine) => cx.inside(#place, |cx| machine.suspend(cx)),
            }),
            Component::Actor(_) | Component::Computation(_) => None,
        }
    });
    any.then(|| {
        quote! {
            fn suspend_element<R: Run<Env = E>>(
                &mut self,
                #element: ElementId,
                cx: &mut Cx<'_, R>,
            ) -> Result<Kept, Fault> {
                #body
            }
        }
    })
}

fn refresh_element(context: &Context<'_>) -> Option<TokenStream> {
    let passed = |element: &Element, names: &ComponentNames| {
        let Component::SubPlan(id) = element.component else { return None };
        pass_live(context, element, names, id, quote!(Err(fault)))
    };
    let mut all = context.plan.elements.iter().zip(&context.elements);
    all.find_map(|(element, names)| passed(element, names))?;
    let Matched { body, element, any } =
        on_started(context, quote!(Ok(())), |ty, element, names| {
            let (live, variant, at) = (passed(element, names)?, &names.variant, at(element.span));
            Some(quote!(#at #ty::#variant(machine) => { #live Ok(()) }))
        });
    let cx = used(quote!(cx), any);
    Some(quote! {
        fn refresh_element<R: Run<Env = E>>(
            &mut self,
            #element: ElementId,
            #cx: &mut Cx<'_, R>,
        ) -> Result<(), Fault> {
            #body
        }
    })
}

fn resume_element(context: &Context<'_>) -> Option<TokenStream> {
    let missing = quote!(Started::Failed(Fault::INTERNAL));
    let Matched { body, element, any } = on_started(context, missing, |ty, element, names| {
        let (variant, place, at) = (&names.variant, &names.place, at(element.span));
        let stage = stage_results(names, element);
        match element.component {
            Component::Actor(id) if context.template(id).resumable => {
                Some(quote!(#at #ty::#variant(actor) => cx.resume_actor(actor, away),))
            }
            Component::SubPlan(_) => Some(quote! {
                #at
                #ty::#variant(machine) => {
                    let flow = cx.resume_sub_plan(#place, machine, away);
                    Started::sub_plan(flow, || #stage, cx)
                }
            }),
            Component::Actor(_) | Component::Computation(_) => None,
        }
    });
    any.then(|| {
        quote! {
            fn resume_element<R: Run<Env = E>>(
                &mut self,
                #element: ElementId,
                away: Duration,
                cx: &mut Cx<'_, R>,
            ) -> Started {
                #body
            }
        }
    })
}

fn resume_supervisor(context: &Context<'_>) -> Option<TokenStream> {
    let all = context.plan.supervisors.iter().zip(&context.supervisors);
    let all = all.filter(|(supervisor, _)| context.template(supervisor.template).resumable);
    let arms = all.map(|(supervisor, ComponentNames { number, field, .. })| {
        let at = at(supervisor.span);
        quote!(#at #number => cx.resume_supervisor(&mut self.supervisors.#field, away),)
    });
    let arms: Vec<_> = arms.collect();
    (!arms.is_empty()).then(|| {
        quote! {
            fn resume_supervisor<R: Run<Env = E>>(
                &mut self,
                supervisor: SupervisorId,
                away: Duration,
                cx: &mut Cx<'_, R>,
            ) -> Result<OnReturn, Fault> {
                match supervisor { #(#arms)* _ => Ok(OnReturn::Restarts) }
            }
        }
    })
}
