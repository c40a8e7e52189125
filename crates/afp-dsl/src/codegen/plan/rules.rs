//! The fourth section: where every state and event leads, as static rows.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::context::Context;
use super::elements::description;
use crate::codegen::layout::{at, comment, doc};
use crate::graph::{Component, Element, Supervisor, Target};

/// Rows under construction: edges and sweeps are shared by all elements.
#[derive(Default)]
struct Rows {
    edges: Vec<TokenStream>,
    sweeps: Vec<TokenStream>,
}

/// The tables of the plan.
pub fn rules(context: &Context<'_>) -> TokenStream {
    let plan = context.plan;
    let mut rows = Rows::default();
    let elements: Vec<_> = plan
        .elements
        .iter()
        .enumerate()
        .map(|(index, element)| rows.element(context, index, element))
        .collect();
    let supervisors: Vec<_> = (0..)
        .zip(&plan.supervisors)
        .map(|(index, supervisor)| rows.supervisor(context, index, supervisor))
        .collect();
    let Rows { edges, sweeps } = rows;
    let start = context.elements.get(plan.start.index()).map(|names| &names.number);
    let globals = Literal::u16_unsuffixed(plan.globals);
    let entries = Literal::usize_unsuffixed(plan.entries.len());
    let [n_elements, n_supervisors, n_edges, n_sweeps] =
        [elements.len(), supervisors.len(), edges.len(), sweeps.len()]
            .map(Literal::usize_unsuffixed);
    let about = doc("", "Where the scheduler reads the rules of the plan.");
    let notes = [
        "Where each state and event leads.",
        "The elements.",
        "The supervisors: global ones, then local ones.",
        "Who is polled while an element is active, in order.",
    ];
    let [of_edges, of_elements, of_supervisors, of_sweeps] = notes.map(|note| doc("", note));
    quote! {
        #about
        #[derive(Clone, Copy, Debug)]
        pub struct Rules;

        impl Tables for Rules {
            #[inline]
            fn table(&self) -> PlanTable<'_> {
                PlanTable {
                    start: #start,
                    globals: #globals,
                    entries: #entries,
                    elements: &ELEMENTS,
                    supervisors: &SUPERVISORS,
                    edges: &EDGES,
                    sweeps: &SWEEPS,
                }
            }
        }

        #of_edges
        static EDGES: [Target; #n_edges] = [#(#edges),*];
        #of_elements
        static ELEMENTS: [ElementRow; #n_elements] = [#(#elements),*];
        #of_supervisors
        static SUPERVISORS: [SupervisorRow; #n_supervisors] = [#(#supervisors),*];
        #of_sweeps
        static SWEEPS: [u16; #n_sweeps] = [#(#sweeps),*];
    }
}

impl Rows {
    fn element(&mut self, context: &Context<'_>, index: usize, element: &Element) -> TokenStream {
        let (kind, every, states) = match element.component {
            Component::Actor(id) => {
                let template = context.template(id);
                (
                    quote!(Actor),
                    template.every,
                    template.outcomes.iter().map(|o| o.name.clone()).collect(),
                )
            }
            Component::Computation(id) => {
                let states = context.template(id).outcomes.iter().map(|o| o.name.clone());
                (quote!(Computation), 0, states.collect())
            }
            Component::SubPlan(_) => {
                (quote!(SubPlan), 0, vec!["OK".to_owned(), "Interrupted".to_owned()])
            }
        };
        let states = self.edges(context, &element.name, &states, &element.states);
        let first = self.sweeps.len();
        if !matches!(element.component, Component::Computation(_)) {
            for (place, id) in context.plan.sweep(element).into_iter().enumerate() {
                let number = &context.supervisors[id.index()].number;
                let note =
                    (place == 0).then(|| comment(&format!("while {} is active", element.name)));
                self.sweeps.push(quote!(#note #number));
            }
        }
        let sweep = range(first, self.sweeps.len() - first);
        let locals = element.supervisors.first().map_or(0, |id| id.index());
        let locals = range(locals, element.supervisors.len());
        let on_error = target(context, element.on_error);
        let child = match element.component {
            Component::SubPlan(_) => {
                let place = &context.elements[index].place;
                quote!(#place)
            }
            _ => quote!(Child { components: 0, entries: 0 }),
        };
        let (note, period) = (comment(&description(context, element)), duration(every));
        let at = at(element.span);
        quote! {
            #note
            #at
            ElementRow {
                kind: ElementKind::#kind,
                period: #period,
                states: #states,
                on_error: #on_error,
                locals: #locals,
                sweep: #sweep,
                child: #child,
            }
        }
    }

    fn supervisor(
        &mut self,
        context: &Context<'_>,
        index: u16,
        supervisor: &Supervisor,
    ) -> TokenStream {
        let template = context.template(supervisor.template);
        let names = &context.supervisors[usize::from(index)];
        let slot = match supervisor.owner {
            None => index,
            Some(owner) => {
                let first = context.plan.elements[owner.index()].supervisors.first();
                context.plan.globals + index - first.map_or(index, |id| id.0)
            }
        };
        let slot = Literal::u16_unsuffixed(slot);
        let events: Vec<_> = template.outcomes.iter().map(|event| event.name.clone()).collect();
        let targets: Vec<_> = supervisor.events.iter().copied().map(Some).collect();
        let events = self.edges(context, &names.text, &events, &targets);
        let wanted = super::components::wanted(supervisor);
        let on_miss = target(context, supervisor.on_miss);
        let note = comment(&format!("{}: {}", names.text, template.name));
        let at = at(supervisor.span);
        let [period, deadline, budget] =
            [supervisor.every, supervisor.deadline, template.budget.unwrap_or(0)].map(duration);
        quote! {
            #note
            #at
            SupervisorRow {
                period: #period,
                deadline: #deadline,
                budget: #budget,
                slot: #slot,
                events: #events,
                on_miss: #on_miss,
                wanted: #wanted,
            }
        }
    }

    /// Adds the edges of a component, each under its rule as the plan states it.
    fn edges(
        &mut self,
        context: &Context<'_>,
        name: &str,
        outcomes: &[String],
        targets: &[Option<Target>],
    ) -> TokenStream {
        let first = self.edges.len();
        for (outcome, to) in outcomes.iter().zip(targets) {
            let rule = match to {
                Some(to) => format!("{name}: {outcome} -> {}", target_text(context, *to)),
                None => format!("{name}: {outcome} cannot happen"),
            };
            let (note, to) = (comment(&rule), target(context, *to));
            self.edges.push(quote!(#note #to));
        }
        range(first, self.edges.len() - first)
    }
}

fn range(first: usize, len: usize) -> TokenStream {
    let [first, len] = [first, len].map(Literal::usize_unsuffixed);
    quote!(Range { first: #first, len: #len })
}

fn target(context: &Context<'_>, target: Option<Target>) -> TokenStream {
    match target {
        Some(Target::Element(id)) => {
            let number = &context.elements[id.index()].number;
            quote!(Target::Element(#number))
        }
        Some(Target::Terminate) => quote!(Target::Terminate),
        Some(Target::Ignore) => quote!(Target::Ignore),
        None => quote!(Target::None),
    }
}

fn target_text<'a>(context: &Context<'a>, target: Target) -> &'a str {
    match target {
        Target::Element(id) => &context.plan.elements[id.index()].name,
        Target::Terminate => "terminate",
        Target::Ignore => "ignore",
    }
}

/// A span of time in the largest unit that says it exactly.
fn duration(nanos: u64) -> TokenStream {
    let (unit, value) = match nanos {
        0 => return quote!(Duration::ZERO),
        _ if nanos.is_multiple_of(1_000_000_000) => (quote!(from_secs), nanos / 1_000_000_000),
        _ if nanos.is_multiple_of(1_000_000) => (quote!(from_millis), nanos / 1_000_000),
        _ if nanos.is_multiple_of(1_000) => (quote!(from_micros), nanos / 1_000),
        _ => (quote!(from_nanos), nanos),
    };
    let value = Literal::u64_unsuffixed(value);
    quote!(Duration::#unit(#value))
}
