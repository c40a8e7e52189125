//! The plan on a platform: its components are started, polled, interrupted and dropped.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::bindings::Function;
use super::context::{ComponentNames, Context};
use super::elements::{self, passes, results};
use super::holder::{Holder, Matched, on_started};
use super::supervisors;
use crate::layout::at;
use afp_dsl::graph::{Component, Element, PlanId};

/// `impl Plan<E>`, for every platform that can run all components. `suspension` has the functions of
/// a plan whose elements can be suspended.
pub fn plan(context: &Context<'_>, suspension: Option<TokenStream>) -> TokenStream {
    let ty = &context.ty;
    let bounds = bounds(context);
    let (start_supervisor, poll_supervisor) = (start_supervisor(context), poll_supervisor(context));
    let (start_element, poll_element) = (start_element(context), poll_element(context));
    let (interrupt, leave) = (interrupt_element(context), leave(context));
    let ends = Holder::all(context)
        .into_iter()
        .map(|Holder { ty, field, .. }| quote!(self.#field = #ty::None;));
    quote! {
        impl<E> Plan<E> for #ty
        where
            E: Environment + ?Sized,
            #(#bounds)*
        {
            #start_supervisor
            #poll_supervisor
            #start_element
            #poll_element
            #interrupt
            #suspension
            #leave

            fn end(&mut self) {
                #(#ends)*
                self.supervisors = Supervisors::default();
            }
        }
    }
}

/// The bounds on the platform, each once, in the order of first use. Computations run anywhere.
fn bounds(context: &Context<'_>) -> Vec<TokenStream> {
    let elements = context.plan.elements.iter().filter_map(|element| match element.component {
        Component::Actor(id) => {
            let paths = context.paths(id, element.generic.as_ref());
            let (marker, implementation) = (paths.marker, paths.implementation);
            match context.suspendable && context.template(id).resumable {
                true => Some(quote!(#implementation: Resumable<#marker, E>,)),
                false => Some(quote!(#implementation: Actor<#marker, E>,)),
            }
        }
        Component::SubPlan(id) => {
            let (module, ty) = context.child(id);
            Some(quote!(super::#module::#ty: Plan<E>,))
        }
        Component::Computation(_) => None,
    });
    let supervisors = context.plan.supervisors.iter().map(|supervisor| {
        let paths = context.paths(supervisor.template, supervisor.generic.as_ref());
        let (marker, implementation) = (paths.marker, paths.implementation);
        quote!(#implementation: Supervisor<#marker, E>,)
    });
    let mut seen = Vec::new();
    let all = elements.chain(supervisors);
    all.filter(|bound| {
        let text = bound.to_string();
        let new = !seen.contains(&text);
        seen.push(text);
        new
    })
    .collect()
}

/// A `match` on a number, or only the last arm if there are no others.
fn select(on: TokenStream, arms: &[TokenStream], last: TokenStream) -> TokenStream {
    if arms.is_empty() { last } else { quote!(match #on { #(#arms)* _ => #last }) }
}

/// A parameter, or `_` if it is unused.
pub(super) fn used(name: TokenStream, used: bool) -> TokenStream {
    if used { name } else { quote!(_) }
}

fn start_supervisor(context: &Context<'_>) -> TokenStream {
    let all = context.plan.supervisors.iter().zip(&context.supervisors);
    let arms: Vec<_> = all
        .map(|(supervisor, names)| {
            let bound = supervisors::bound(context, supervisor, names);
            let (number, field) = (&names.number, &names.field);
            let Function { scratch, call, .. } = bound.inputs();
            let at = at(supervisor.span);
            quote! {
                #at
                #number => {
                    #scratch
                    let inputs = #call;
                    self.supervisors.#field = cx.start_supervisor(inputs)?;
                }
            }
        })
        .collect();
    let [number, cx] = [quote!(supervisor), quote!(cx)].map(|name| used(name, !arms.is_empty()));
    let body = if arms.is_empty() {
        quote!(Err(Fault::INTERNAL))
    } else {
        quote!(match supervisor { #(#arms)* _ => return Err(Fault::INTERNAL) } Ok(()))
    };
    quote! {
        fn start_supervisor<R: Run<Env = E>>(
            &mut self,
            #number: SupervisorId,
            #cx: &mut Cx<'_, R>,
        ) -> Result<(), Fault> {
            #body
        }
    }
}

fn poll_supervisor(context: &Context<'_>) -> TokenStream {
    let all = context.plan.supervisors.iter().zip(&context.supervisors);
    let arms: Vec<_> = all
        .map(|(supervisor, names)| {
            let bound = supervisors::bound(context, supervisor, names);
            let (number, field) = (&names.number, &names.field);
            let (Function { scratch, call, .. }, outputs) = (bound.live(), bound.outputs().call);
            let at = at(supervisor.span);
            quote! {
                #at
                #number => {
                    #scratch
                    let live = #call;
                    let watch = &mut self.supervisors.#field;
                    Fired::supervisor(cx.poll_supervisor(watch, live, wanted), #outputs, cx)
                }
            }
        })
        .collect();
    let [number, wanted, cx] =
        [quote!(supervisor), quote!(wanted), quote!(cx)].map(|name| used(name, !arms.is_empty()));
    let body = select(quote!(supervisor), &arms, quote!(Fired::fault(Fault::INTERNAL)));
    quote! {
        #[inline]
        fn poll_supervisor<R: Run<Env = E>>(
            &mut self,
            #number: SupervisorId,
            #wanted: Events,
            #cx: &mut Cx<'_, R>,
        ) -> Fired {
            #body
        }
    }
}

fn start_element(context: &Context<'_>) -> TokenStream {
    let all = context.plan.elements.iter().zip(&context.elements);
    let arms = all.map(|(element, names)| start_arm(context, element, names));
    let arms: Vec<_> = arms.collect();
    let body = select(quote!(element), &arms, quote!(Err(Fault::INTERNAL)));
    let [number, cx] = [quote!(element), quote!(cx)].map(|name| used(name, !arms.is_empty()));
    quote! {
        fn start_element<R: Run<Env = E>>(
            &mut self,
            #number: ElementId,
            #cx: &mut Cx<'_, R>,
        ) -> Started {
            let started: Result<Active, Fault> = #body;
            match started {
                Ok(active) => {
                    self.active = active;
                    Started::Running
                }
                Err(fault) => Started::Failed(fault),
            }
        }
    }
}

fn start_arm(context: &Context<'_>, element: &Element, names: &ComponentNames) -> TokenStream {
    let (number, variant) = (&names.number, &names.variant);
    let (at, holder) = (at(element.span), Holder::of(context, names));
    match element.component {
        Component::Actor(id) => {
            let bound = elements::bound(context, element, names, id);
            let Function { scratch, call, .. } = bound.inputs();
            let Holder { ty, field, .. } = &holder;
            let start = match holder.handlers() {
                false => quote!(cx.start_actor(#call).map(Active::#variant)),
                true => quote! {
                    match cx.start_actor(#call) {
                        Ok(actor) => self.#field = #ty::#variant(actor),
                        Err(fault) => return Started::Failed(fault),
                    }
                    return Started::Running;
                },
            };
            quote! {
                #at
                #number => {
                    #scratch
                    #start
                }
            }
        }
        Component::Computation(id) => {
            let bound = elements::bound(context, element, names, id);
            let (marker, implementation) = (&bound.paths.marker, &bound.paths.implementation);
            let (Function { scratch, call, .. }, outputs) = (bound.inputs(), bound.outputs().call);
            quote! {
                #at
                #number => {
                    #scratch
                    let computed = cx.compute::<#marker, #implementation>(#call);
                    return Started::computed(computed, #outputs, cx);
                }
            }
        }
        Component::SubPlan(id) => start_sub_plan_arm(context, element, names, id),
    }
}

fn start_sub_plan_arm(
    context: &Context<'_>,
    element: &Element,
    names: &ComponentNames,
    id: PlanId,
) -> TokenStream {
    let (number, variant, at) = (&names.number, &names.variant, at(element.span));
    let (module, ty) = context.child(id);
    let (gives, reads) = passes(element);
    let mutable = gives.then(|| quote!(mut));
    let given = gives.then(|| {
        let (function, config) = (&names.inputs, reads.then(|| quote!(&self.config,)));
        quote! {
            if let Err(fault) = cx.noted(#function(#config &mut plan.config)) {
                return Started::Failed(fault);
            }
        }
    });
    let (place, stage) = (&names.place, stage_results(names, element));
    let Holder { ty: holder, field, .. } = Holder::of(context, names);
    quote! {
        #at
        #number => {
            let #mutable plan = super::#module::#ty::new();
            #given
            let mut machine = Machine::new(plan);
            let flow = cx.start_sub_plan(#place, &mut machine);
            let started = Started::sub_plan(flow, || #stage, cx);
            self.#field = #holder::#variant(machine);
            return started;
        }
    }
}

/// Passes a sub-plan its live inputs before its step, or returns `failed`.
pub(super) fn pass_live(
    context: &Context<'_>,
    element: &Element,
    names: &ComponentNames,
    id: PlanId,
    failed: TokenStream,
) -> Option<TokenStream> {
    let inputs = elements::live_inputs(element, context.graph.plan(id));
    let writes = inputs.iter().enumerate().map(|(number, input)| {
        let (number, index) =
            (Literal::usize_unsuffixed(number), Literal::usize_unsuffixed(input.index));
        let field = &input.field;
        quote!(changed |= to.update(#index, &mut plan.config.#field, live.#number);)
    });
    let (function, place) = (&names.live, &names.place);
    (!inputs.is_empty()).then(|| {
        quote! {
            let live = match cx.noted(#function(&self.config)) {
                Ok(live) => live,
                Err(fault) => return #failed,
            };
            cx.pass_live(#place, machine, |plan, to| {
                let mut changed = false;
                #(#writes)*
                changed
            });
        }
    })
}

/// Stages the results of a sub-plan.
pub(super) fn stage_results(names: &ComponentNames, element: &Element) -> TokenStream {
    let function = &names.outputs;
    if results(element) {
        quote!(#function(&mut self.staged, &machine.plan().config))
    } else {
        quote!(Ok(()))
    }
}

fn poll_element(context: &Context<'_>) -> TokenStream {
    let missing = quote!(Polled::Failed(Fault::INTERNAL));
    let Matched { body, element, any } = on_started(context, missing, |ty, element, names| {
        let (variant, at) = (&names.variant, at(element.span));
        match element.component {
            Component::Actor(id) => {
                let bound = elements::bound(context, element, names, id);
                let (Function { scratch, call, .. }, outputs) =
                    (bound.live(), bound.outputs().call);
                Some(quote! {
                    #at
                    #ty::#variant(actor) => {
                        #scratch
                        let live = #call;
                        Polled::actor(cx.poll_actor(actor, live), #outputs, cx)
                    }
                })
            }
            Component::SubPlan(id) => {
                let (place, stage) = (&names.place, stage_results(names, element));
                let failed = quote!(Polled::Failed(fault));
                let live = pass_live(context, element, names, id, failed);
                Some(quote! {
                    #at
                    #ty::#variant(machine) => {
                        #live
                        let flow = cx.inside(#place, |cx| machine.step(cx));
                        Polled::sub_plan(flow, || #stage, cx)
                    }
                })
            }
            Component::Computation(_) => None,
        }
    });
    let cx = used(quote!(cx), any);
    quote! {
        #[inline]
        fn poll_element<R: Run<Env = E>>(
            &mut self,
            #element: ElementId,
            #cx: &mut Cx<'_, R>,
        ) -> Polled {
            #body
        }
    }
}

fn interrupt_element(context: &Context<'_>) -> TokenStream {
    let missing = quote!(Err(Fault::INTERNAL));
    let Matched { body, element, any } = on_started(context, missing, |ty, element, names| {
        let (variant, at) = (&names.variant, at(element.span));
        match element.component {
            Component::Actor(_) => {
                Some(quote!(#at #ty::#variant(actor) => cx.interrupt_actor(actor),))
            }
            Component::SubPlan(_) => {
                let place = &names.place;
                Some(quote! {
                    #at
                    #ty::#variant(machine) => cx.inside(#place, |cx| machine.interrupt(cx)),
                })
            }
            Component::Computation(_) => None,
        }
    });
    let cx = used(quote!(cx), any);
    quote! {
        fn interrupt_element<R: Run<Env = E>>(
            &mut self,
            #element: ElementId,
            #cx: &mut Cx<'_, R>,
        ) -> Result<(), Fault> {
            #body
        }
    }
}

fn leave(context: &Context<'_>) -> TokenStream {
    let arms = context.elements.iter().enumerate().filter_map(|(index, names)| {
        let number = &names.number;
        let drops: Vec<_> = context
            .locals(index)
            .map(|local| {
                let field = &local.field;
                quote!(self.supervisors.#field = None;)
            })
            .collect();
        (!drops.is_empty()).then(|| quote!(#number => { #(#drops)* }))
    });
    let arms: Vec<_> = arms.collect();
    let element = used(quote!(element), !arms.is_empty() || context.suspends());
    let dropped = (!arms.is_empty()).then(|| quote!(match element { #(#arms)* _ => {} }));
    let cleared = match Holder::all(context).as_slice() {
        // A computation may run while an element is set aside.
        holders @ [_, _] => {
            let clears = holders.iter().map(|holder| {
                let Holder { ty, field, .. } = holder;
                let lasting = holder.elements(context).filter(|(element, _)| element.takes_time());
                let numbers = lasting.map(|(_, names)| &names.number);
                quote!(#(#numbers)|* => self.#field = #ty::None,)
            });
            quote!(match element { #(#clears)* _ => {} })
        }
        _ => quote!(self.active = Active::None;),
    };
    quote! {
        fn leave(&mut self, #element: ElementId) {
            #cleared
            #dropped
        }
    }
}
