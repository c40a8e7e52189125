//! The implementation of a declared computation, made from its formulas.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::{bound, type_paths};
use crate::formula::{Formulas, Reads};
use crate::names::{camel, ident, snake};
use crate::plan::imports;
use afp_dsl::graph::{Formula, Op};
use afp_dsl::toolbox::{Case, Condition, Template};
use afp_dsl::types::Type;
use afp_types::Comparison;

/// The `impl` in the module of the template; nothing for a template that Rust or Python implements.
pub fn implement(core: &TokenStream, template: &Template) -> Option<TokenStream> {
    let cases = template.cases.as_deref().unwrap_or_default();
    let can_fail = !cases.iter().all(Case::never_fails);
    let body = match &template.states_of {
        Some(states) => selection(core, template, states.port)?,
        None => first_case(core, template, can_fail)?,
    };
    let uses = imports::of_core(core, &[("", body.clone())]);
    let reads = cases.iter().flat_map(Case::formulas);
    let reads = template.states_of.is_some() || reads.flat_map(Formula::entries).next().is_some();
    let inputs = if reads { quote!(inputs) } else { quote!(_) };
    let name = ident(&camel(&template.name));
    let (parameters, arguments) = match bound(template) {
        Some(bound) => (quote!(<V: #core::rt::#bound>), quote!(<V>)),
        None => Default::default(),
    };
    let template = quote!(super::#name #arguments);
    let input = quote!(<#template as #core::ComputationTemplate>::Inputs<'_>);
    let result = quote!(Result<<#template as #core::ComputationTemplate>::State, #core::Fault>);
    let functions = match can_fail {
        true => quote! {
            fn compute(inputs: #input) -> #result {
                Self::compute_in(inputs, &mut None)
            }

            fn compute_in(#inputs: #input, state: &mut Option<u16>) -> #result {
                #uses
                #body
            }
        },
        false => quote! {
            fn compute(#inputs: #input) -> #result {
                #uses
                #body
            }
        },
    };
    Some(quote! {
        impl #parameters #core::Computation<#template> for #template {
            #functions
        }
    })
}

/// The state is the position of a port's value.
fn selection(core: &TokenStream, template: &Template, port: u16) -> Option<TokenStream> {
    let name = ident(&snake(&template.inputs.get(usize::from(port))?.name));
    Some(quote! {
        match inputs.#name.as_value() {
            #core::ValueRef::Choice(place) => Ok(State(place)),
            _ => Err(#core::Fault::INTERNAL),
        }
    })
}

/// The first state whose condition holds. Stores each state for the message of a fault, if formulas can fail.
fn first_case(core: &TokenStream, template: &Template, can_fail: bool) -> Option<TokenStream> {
    let (last, cases) = template.cases.as_deref()?.split_last()?;
    let type_paths = type_paths(core);
    let names: Vec<_> = template.inputs.iter().map(|port| ident(&snake(&port.name))).collect();
    let formulas = Formulas { reads: Reads::Inputs, ..Formulas::new(&type_paths, &names) };
    let writer = Writer { template, formulas };
    let store = |number: usize| {
        let number = Literal::usize_unsuffixed(number);
        can_fail.then(|| quote!(*state = Some(#number);))
    };
    let first = template.outcomes.iter().zip(cases).enumerate().map(|(number, (outcome, case))| {
        let store = store(number);
        let conditions = case.when.iter().map(|one| writer.condition(one));
        let state = writer.state(&outcome.name, case);
        quote!(#store if #(#conditions)&&* { return Ok(#state); })
    });
    let last = writer.state(&template.outcomes.last()?.name, last);
    let store = store(cases.len());
    Some(quote!(#(#first)* #store Ok(#last)))
}

struct Writer<'a> {
    template: &'a Template,
    formulas: Formulas<'a>,
}

impl Writer<'_> {
    /// A state with the outputs that it carries.
    fn state(&self, name: &str, case: &Case) -> TokenStream {
        let variant = ident(&camel(name));
        let fields = case.writes.iter().filter_map(|(output, formula)| {
            let field = ident(&snake(&self.template.outputs.get(usize::from(*output))?.name));
            let value = self.formulas.value(formula);
            Some(quote!(#field: #value))
        });
        let fields: Vec<_> = fields.collect();
        let fields = (!fields.is_empty()).then(|| quote!({ #(#fields),* }));
        quote!(State::#variant #fields)
    }

    fn condition(&self, Condition { left, comparison, right }: &Condition) -> TokenStream {
        let (left, right, ty) = (self.operand(left), self.operand(right), &left.ty);
        let sign = sign(*comparison);
        match ty {
            Type::Quantity(_) | Type::Number => {
                let is = is(*comparison);
                quote!(order(&#left, &#right)?.#is())
            }
            _ => quote!((#left) #sign (#right)),
        }
    }

    /// A value that is only read.
    fn operand(&self, formula: &Formula) -> TokenStream {
        let name = match formula.op() {
            Op::Entry(port) => self.formulas.entries.get(port.index()),
            _ => None,
        };
        match name {
            Some(name) => quote!(inputs.#name),
            None if formula.ty == Type::Text => self.formulas.text(formula.part()),
            None => {
                let value = self.formulas.value(formula);
                quote!((#value))
            }
        }
    }
}

fn sign(comparison: Comparison) -> TokenStream {
    match comparison {
        Comparison::Equal => quote!(==),
        Comparison::NotEqual => quote!(!=),
        Comparison::Less => quote!(<),
        Comparison::LessEqual => quote!(<=),
        Comparison::Greater => quote!(>),
        Comparison::GreaterEqual => quote!(>=),
    }
}

/// The method of an ordering for a comparison.
fn is(comparison: Comparison) -> Ident {
    ident(match comparison {
        Comparison::Equal => "is_eq",
        Comparison::NotEqual => "is_ne",
        Comparison::Less => "is_lt",
        Comparison::LessEqual => "is_le",
        Comparison::Greater => "is_gt",
        Comparison::GreaterEqual => "is_ge",
    })
}
