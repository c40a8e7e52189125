//! A native plan from a graph.
//!
//! Each plan becomes a module of four sections, as in the paper's Table I: its actors (with
//! computations and sub-plans), its supervisors, the plan itself, and its rules. The scheduler of
//! `afp_core` drives the result through `afp_core::rt`; the graph is not needed at run time.

mod accessors;
mod aside;
mod bindings;
mod components;
mod computations;
mod context;
mod elements;
mod graph_names;
mod holder;
pub(crate) mod imports;
mod names;
mod rules;
mod shared;
mod state;
mod supervisors;
mod tables;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::Options;
use crate::layout::{comment, doc};
use afp_dsl::graph::{Graph, PlanId};
use afp_syntax::source::Span;
use context::{Context, Shared};

/// The Rust code of a graph: a module for each plan, and their common parts.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The modules, sub-plans before the plans that use them.
    pub modules: Vec<Module>,
    /// The module and the type of each plan.
    pub plans: Vec<(Ident, Ident)>,
    /// The module of the running plan.
    pub main: Ident,
    /// The type of the running plan, in its module.
    pub plan: Ident,
}

#[derive(Clone, Debug)]
pub struct Module {
    pub name: Ident,
    /// Its help, without slashes.
    pub doc: String,
    pub imports: TokenStream,
    pub sections: Vec<(&'static str, TokenStream)>,
    pub span: Span,
}

/// The Rust code of all plans of a graph.
pub fn plan(graph: &Graph, options: &Options) -> Generated {
    let shared = Shared::of(graph, options.hold);
    let mut modules = shared::modules(graph, &shared.enums, options);
    modules.extend(tables::module(graph, &shared.enums, &shared.tables, options));
    let declared = (&*shared.enums, &*shared.computations);
    modules.extend(computations::modules(graph, declared, options));
    let ids = (0..=u16::MAX).map(PlanId).take(graph.plans.len());
    modules.extend(ids.map(|id| module(&Context::new(graph, &shared, id), options, id)));
    let (main, plan) = shared.names.plan(graph.main);
    Generated { modules, plans: shared.names.plans, main, plan }
}

fn module(context: &Context<'_>, options: &Options, id: PlanId) -> Module {
    let plan = context.plan;
    let of_file = plan.file.as_ref().map(|file| format!(" of `{file}`")).unwrap_or_default();
    let about = if plan.doc.is_empty() {
        format!("The plan `{}`{of_file}.", plan.name)
    } else {
        format!("The plan `{}`{of_file}: {}", plan.name, plan.doc)
    };
    let sections = vec![
        ("Actors", elements::elements(context)),
        ("Supervisors", supervisors::supervisors(context)),
        ("Plan", plan_section(context)),
        ("Rules", rules::rules(context)),
        ("Names", names::names(context, id)),
    ];
    let imports =
        imports::imports(&options.core, context.graph, &context.shared.names.toolboxes, &sections);
    Module { name: context.module.clone(), doc: about, imports, sections, span: plan.span }
}

fn plan_section(context: &Context<'_>) -> TokenStream {
    let structure = state::structure(context);
    let accessors = accessors::accessors(context);
    let state = state::plan_state(context);
    let components = components::plan(context, aside::functions(context));
    quote! {
        #structure
        #accessors
        #state
        #components
    }
}

impl Module {
    /// The content of the module, for a printed file.
    pub fn tokens(&self) -> TokenStream {
        let lines = self.doc.lines().map(|line| format!(" {line}"));
        let imports = &self.imports;
        let sections = self.sections.iter().map(|(title, tokens)| {
            let header = (!tokens.is_empty()).then(|| comment(&format!("**** {title} ****")));
            quote!(#header #tokens)
        });
        quote! {
            #(#![doc = #lines])*
            #imports
            #(#sections)*
        }
    }
}

impl Generated {
    /// All modules with their bodies in a module of the main plan's name, with the types of all
    /// plans. The main plan's type is also next to it.
    pub fn tokens(&self) -> TokenStream {
        let modules = self.modules.iter().map(|module| {
            let (name, about) = (&module.name, doc(&module.doc, ""));
            let imports = &module.imports;
            let sections = module.sections.iter().map(|(_, tokens)| tokens);
            quote! {
                #about
                pub mod #name {
                    #imports
                    #(#sections)*
                }
            }
        });
        let (main, plan) = (&self.main, &self.plan);
        let subs = self.plans.iter().filter(|(module, _)| module != main).cloned();
        let (owners, types): (Vec<_>, Vec<_>) = subs.unzip();
        let about = doc("", &format!("The plan `{plan}` and the plans that it uses."));
        quote! {
            #about
            #[allow(dead_code, non_camel_case_types, unused_imports, unused_parens, clippy::all)]
            pub mod #main {
                #(#modules)*
                pub use self::#main::*;
                #(pub use self::#owners::#types;)*
            }
            #[allow(unused_imports, reason = "the user of the plan may name its module")]
            pub use self::#main::#plan;
        }
    }
}
