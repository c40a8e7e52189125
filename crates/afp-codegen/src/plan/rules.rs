//! The fourth section: the targets of all states and events, as static rows.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};

use super::context::{ComponentNames, Context};
use super::elements::description;
use crate::layout::{at, comment, doc};
use afp_dsl::graph::{Component, Element, Target, TemplateId};
use afp_types::{Duration, ElementKind, ElementRow, Events, Range, SupervisorRow, Timing};

/// The tables of the plan.
pub fn rules(context: &Context<'_>) -> TokenStream {
    let (plan, rows) = (context.plan, context.rows);
    let elements: Vec<_> = (plan.elements.iter().zip(&rows.elements))
        .zip(&context.elements)
        .map(|((element, row), names)| self::element(context, element, row, &names.place))
        .collect();
    let supervisors = (0..).zip(&rows.supervisors);
    let supervisors: Vec<_> =
        supervisors.map(|(place, row)| supervisor(context, place, row)).collect();
    let edges = edges(context);
    let sweeps = sweeps(context);
    let (reasons, static_reasons) = reasons(&rows.reasons);
    let start = context.elements.get(rows.start.index()).map(|names| &names.number);
    let [globals, entries] = [rows.globals, rows.entries].map(Literal::u16_unsuffixed);
    let [n_elements, n_supervisors, n_edges, n_sweeps] =
        [elements.len(), supervisors.len(), edges.len(), sweeps.len()]
            .map(Literal::usize_unsuffixed);
    let about = doc("", "The rules of the plan, for the scheduler.");
    let notes = [
        "The target of each state and event.",
        "The elements.",
        "The supervisors: global, local, then global with an element's own edges.",
        "The supervisors of each active element, in polling order.",
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
                    reasons: #reasons,
                    edges: &EDGES,
                    sweeps: &SWEEPS,
                }
            }
        }

        #static_reasons
        #of_edges
        static EDGES: [Option<Target>; #n_edges] = [#(#edges),*];
        #of_elements
        static ELEMENTS: [ElementRow; #n_elements] = [#(#elements),*];
        #of_supervisors
        static SUPERVISORS: [SupervisorRow; #n_supervisors] = [#(#supervisors),*];
        #of_sweeps
        static SWEEPS: [u16; #n_sweeps] = [#(#sweeps),*];
    }
}

/// The reasons for the plan's failures in the rules, and their table if there is one.
fn reasons(texts: &[String]) -> (TokenStream, Option<TokenStream>) {
    if texts.is_empty() {
        return (quote!(&[]), None);
    }
    let faults =
        texts.iter().map(|text| quote!(Fault::new(&Reason { code: Fault::FAILED, text: #text })));
    let (about, length) =
        (doc("", "The reasons for failures of the plan."), Literal::usize_unsuffixed(texts.len()));
    (quote!(&REASONS), Some(quote!(#about static REASONS: [Fault; #length] = [#(#faults),*];)))
}

fn element(
    context: &Context<'_>,
    element: &Element,
    row: &ElementRow,
    place: &Ident,
) -> TokenStream {
    let (kind, child) = match row.kind {
        ElementKind::Actor => (quote!(Actor), None),
        ElementKind::Computation => (quote!(Computation), None),
        ElementKind::SubPlan => (quote!(SubPlan), Some(quote!(#place))),
    };
    let child = child.unwrap_or_else(|| quote!(Child { components: 0, entries: 0 }));
    let [states, locals, sweep] = [row.states, row.locals, row.sweep].map(range);
    let on_error = target(context, row.on_error);
    let ElementRow { resumes, returns, handler, .. } = row;
    let (note, at) = (comment(&description(context, element)), at(element.span));
    let period = duration(row.period);
    quote! {
        #note
        #at
        ElementRow {
            kind: ElementKind::#kind,
            period: #period,
            states: #states,
            on_error: #on_error,
            resumes: #resumes,
            returns: #returns,
            handler: #handler,
            locals: #locals,
            sweep: #sweep,
            child: #child,
        }
    }
}

fn supervisor(context: &Context<'_>, index: usize, row: &SupervisorRow) -> TokenStream {
    let supervisor = &context.plan.supervisors[row.instance.index()];
    let ComponentNames { text: name, number: instance, .. } =
        &context.supervisors[row.instance.index()];
    let template = &context.template(supervisor.template).name;
    let own = context.rows.supervisors.get(row.instance.index());
    let there = match own {
        _ if index == row.instance.index() => "",
        Some(own) if own.events == row.events => ", where an event of it leads",
        _ => ", with an element's own edge",
    };
    let (note, at) = (comment(&format!("{name}: {template}{there}")), at(supervisor.span));
    let Timing { period, deadline, budget } = row.timing;
    let [period, deadline, budget] = [period, deadline, budget].map(duration);
    let (slot, events) = (Literal::u16_unsuffixed(row.slot), range(row.events));
    let on_miss = target(context, row.on_miss);
    let [wanted, wanted_in_look] = [row.wanted, row.wanted_in_look].map(event_set);
    quote! {
        #note
        #at
        SupervisorRow {
            instance: #instance,
            timing: Timing { period: #period, deadline: #deadline, budget: #budget },
            slot: #slot,
            events: #events,
            on_miss: #on_miss,
            wanted: #wanted,
            wanted_in_look: #wanted_in_look,
        }
    }
}

fn event_set(events: Events) -> TokenStream {
    let bits = events.bits();
    let bits: Literal =
        format!("0b{bits:b}").parse().unwrap_or_else(|_| Literal::u64_unsuffixed(bits));
    quote!(Events::from_bits(#bits))
}

/// The edges of all components, each below its rule in the plan's words.
fn edges(context: &Context<'_>) -> Vec<TokenStream> {
    let (plan, rows) = (context.plan, context.rows);
    let mut edges = Vec::with_capacity(rows.edges.len());
    let mut add = |name: &str, outcomes: &[String], targets: &[Option<Target>]| {
        for (outcome, to) in outcomes.iter().zip(targets) {
            let rule = match to {
                Some(Target::Fail(id)) => {
                    format!("{name}: {outcome} -> fail {:?}", rows.reasons[id.index()])
                }
                Some(to) => {
                    let to = to.text(|id| &plan.elements[id.index()].name);
                    format!("{name}: {outcome} -> {to}")
                }
                None => format!("{name}: {outcome} cannot happen"),
            };
            let (note, to) = (comment(&rule), target(context, *to));
            edges.push(quote!(#note #to));
        }
    };
    for (element, row) in plan.elements.iter().zip(&rows.elements) {
        let states = match element.component {
            Component::Actor(id) | Component::Computation(id) => outcomes(context, id),
            Component::SubPlan(_) => vec!["OK".to_owned(), "Interrupted".to_owned()],
        };
        add(&element.name, &states, rows.edges(row.states));
    }
    let supervisors = plan.supervisors.iter().zip(&rows.supervisors);
    for ((supervisor, row), names) in supervisors.zip(&context.supervisors) {
        add(&names.text, &outcomes(context, supervisor.template), rows.edges(row.events));
    }
    for row in rows.supervisors.iter().skip(plan.supervisors.len()) {
        let own = rows.supervisors.get(row.instance.index());
        if own.is_some_and(|own| own.events == row.events) {
            continue;
        }
        let template = plan.supervisors[row.instance.index()].template;
        let name = &context.supervisors[row.instance.index()].text;
        let name = format!("{name}, with an element's own edge");
        add(&name, &outcomes(context, template), rows.edges(row.events));
    }
    edges
}

fn outcomes(context: &Context<'_>, id: TemplateId) -> Vec<String> {
    context.template(id).outcomes.iter().map(|outcome| outcome.name.clone()).collect()
}

/// The sweeps of all elements, each under the element's name.
fn sweeps(context: &Context<'_>) -> Vec<TokenStream> {
    let rows = context.rows;
    let mut sweeps = Vec::with_capacity(rows.sweeps.len());
    for (element, row) in context.plan.elements.iter().zip(&rows.elements) {
        for (position, watch) in rows.sweeps[row.sweep.indices()].iter().enumerate() {
            let number = match context.supervisors.get(usize::from(*watch)) {
                Some(ComponentNames { number, .. }) => quote!(#number.0),
                None => Literal::u16_unsuffixed(*watch).to_token_stream(),
            };
            let note =
                (position == 0).then(|| comment(&format!("while {} is active", element.name)));
            sweeps.push(quote!(#note #number));
        }
    }
    sweeps
}

fn range(range: Range) -> TokenStream {
    let [first, len] = [range.first, range.len].map(Literal::u16_unsuffixed);
    quote!(Range { first: #first, len: #len })
}

fn target(context: &Context<'_>, target: Option<Target>) -> TokenStream {
    let Some(target) = target else { return quote!(None) };
    let target = match target {
        Target::Element(id) => {
            let number = &context.elements[id.index()].number;
            quote!(Element(#number))
        }
        Target::Terminate => quote!(Terminate),
        Target::Fail(id) => {
            let reason = Literal::u16_unsuffixed(id.0);
            quote!(Fail(ReasonId(#reason)))
        }
        Target::Ignore => quote!(Ignore),
        Target::Resume => quote!(Resume),
        Target::Suspend(id) => {
            let number = &context.elements[id.index()].number;
            quote!(Suspend(#number))
        }
        Target::Return => quote!(Return),
    };
    quote!(Some(Target::#target))
}

/// A duration in the largest exact unit.
fn duration(time: Duration) -> TokenStream {
    let nanos = time.as_nanos();
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
