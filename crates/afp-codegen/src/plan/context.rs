//! The Rust names of all parts of a plan.

use std::sync::Arc;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::enums::FileEnum;
use crate::names::{UniqueNames, camel, ident, path, shout, snake};
use crate::rust_type::TypePaths;
use crate::toolbox;
use afp_dsl::graph::{
    Component, Formula, Graph, Op, Output, Plan, PlanId, SupervisorId, TemplateId,
};
use afp_dsl::rows::Rows;
use afp_dsl::toolbox::Template;
use afp_dsl::types::{Enum, Object, Type};

use super::computations::{FileComputations, computations_of};
use super::graph_names::GraphNames;
use super::imports::imported;
use super::shared::enums_of;
use super::tables::{FileTable, enum_path, tables_of};

/// Statics of the module itself.
const STATICS: &[&str] = &["EDGES", "ELEMENTS", "NAMES", "REASONS", "SUPERVISORS", "SWEEPS"];
/// One plan, with the names of its parts.
pub struct Context<'a> {
    pub graph: &'a Graph,
    /// The common parts of all modules.
    pub shared: &'a Shared,
    pub plan: &'a Plan,
    pub rows: &'a Rows,
    /// Whether an event of the plan or of an outer plan, or a debugger, can suspend elements of the
    /// plan.
    pub suspendable: bool,
    pub module: Ident,
    pub ty: Ident,
    /// Getters and fields of the entries.
    pub entries: Vec<Ident>,
    pub elements: Vec<ComponentNames>,
    pub supervisors: Vec<ComponentNames>,
    /// Whether a formula reads the entry.
    pub read: Vec<bool>,
    /// Whether an output or an external writer can write the entry.
    pub written: Vec<bool>,
}

/// The Rust names of one element or supervisor.
pub struct ComponentNames {
    pub text: String,
    /// The variant that holds an element.
    pub variant: Ident,
    /// The field that holds a supervisor.
    pub field: Ident,
    /// The function of its inputs.
    pub inputs: Ident,
    /// The function of its live inputs.
    pub live: Ident,
    /// The function that stages its outputs.
    pub outputs: Ident,
    pub number: Ident,
    /// The start of its ids, for a sub-plan.
    pub place: Ident,
}

/// The common parts of a graph's modules.
pub struct Shared {
    pub enums: Vec<FileEnum>,
    /// The tables that some plan reads.
    pub tables: Vec<FileTable>,
    /// The computations of the plan files that some plan uses.
    pub computations: Vec<FileComputations>,
    /// The names that modules use for one another.
    pub names: GraphNames,
    /// Whether debuggers can hold the plans.
    pub hold: bool,
    /// For each plan, whether its elements can be suspended.
    suspendable: Vec<bool>,
}

impl Shared {
    /// The common parts of this graph's modules.
    pub fn of(graph: &Graph, hold: bool) -> Self {
        Shared {
            enums: enums_of(graph),
            tables: tables_of(graph),
            computations: computations_of(graph),
            names: GraphNames::new(graph),
            hold,
            suspendable: suspendable(graph, hold),
        }
    }
}

impl<'a> Context<'a> {
    pub fn new(graph: &'a Graph, shared: &'a Shared, id: PlanId) -> Self {
        let (plan, rows) = (graph.plan(id), graph.rows(id));
        let mut namer = Namer::new();
        let elements: Vec<_> =
            plan.elements.iter().map(|element| namer.name(&element.name, &element.name)).collect();
        let supervisors = plan.supervisors.iter().map(|supervisor| {
            let owner = supervisor.owner.and_then(|id| plan.elements.get(id.index()));
            match owner {
                Some(owner) => namer.name(
                    &format!("{}_{}", owner.name, supervisor.name),
                    &format!("{}.{}", owner.name, supervisor.name),
                ),
                None => namer.name(&supervisor.name, &supervisor.name),
            }
        });
        let supervisors = supervisors.collect();
        let (module, ty) = shared.names.plan(id);
        Context {
            graph,
            shared,
            plan,
            rows,
            suspendable: shared.suspendable.get(id.index()).is_some_and(|known| *known),
            module,
            ty,
            entries: entry_names(plan),
            elements,
            supervisors,
            read: read(plan),
            written: written(plan),
        }
    }

