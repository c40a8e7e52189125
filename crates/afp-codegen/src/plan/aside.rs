//! Setting elements aside: two places for started elements, and their suspension and return.
//!
//! A plan with `suspend` keeps a handler and another element at the same time. Handlers therefore
//! have their own enum. Plans that no event sets aside have none of this code.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::components::{pass_live, stage_results, used};
use super::context::{ComponentNames, Context};
use crate::layout::at;
use crate::names::ident;
use afp_dsl::graph::{Component, Element};

/// The enum and the field that hold the started element, or the started handler.
pub struct Holder {
    pub ty: Ident,
    pub field: Ident,
    handlers: bool,
}

impl Holder {
    fn new(handlers: bool) -> Self {
        let (ty, field) = if handlers { ("Handler", "handler") } else { ("Active", "active") };
        Holder { ty: ident(ty), field: ident(field), handlers }
    }

    /// The place of the elements, and that of the handlers if there are any.
    pub fn all(context: &Context<'_>) -> Vec<Holder> {
        let handlers = context.suspends().then(|| Holder::new(true));
        [Some(Holder::new(false)), handlers].into_iter().flatten().collect()
    }

    /// The place of an element.
    pub fn of(context: &Context<'_>, names: &ComponentNames) -> Holder {
        let all = context.elements.iter().zip(&context.rows.elements);
        let mut handlers = all.filter(|(_, row)| row.handler).map(|(known, _)| &known.number);
        Holder::new(handlers.any(|number| *number == names.number))
    }

    /// Whether it holds handlers.
    pub fn handlers(&self) -> bool {
        self.handlers
    }

    /// The elements that it holds.
    pub fn elements<'a>(
        &self,
        context: &'a Context<'_>,
    ) -> impl Iterator<Item = (&'a Element, &'a ComponentNames)> {
        let handlers = self.handlers;
        let all = context.plan.elements.iter().zip(&context.elements).zip(&context.rows.elements);
        all.filter(move |(_, row)| row.handler == handlers).map(|(named, _)| named)
    }
}

/// A `match` on the started element.
pub struct Matched {
    pub body: TokenStream,
    /// The parameter of the element's number, or `_`.
    pub element: TokenStream,
    /// Whether some element has an arm.
    pub any: bool,
}

/// Matches the started element. `arm` gets the enum; `other` is for elements without an arm.
pub fn on_started(
    context: &Context<'_>,
    other: TokenStream,
    arm: impl Fn(&Ident, &Element, &ComponentNames) -> Option<TokenStream>,
) -> Matched {
    let matched = |holder: &Holder| {
        let Holder { ty, field, .. } = holder;
        let lasting = holder.elements(context).filter(|(element, _)| element.takes_time());
        let arms: Vec<_> = lasting.map(|(element, names)| arm(ty, element, names)).collect();
        let (all, any) = (arms.iter().all(Option::is_some), arms.iter().any(Option::is_some));
        let arms = arms.into_iter().flatten();
        let body = match all {
            true => quote!(match &mut self.#field { #ty::None => #other, #(#arms)* }),
            false if any => quote!(match &mut self.#field { #(#arms)* _ => #other }),
            false => other.clone(),
        };
        (body, any)
    };
    match Holder::all(context).as_slice() {
        [elements, handlers] => {
            let ((other, any), (active, also)) = (matched(elements), matched(handlers));
            let numbers = handlers.elements(context).map(|(_, names)| &names.number);
            let body = quote!(match element { #(#numbers)|* => #active, _ => #other });
            Matched { body, element: quote!(element), any: any || also }
        }
        holders => {
            let found: Vec<_> = holders.iter().map(matched).collect();
            let any = found.iter().any(|(_, any)| *any);
            let body = found.into_iter().map(|(body, _)| body).collect();
            Matched { body, element: quote!(_), any }
        }
    }
}

/// The functions of a plan whose elements can be set aside.
pub fn functions(context: &Context<'_>) -> Option<TokenStream> {
    context.suspendable().then(|| {
        let (suspend, refresh) = (suspend_element(context), refresh_element(context));
        let (resume, supervisors) = (resume_element(context), resume_supervisor(context));
        quote!(#suspend #refresh #resume #supervisors)
    })
}

fn suspend_element(context: &Context<'_>) -> TokenStream {
    let missing = quote!(Err(Fault::INTERNAL));
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
    let cx = used(quote!(cx), any);
    quote! {
        fn suspend_element<R: Run<Env = E>>(
            &mut self,
            #element: ElementId,
            #cx: &mut Cx<'_, R>,
        ) -> Result<(), Fault> {
            #body
        }
    }
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

fn resume_element(context: &Context<'_>) -> TokenStream {
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
    let [away, cx] = [quote!(away), quote!(cx)].map(|name| used(name, any));
    quote! {
        fn resume_element<R: Run<Env = E>>(
            &mut self,
            #element: ElementId,
            #away: Duration,
            #cx: &mut Cx<'_, R>,
        ) -> Started {
            #body
        }
    }
}

fn resume_supervisor(context: &Context<'_>) -> Option<TokenStream> {
    let all = context.plan.supervisors.iter().zip(&context.supervisors);
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
                match supervisor { #(#arms)* _ => Err(Fault::INTERNAL) }
            }
        }
    })
}
