//! Computations declared in plan files, in the form that `toolbox!` gives the computations of a
//! toolbox.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::Module;
use super::tables::enum_path;
use crate::Options;
use crate::enums::FileEnum;
use crate::names::{UniqueNames, camel, ident};
use crate::toolbox;
use afp_dsl::graph::{Component, Graph, ToolboxId};
use afp_dsl::toolbox::{Case, Template};
use afp_dsl::types::{Enum, Type};

/// The used computations of one file, and their module.
pub struct FileComputations {
    /// Their toolbox in the graph.
    pub toolbox: ToolboxId,
    /// Their module.
    pub module: Ident,
    /// The templates, with names that differ from the module's enums.
    pub templates: Vec<Template>,
}

/// The computations of the plan files, in the order of first use.
pub fn computations_of(graph: &Graph) -> Vec<FileComputations> {
    let mut modules = UniqueNames::default();
    let mut found: Vec<FileComputations> = Vec::new();
    for element in graph.plans.iter().flat_map(|plan| &plan.elements) {
        let Component::Computation(id) = element.component else { continue };
        let toolbox = &graph.toolboxes[id.toolbox.index()];
        if toolbox.is_named() || found.iter().any(|known| known.toolbox == id.toolbox) {
            continue;
        }
        let mut templates = toolbox.templates.clone();
        let enums: Vec<_> = enums(&templates).iter().map(|choices| camel(&choices.name)).collect();
        let mut names = UniqueNames::taken(enums.iter().map(String::as_str));
        for template in &mut templates {
            template.name = names.unique(camel(&template.name));
        }
        let module = ident(&modules.unique("computations".to_owned()));
        found.push(FileComputations { toolbox: id.toolbox, module, templates });
    }
    found
}

/// The types of ports and formulas of the computations.
fn types(templates: &[Template]) -> impl Iterator<Item = &Type> {
    templates.iter().flat_map(|template| {
        let inputs = template.inputs.iter().map(|port| &port.ty);
        let ports = inputs.chain(template.outputs.iter().map(|port| &port.ty));
        let formulas = template.cases.iter().flat_map(|cases| cases.iter());
        let nodes = formulas.flat_map(Case::formulas).flat_map(|formula| formula.nodes());
        ports.chain(nodes.map(|node| &node.note.ty))
    })
}

fn enums(templates: &[Template]) -> Vec<&Enum> {
    let mut found: Vec<&Enum> = Vec::new();
    for ty in types(templates) {
        if let Type::Enum(choices) = ty
            && !found.contains(&&**choices)
        {
            found.push(choices);
        }
    }
    found
}

/// The types of the ports and formulas of the computations that some plan uses.
pub fn all_types(graph: &Graph, see: &mut dyn FnMut(&Type)) {
    computations_of(graph).iter().flat_map(|file| types(&file.templates)).for_each(see);
}

pub fn modules<'a>(
    graph: &'a Graph,
    (enums_of_files, files): (&'a [FileEnum], &'a [FileComputations]),
    options: &'a Options,
) -> impl Iterator<Item = Module> + 'a {
    files.iter().map(move |file| {
        let templates = file.templates.iter().map(|it| toolbox::template(&options.core, it));
        let enums = enums(&file.templates).into_iter().map(|choices| {
            let path = enum_path(graph, enums_of_files, &quote!(super), choices);
            let name = ident(&camel(&choices.name));
            quote!(use #path as #name;)
        });
        let imports: TokenStream = enums.collect();
        Module {
            name: file.module.clone(),
            doc: "The computations of a plan file.".to_owned(),
            imports,
            sections: vec![("Computations", quote!(#(#templates)*))],
            span: graph.main().span,
        }
    })
}
