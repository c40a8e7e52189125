//! The Rust names by which the modules of a graph know one another.
//!
//! Names of plans and toolboxes meet names that are there already: those that a module imports or declares for itself,
//! other modules, crates. They are made apart here, once for the whole graph.

use proc_macro2::Ident;

use super::imports::imported;
use crate::names::{PRIMITIVES, UniqueNames, camel, ident, snake};
use afp_dsl::graph::{Graph, PlanId};
use afp_dsl::toolbox::Toolbox;

/// The names of plans and toolboxes.
pub struct GraphNames {
    /// The module and the type of each plan.
    pub plans: Vec<(Ident, Ident)>,
    /// The name under which a plan's module imports the templates of each toolbox.
    pub toolboxes: Vec<Ident>,
}

/// Types of a plan's module itself, its type parameters, and types that are always there.
const TYPES: &[&str] = &[
    "A",
    "Active",
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
/// Files and modules beside those of plans, and crates that code beside them may name without `::`.
const MODULES: &[&str] = &["core", "enums", "lib", "main", "std", "tables", "units"];
/// Crates that code of a plan's module may name without `::`.
const CRATES: &[&str] = &["afp", "afp_core", "alloc", "core", "std"];

impl GraphNames {
    /// Names everything; the main plan first, so that it alone decides what it is called.
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

    /// The module and the type of a plan.
    pub fn plan(&self, id: PlanId) -> (Ident, Ident) {
        self.plans[usize::from(id.0)].clone()
    }
}

/// Names for the imported modules of templates. A crate that is named like a toolbox keeps its name.
fn toolboxes(all: &[std::sync::Arc<Toolbox>]) -> Vec<Ident> {
    let roots = all.iter().filter_map(|each| each.rust_path.split("::").next());
    let mut names = UniqueNames::taken([CRATES, PRIMITIVES].concat().into_iter().chain(roots));
    all.iter().map(|each| ident(&names.unique_or(snake(&each.name), "templates"))).collect()
}
