//! The tables of plan files: rows as statics, and their readers.
//!
//! `Row` of `std` has the columns of the plan's table as outputs. Therefore it is generated here
//! for each table, in the form that `toolbox!` gives every other template.

use std::sync::Arc;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::Module;
use crate::Options;
use crate::enums::FileEnum;
use crate::layout::doc;
use crate::names::{UniqueNames, camel, ident, path, snake};
use crate::rust_type::{TypePaths, int, variant};
use afp_dsl::graph::{Component, Graph};
use afp_dsl::table::{Cell, Table};
use afp_dsl::toolbox::{Constant, Template};
use afp_dsl::types::{Dimension, Enum, Object, Type};

/// A table of a plan file, with its reader's module.
pub type FileTable = (Arc<Table>, Ident);

/// The templates of a graph's computations that read tables.
fn readers(graph: &Graph) -> impl Iterator<Item = (&Template, &Arc<Table>)> {
    let elements = graph.plans.iter().flat_map(|plan| &plan.elements);
    elements.filter_map(|element| {
        let Component::Computation(id) = element.component else { return None };
        let template = graph.template(id);
        Some((template, template.table()?.1))
    })
}

/// The tables that some plan reads, in the order of first use.
pub fn tables_of(graph: &Graph) -> Vec<FileTable> {
    let mut tables: Vec<FileTable> = Vec::new();
    let mut names = UniqueNames::default();
    for (_, table) in readers(graph) {
        if !tables.iter().any(|(known, _)| Arc::ptr_eq(known, table)) {
            tables.push((table.clone(), ident(&names.unique(snake(&table.name)))));
        }
    }
    tables
}

/// The types of the columns that some plan reads.
pub fn types(graph: &Graph, see: &mut dyn FnMut(&Type)) {
    readers(graph).flat_map(|(reader, _)| &reader.outputs).for_each(|port| see(&port.ty));
}

/// The module `tables`, if any plan reads a table.
pub fn module(
    graph: &Graph,
    enums: &[FileEnum],
    tables: &[FileTable],
    options: &Options,
) -> Option<Module> {
    let core = &options.core;
    let choice = &|choices: &Enum| enum_path(graph, enums, &quote!(super::super), choices);
    // Columns have no objects.
    let object = &|_: &Object| TokenStream::new();
    let quantity = quote!(#core::quantity::);
    let type_paths = TypePaths { core: quote!(#core::), quantity, choice, object };
    let items = tables.iter().filter_map(|(table, name)| {
        let (template, _) = readers(graph).find(|(_, read)| Arc::ptr_eq(read, table))?;
        Some(reader(core, &type_paths, (table, name), template))
    });
    let items: Vec<_> = items.collect();
    (!items.is_empty()).then(|| Module {
        name: ident("tables"),
        doc: "The tables of the plan files.".to_owned(),
        imports: TokenStream::new(),
        sections: vec![("Tables", quote!(#(#items)*))],
        span: graph.main().span,
    })
}

/// The path of an enum from a module; `root` leads to the parent of all modules.
pub fn enum_path(
    graph: &Graph,
    enums: &[FileEnum],
    root: &TokenStream,
    choices: &Enum,
) -> TokenStream {
    let camel = || ident(&camel(&choices.name));
    let Some(toolbox) = &choices.toolbox else {
        let named = enums.iter().find(|(known, _)| **known == *choices);
        let name = named.map_or_else(camel, |(_, name)| name.clone());
        return quote!(#root::enums::#name);
    };
    let found = graph.toolboxes.iter().find(|known| known.name == *toolbox);
    let (module, name) = (path(found.map_or("crate", |toolbox| &toolbox.rust_path)), camel());
    quote!(#module::templates::#name)
}

fn reader(
    core: &TokenStream,
    type_paths: &TypePaths<'_>,
    (table, name): (&Table, &Ident),
    template: &Template,
) -> TokenStream {
    let about = doc("", &format!("The table `{}`.", table.name));
    let fields: Vec<_> = template.outputs.iter().map(|port| ident(&snake(&port.name))).collect();
    let types: Vec<_> = template.outputs.iter().map(|port| &port.ty).collect();
    let owned = types.iter().map(|ty| type_paths.value(ty));
    let stored = types.iter().map(|ty| stored(type_paths, ty));
    let cells: Vec<_> = (0..fields.len()).map(|column| format_ident!("cell_{column}")).collect();
    let given = types.iter().zip(fields.iter().zip(&cells)).map(|(ty, (field, cell))| match ty {
        Type::Text => quote!(#field: #core::Text::try_from(*#cell)?),
        _ => quote!(#field: *#cell),
    });
    let rows = table.rows.iter().map(|row| {
        let values = row.iter().zip(&types).map(|(cell, ty)| value(type_paths, ty, cell));
        quote!((#(#values,)*))
    });
    let count = Literal::usize_unsuffixed(table.rows.len());
    let implemented = implemented(core);
    quote! {
        #about
        pub mod #name {
            pub use #core::rt::RowInputs as Inputs;

            /// The states, the first one with the columns as outputs.
            #[derive(Clone, Debug, PartialEq)]
            pub enum State {
                /// The row exists.
                Row { #(#fields: #owned,)* },
                /// The index is after the last row.
                End,
            }

            /// Reads a row.
            #[derive(Clone, Copy, Debug)]
            pub struct Row;

            static ROWS: [(#(#stored,)*); #count] = [#(#rows,)*];

            #implemented

            impl #core::Computation<Row> for Row {
                fn compute(inputs: Inputs) -> Result<State, #core::Fault> {
                    Ok(match #core::rt::row(&ROWS, inputs.index) {
                        Some((#(#cells,)*)) => State::Row { #(#given,)* },
                        None => State::End,
                    })
                }
            }
        }
    }
}

/// The description of ports and states for the scheduler.
fn implemented(core: &TokenStream) -> TokenStream {
    quote! {
        impl #core::ComputationTemplate for Row {
            type Inputs<'a> = Inputs;
            type State = State;
        }

        impl #core::rt::Outcome for State {
            fn index(&self) -> u16 {
                match self {
                    State::Row { .. } => 0,
                    State::End => 1,
                }
            }

            fn give(self, _: &mut dyn #core::rt::Outputs) {}
        }
    }
}

/// The type of a value in a static.
fn stored(type_paths: &TypePaths<'_>, ty: &Type) -> TokenStream {
    match ty {
        Type::Text => quote!(&str),
        ty => type_paths.value(ty),
    }
}

fn value(type_paths: &TypePaths<'_>, ty: &Type, cell: &Cell) -> TokenStream {
    match (&cell.value, ty) {
        (Constant::Bool(value), _) => quote!(#value),
        (Constant::Int(value), _) => int(*value),
        (Constant::Float(value), Type::Quantity(dimension)) => {
            type_paths.constant(*dimension, *value)
        }
        (Constant::Float(value), _) => type_paths.constant(Dimension::NONE, *value),
        (Constant::Text(text), _) => text.as_str().to_token_stream(),
        (Constant::Choice(place), Type::Enum(choices)) => {
            let (path, variant) = (type_paths.value(ty), variant(choices, *place));
            quote!(#path::#variant)
        }
        // The check allows no other value in a cell.
        _ => TokenStream::new(),
    }
}
