//! The Rust names that the modules of a graph use for one another.
//!
//! Names of plans and toolboxes can collide with existing names: imports and declarations of a
//! module, other modules, crates. They are made unique here, once for the whole graph.

use proc_macro2::Ident;

use super::imports::imported;
use crate::names::{PRIMITIVES, UniqueNames, camel, ident, snake};
use afp_dsl::graph::{Graph, PlanId};
use afp_dsl::toolbox::Toolbox;

pub struct GraphNames {
    /// The module and the type of each plan.
    pub plans: Vec<(Ident, Ident)>,
    /// The name under which a plan's module imports the templates of each toolbox.
    pub toolboxes: Vec<Ident>,
}

/// Types of a plan's module itself, its type parameters, and types of Rust's prelude.
const TYPES: &[&str] = &[
    "A",
    "Active",
    "Handler",
    "Clone",
    "Config",
    "Copy",
    "Debug",
    "Default",
    "E",
    "Err",
    "Iterator",
    "None",
    "Ok",
    "Option",
    "R",
    "Result",
    "Rules",
    "S",
    "Sized",
    "Some",
    "Staged",
    "Supervisors",
];
/// Files and modules other than those of plans, and crates that code next to them may name without
/// `::`.
const MODULES: &[&str] =
    &["computations", "core", "enums", "lib", "main", "std", "tables", "units"];
/// Crates that code of a plan's module may name without `::`.
const CRATES: &[&str] = &["afp", "afp_core", "alloc", "core", "std"];

impl GraphNames {
    /// Names all parts; the main plan comes first, so that other plans do not affect its name.
    pub fn new(graph: &Graph) -> Self {
        let mut modules = UniqueNames::taken([MODULES, PRIMITIVES].concat());
        let mut types = UniqueNames::taken(TYPES.iter().copied().chain(imported()));
        let mut named = |name: &str| {
            let module = modules.unique_or(snake(name), "plan");
            (ident(&module), ident(&types.unique(camel(name))))
        };
        let main = named(&graph.main().name);
        let ids = (0..=u16::MAX).map(PlanId);
        let plans = ids.zip(&graph.plans).map(|(id, plan)| match id == graph.main {
            true => main.clone(),
            false => named(&plan.name),
        });
        GraphNames { plans: plans.collect(), toolboxes: toolboxes(&graph.toolboxes) }
    }

    pub fn plan(&self, id: PlanId) -> (Ident, Ident) {
        self.plans[usize::from(id.0)].clone()
    }
}

/// Names for the imported modules of templates. A crate with a toolbox's name keeps its name.
fn toolboxes(all: &[std::sync::Arc<Toolbox>]) -> Vec<Ident> {
    let roots = all.iter().filter_map(|each| each.rust_path.split("::").next());
    let mut names = UniqueNames::taken([CRATES, PRIMITIVES].concat().into_iter().chain(roots));
    all.iter().map(|each| ident(&names.unique_or(snake(&each.name), "templates"))).collect()
}
