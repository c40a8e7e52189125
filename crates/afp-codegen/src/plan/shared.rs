//! The common parts of a graph's plans: enums of their files, and units for strings.

use afp_types::Scale;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::Module;
use crate::Options;
use crate::enums::{self, FileEnum};
use crate::layout::doc;
use crate::names::{UniqueNames, camel, ident, units_name};
use crate::rust_type::int;
use afp_dsl::graph::{EntryKind, Formula, Graph, Op};
use afp_dsl::types::readable::{ReadableUnit, readable};
use afp_dsl::types::{Conversion, Dimension, Type};

/// The modules `enums` and `units`, if they are not empty.
pub fn modules(graph: &Graph, enums: &[FileEnum], options: &Options) -> Vec<Module> {
    let core = &options.core;
    let mut modules = Vec::new();
    if !enums.is_empty() {
        let items = enums.iter().map(|(choices, name)| enums::choices(core, choices, name));
        modules.push(Module {
            name: ident("enums"),
            doc: "The enums of the plan files.".to_owned(),
            imports: TokenStream::new(),
            sections: vec![("Enums", quote!(#(#items)*))],
            span: graph.main().span,
        });
    }
    let dimensions = dimensions_of(graph);
    if !dimensions.is_empty() {
        let items = dimensions.iter().map(|dimension| units(*dimension));
        modules.push(Module {
            name: ident("units"),
            doc: "The units of quantities in strings.".to_owned(),
            imports: quote!(use #core::rt::{Scale, Unit};),
            sections: vec![("Units", quote!(#(#items)*))],
            span: graph.main().span,
        });
    }
    modules
}

fn units(dimension: Dimension) -> TokenStream {
    let name = units_name(dimension);
    let rows: Vec<_> = readable(dimension).iter().map(unit).collect();
    let count = Literal::usize_unsuffixed(rows.len());
    let about = doc("", &format!("Units of `{}`.", dimension.name()));
    quote!(#about pub static #name: [Unit<'static>; #count] = [#(#rows),*];)
}

fn unit(unit: &ReadableUnit) -> TokenStream {
    let name = &unit.name;
    let scale = match unit.scale {
        Scale::Decimal(shift) => {
            let shift = int(shift);
            quote!(Decimal(#shift))
        }
        Scale::Fraction { times, by, shift, degrees } => {
            let [times, by] = [times, by].map(Literal::u64_unsuffixed);
            let [shift, degrees] = [shift, degrees].map(int);
            quote!(fraction(#times, #by, #shift, #degrees))
        }
        Scale::Celsius => quote!(Celsius),
    };
    quote!(Unit { name: #name, scale: Scale::#scale })
}

/// The enums of the plan files in entries or formulas, in the order of first use.
pub fn enums_of(graph: &Graph) -> Vec<FileEnum> {
    let mut enums: Vec<FileEnum> = Vec::new();
    let mut names = UniqueNames::default();
    types(graph, &mut |ty| {
        if let Type::Enum(choices) = ty
            && choices.toolbox.is_none()
            && !enums.iter().any(|(known, _)| known == choices)
        {
            let name = ident(&names.unique(camel(&choices.name)));
            enums.push((choices.clone(), name));
        }
    });
    enums
}

/// The dimensions that are read from strings: by external writers, and by conversions.
fn dimensions_of(graph: &Graph) -> Vec<Dimension> {
    let mut dimensions = Vec::new();
    let mut add = |ty: &Type| {
        if let Type::Quantity(dimension) = ty
            && *dimension != Dimension::NONE
            && !dimensions.contains(dimension)
        {
            dimensions.push(*dimension);
        }
    };
    for plan in &graph.plans {
        let open = |kind| matches!(kind, EntryKind::In | EntryKind::Var);
        plan.entries.iter().filter(|entry| open(entry.kind)).for_each(|entry| add(&entry.ty));
    }
    conversions(graph, &mut |conversion| {
        if let Conversion::FromText(ty) = conversion {
            add(ty);
        }
    });
    dimensions
}

fn formulas(graph: &Graph) -> impl Iterator<Item = &Formula> {
    graph.plans.iter().flat_map(|plan| {
        let elements = plan.elements.iter().flat_map(|element| &element.inputs);
        let supervisors = plan.supervisors.iter().flat_map(|supervisor| &supervisor.inputs);
        let entries = plan.entries.iter().filter_map(|entry| entry.init.as_ref());
        elements.chain(supervisors).chain(entries)
    })
}

/// Every type of an entry or a formula, and every type in a conversion.
fn types(graph: &Graph, see: &mut dyn FnMut(&Type)) {
    for plan in &graph.plans {
        plan.entries.iter().for_each(|entry| see(&entry.ty));
    }
    formulas(graph).for_each(|formula| formula.nodes().for_each(|node| see(&node.note.ty)));
    super::tables::types(graph, see);
    super::computations::all_types(graph, see);
}

fn conversions(graph: &Graph, see: &mut dyn FnMut(&Conversion)) {
    formulas(graph).for_each(|formula| {
        formula.nodes().for_each(|node| {
            if let Op::Convert(conversion) = &node.op {
                see(conversion);
            }
        });
    });
    for plan in &graph.plans {
        let elements = plan.elements.iter().flat_map(|element| &element.outputs);
        let outputs = elements.chain(plan.supervisors.iter().flat_map(|s| &s.outputs));
        outputs.filter_map(|output| output.conversion.as_ref()).for_each(&mut *see);
    }
}
