//! The `use` items of a plan's module: exactly the names that its code uses.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::quote;

use crate::names::{ident, path};
use afp_dsl::graph::{Function, Graph};

/// The names at the root of `afp_core`.
const CORE: &[&str] = &[
    "Duration",
    "Environment",
    "Events",
    "Fault",
    "Reason",
    "Text",
    "TypedEntry",
    "Value",
    "ValueRef",
    "WriteError",
];
/// Names of `afp_core::rt` besides the functions of formulas.
const RT: &[&str] = &[
    "Actor",
    "AtElement",
    "BadValue",
    "Child",
    "Committer",
    "ComponentRow",
    "Cx",
    "ElementId",
    "ElementKind",
    "ElementRow",
    "Entry",
    "EntryRow",
    "Fired",
    "Kept",
    "Machine",
    "NameTable",
    "NamedPlan",
    "Object",
    "OnReturn",
    "Plan",
    "PlanState",
    "PlanTable",
    "Polled",
    "PortRow",
    "Range",
    "ReasonId",
    "Resumable",
    "Run",
    "Scale",
    "SetAside",
    "Slot",
    "Started",
    "Supervisor",
    "SupervisorId",
    "SupervisorRow",
    "Tables",
    "Target",
    "Timing",
    "Unit",
    "bool_to_float",
    "bool_to_int",
    "divisor",
    "finite",
    "float_to_int",
    "initial",
    "input",
    "int_add",
    "int_mul",
    "int_neg",
    "int_rem",
    "int_sub",
    "int_to_float",
    "join",
    "limited",
    "order",
    "output",
    "parse_bool",
    "parse_float",
    "parse_int",
    "parse_quantity",
    "print_choice",
    "print_quantity",
    "read_choice",
    "rem",
    "set_input",
    "stage_outside",
    "store_text",
];
/// The names in `afp_core::quantity`.
const QUANTITY: &[&str] = &[
    "Acceleration",
    "Angle",
    "AngularSpeed",
    "Force",
    "Frequency",
    "Length",
    "Mass",
    "Quantity",
    "Speed",
    "Temperature",
    "Time",
    "Voltage",
];
/// The names in `afp_core::trace`.
const TRACE: &[&str] = &[
    "ComponentId",
    "ComponentKind",
    "ComponentName",
    "EntryKind",
    "EntryName",
    "Reaction",
    "Sink",
];

/// All imported names that code of a module uses without a path.
pub fn imported() -> impl Iterator<Item = &'static str> {
    [CORE, QUANTITY, TRACE].into_iter().flatten().copied().chain(in_rt())
}

/// All names of `afp_core::rt`, in order.
fn in_rt() -> BTreeSet<&'static str> {
    let functions = Function::ALL.iter();
    let functions = functions.flat_map(|it| [true, false].map(|ints| it.rust_name(ints)));
    functions.chain(RT.iter().copied()).collect()
}

/// The imports for the sections.
pub fn imports(
    core: &TokenStream,
    graph: &Graph,
    aliases: &[Ident],
    sections: &[(&'static str, TokenStream)],
) -> TokenStream {
    let (items, used) = (of_core(core, sections), used(sections));
    let toolboxes = graph.toolboxes.iter().zip(aliases);
    let files = toolboxes.filter(|(toolbox, _)| toolbox.is_named());
    let toolboxes = files.filter_map(|(toolbox, alias)| {
        let module = path(&toolbox.rust_path);
        let item = quote!(use #module::templates as #alias;);
        used.contains(&alias.to_string()).then_some(item)
    });
    quote! {
        #items
        #(#toolboxes)*
    }
}

pub fn of_core(core: &TokenStream, sections: &[(&'static str, TokenStream)]) -> TokenStream {
    let used = used(sections);
    let groups = [
        (quote!(#core), CORE.to_vec()),
        (quote!(#core::quantity), QUANTITY.to_vec()),
        (quote!(#core::rt), in_rt().into_iter().collect()),
        (quote!(#core::trace), TRACE.to_vec()),
    ];
    let items = groups.into_iter().filter_map(|(module, names)| {
        let names = names.into_iter().filter(|name| used.contains(*name));
        let names: Vec<Ident> = names.map(ident).collect();
        match names.as_slice() {
            [] => None,
            [name] => Some(quote!(use #module::#name;)),
            names => Some(quote!(use #module::{#(#names),*};)),
        }
    });
    items.collect()
}

/// The identifiers that begin the paths of the sections.
fn used(sections: &[(&'static str, TokenStream)]) -> BTreeSet<String> {
    let mut used = BTreeSet::new();
    for (_, tokens) in sections {
        names(tokens.clone(), &mut used);
    }
    used
}

/// The identifiers at the start of a path.
fn names(tokens: TokenStream, used: &mut BTreeSet<String>) {
    let mut before = [' '; 2];
    for token in tokens {
        let inside = before == [':'; 2] || before[1] == '.';
        match &token {
            TokenTree::Ident(ident) if !inside => {
                used.insert(ident.to_string());
            }
            TokenTree::Group(group) => names(group.stream(), used),
            _ => {}
        }
        before = match &token {
            TokenTree::Punct(punct) => [before[1], punct.as_char()],
            _ => [' '; 2],
        };
    }
}
