//! The enums that hold started elements: a plan with handlers has two.
//!
//! A plan with `suspend` keeps a handler and another element at the same time, so handlers have
//! their own enum.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::context::{ComponentNames, Context};
use crate::names::ident;
use afp_dsl::graph::Element;

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