    pub fn template(&self, id: TemplateId) -> &'a Template {
        self.graph.template(id)
    }

    /// The marker of a template, such as `carbot::Forward`, with its module `carbot::forward` and
    /// the type that implements it, `afp_carbot::Forward`.
    pub fn paths(&self, id: TemplateId, generic: Option<&Type>) -> Paths {
        if let Some(paths) = self.table_paths(self.template(id)) {
            return paths;
        }
        let (module, template) =
            match self.shared.computations.iter().find(|file| file.toolbox == id.toolbox) {
                Some(FileComputations { module, templates, .. }) => {
                    (quote!(super::#module), &templates[usize::from(id.index)])
                }
                None => {
                    let alias = &self.shared.names.toolboxes[id.toolbox.index()];
                    (quote!(#alias), self.template(id))
                }
            };
        let (name, own) = (ident(&camel(&template.name)), toolbox::module(template));
        let generic = generic.map(|ty| {
            let ty = self.entry_type(ty);
            quote!(<#ty>)
        });
        let marker = quote!(#module::#name #generic);
        // A declared computation implements itself.
        let implementation = match template.cases {
            Some(_) => marker.clone(),
            None => {
                let home = path(&self.graph.toolboxes[id.toolbox.index()].rust_path);
                quote!(#home::#name #generic)
            }
        };
        Paths { marker, module: quote!(#module::#own), implementation }
    }

    /// The paths of a table's reader, which is next to the plan's module.
    fn table_paths(&self, template: &Template) -> Option<Paths> {
        let (_, table) = template.table()?;
        let (_, name) = self.shared.tables.iter().find(|(known, _)| Arc::ptr_eq(known, table))?;
        Some(Paths {
            marker: quote!(super::tables::#name::Row),
            module: quote!(super::tables::#name),
            implementation: quote!(super::tables::#name::Row),
        })
    }

    /// Provides the types for this plan's module.
    pub fn with_type_paths<R>(&self, run: impl FnOnce(&TypePaths<'_>) -> R) -> R {
        let choice =
            &|choices: &Enum| enum_path(self.graph, &self.shared.enums, &quote!(super), choices);
        let object = &|object: &Object| {
            let toolbox = self.graph.toolboxes.iter().find(|t| t.name == object.toolbox);
            let (module, name) =
                (path(toolbox.map_or("crate", |t| &t.rust_path)), ident(&camel(&object.name)));
            quote!(#module::#name)
        };
        run(&TypePaths { core: TokenStream::new(), quantity: TokenStream::new(), choice, object })
    }

    pub fn value_type(&self, ty: &Type) -> TokenStream {
        self.with_type_paths(|type_paths| type_paths.value(ty))
    }

    /// The type of an entry's content.
    pub fn entry_type(&self, ty: &Type) -> TokenStream {
        let value = self.value_type(ty);
        if matches!(ty, Type::Object(_)) { quote!(Object<#value>) } else { value }
    }

    /// Whether an event of the plan sets an element aside.
    pub fn suspends(&self) -> bool {
        self.rows.suspends()
    }

    /// The supervisors of an element, with their names.
    pub fn locals(&self, element: usize) -> impl Iterator<Item = &ComponentNames> {
        let locals = self.plan.elements[element].supervisors.iter();
        locals.map(|SupervisorId(id)| &self.supervisors[usize::from(*id)])
    }

    /// The entries of another plan of the graph, with the names of its module and type.
    pub fn child(&self, id: PlanId) -> (Ident, Ident) {
        self.shared.names.plan(id)
    }
}

/// Fields and getters of a plan's entries.
pub fn entry_names(plan: &Plan) -> Vec<Ident> {
    let mut names = UniqueNames::default();
    plan.entries.iter().map(|entry| ident(&names.unique(snake(&entry.name)))).collect()
}

pub struct Paths {
    pub marker: TokenStream,
    pub module: TokenStream,
    pub implementation: TokenStream,
}

/// Assigns names to components without collisions.
///
/// Names of a component's functions end in their purpose, and no other function or local of
/// generated code does. So neither can hide the other, for any name of a component.
struct Namer {
    variants: UniqueNames,
    functions: UniqueNames,
    numbers: UniqueNames,
}

impl Namer {
    fn new() -> Self {
        Namer {
            variants: UniqueNames::taken(["None"]),
            functions: UniqueNames::default(),
            numbers: UniqueNames::taken(STATICS.iter().copied().chain(imported())),
        }
    }

    fn name(&mut self, name: &str, text: &str) -> ComponentNames {
        let base = self.functions.unique(snake(name));
        let [inputs, live, outputs] =
            ["inputs", "live", "outputs"].map(|what| ident(&format!("{base}_{what}")));
        let number = self.numbers.unique(shout(name));
        let place = self.numbers.unique(format!("{number}_PLACE"));
        ComponentNames {
            text: text.to_owned(),
            variant: ident(&self.variants.unique(camel(name))),
            field: ident(&base),
            inputs,
            live,
            outputs,
            number: ident(&number),
            place: ident(&place),
        }
    }
}

/// The plans with `suspend` or for debuggers, and all plans in them.
fn suspendable(graph: &Graph, hold: bool) -> Vec<bool> {
    let mut suspendable = vec![hold; graph.plans.len()];
    // Sub-plans come before their users.
    for (index, plan) in graph.plans.iter().enumerate().rev() {
        let handlers = graph.rows.get(index).is_some_and(|rows| rows.suspends());
        if !handlers && !suspendable[index] {
            continue;
        }
        suspendable[index] = true;
        for element in &plan.elements {
            if let Component::SubPlan(id) = element.component
                && let Some(inner) = suspendable.get_mut(id.index())
            {
                *inner = true;
            }
        }
    }
    suspendable
}

/// The entries that formulas read through a getter; objects are passed to sub-plans without one.
fn read(plan: &Plan) -> Vec<bool> {
    let mut read = vec![false; plan.entries.len()];
    let mut see = |formula: &Formula| {
        for (entry, _) in formula.entries() {
            if let Some(read) = read.get_mut(entry.index()) {
                *read = true;
            }
        }
    };
    for element in &plan.elements {
        let passed = matches!(element.component, Component::SubPlan(_));
        let formulas = element.inputs.iter();
        formulas.filter(|f| !(passed && is_bare(f))).for_each(&mut see);
    }
    plan.supervisors.iter().flat_map(|supervisor| &supervisor.inputs).for_each(&mut see);
    let initial = plan.entries.iter().filter_map(|entry| entry.init.as_ref());
    initial.filter(|formula| !is_bare(formula)).for_each(&mut see);
    read
}

/// Whether a formula is an entry that is cloned: a string or an object.
pub fn is_bare(formula: &Formula) -> bool {
    matches!(formula.ty, Type::Text | Type::Object(_)) && matches!(formula.op(), Op::Entry(_))
}

/// The entries that a commit can write.
fn written(plan: &Plan) -> Vec<bool> {
    use afp_dsl::graph::EntryKind;
    let open = |entry: &afp_dsl::graph::Entry| {
        matches!(entry.kind, EntryKind::In | EntryKind::Var) && !matches!(entry.ty, Type::Object(_))
    };
    let mut written: Vec<_> = plan.entries.iter().map(open).collect();
    let outputs = plan.elements.iter().flat_map(|element| &element.outputs);
    let outputs = outputs.chain(plan.supervisors.iter().flat_map(|s| &s.outputs));
    for Output { entry, .. } in outputs {
        if let Some(written) = written.get_mut(entry.index()) {
            *written = true;
        }
    }
    written
}
