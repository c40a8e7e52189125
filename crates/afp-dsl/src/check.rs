//! From the tree of a plan file to the static graph.
//!
//! One rule, one submodule. All rules run on everything that could be read, so that all errors of a
//! file come at once; the graph comes only when there are none.

mod bindings;
mod callee;
mod constant;
mod convert;
mod edges;
mod endings;
mod entries;
pub(crate) mod enums;
pub(crate) mod formula;
pub(crate) mod imports;
pub(crate) mod names;
mod plan;
mod recursion;
mod resources;
mod signature;
pub(crate) mod text;
pub(crate) mod timing;
pub(crate) mod types;

use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::flow::{self, Model};
use crate::graph::{self, Component, Graph, PlanId};
use crate::source::Span;
use crate::syntax::ast::{self, File, Item, Name};
use crate::toolbox::Toolboxes;
use crate::words;

use entries::EntryDraft;
use imports::Import;
use names::{Names, Places};
use types::Types;

/// A file and everything that its plans can name.
pub(crate) struct Context<'a> {
    /// All toolboxes that could be used.
    pub toolboxes: &'a Toolboxes,
    /// Those that are.
    pub imports: Vec<Import>,
    /// The types that can be named.
    pub types: Types,
    /// The plans of the file.
    pub plans: Vec<PlanHead>,
    /// The text of the file.
    pub text: &'a str,
    /// Where a `use` line can be added.
    pub top: Span,
}

/// What other plans need to know of a plan.
pub(crate) struct PlanHead {
    /// The plan as written.
    pub node: ast::Plan,
    /// Its name.
    pub name: Option<Name>,
    /// Its entries.
    pub entries: Vec<EntryDraft>,
    /// Where the entries stand.
    pub places: Places,
    /// The edge by which it can end as `Interrupted`.
    pub interrupting: Option<Span>,
}

/// Whether flow is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    /// As everywhere.
    Checked,
    /// For tests of what the run time does with plans that the checks refuse.
    Unchecked,
}

/// Checks a plan file and builds the graph of the plan `main`, or of the first one.
///
/// `whole` is the place of the whole text.
pub(crate) fn check(
    file: &File,
    text: &str,
    whole: Span,
    toolboxes: &Toolboxes,
    main: Option<&str>,
    flow: Flow,
    diags: &mut Diagnostics,
) -> Option<Graph> {
    imports::check_version(file, diags);
    imports::check_order(file, diags);
    imports::check_no_templates(file, diags);
    let context = context(file, text, whole, toolboxes, diags);
    let order = recursion::order(&context.plans, diags);
    let (plans, users): (Vec<_>, Vec<_>) =
        (0..context.plans.len()).map(|place| plan::check(&context, place, diags)).unzip();
    resources::check(&context.plans, &users, &order, diags);
    scenarios(file, diags);
    if flow == Flow::Checked {
        check_flow(&context, &plans, &order, diags);
    }
    let main = select(&context, file, main, whole, diags)?;
    if diags.has_errors() {
        return None;
    }
    assemble(&context, plans, &order, main)
}

/// Checks the flow of every plan that has no error so far.
fn check_flow(
    context: &Context<'_>,
    plans: &[Option<graph::Plan>],
    order: &[usize],
    diags: &mut Diagnostics,
) {
    let sound = |(head, plan): (&PlanHead, _)| {
        Option::filter(plan, |_| !diags.error_within(head.node.span()))
    };
    let sound = context.plans.iter().zip(plans.iter().map(Option::as_ref)).map(sound).collect();
    let toolboxes = context.imports.iter().map(|import| import.toolbox.clone()).collect();
    flow::check(&Model { plans: sound, order: order.to_vec(), toolboxes }, diags);
}

fn context<'a>(
    file: &File,
    text: &'a str,
    whole: Span,
    toolboxes: &'a Toolboxes,
    diags: &mut Diagnostics,
) -> Context<'a> {
    let (imports, incomplete) = imports::read(file, toolboxes, diags);
    let types = Types { incomplete, ..types(file, &imports, diags) };
    let nodes = file.items().into_iter().filter_map(|item| match item {
        Item::Plan(plan) => Some(plan),
        _ => None,
    });
    let plans: Vec<_> = nodes
        .map(|node| {
            let (entries, places) = entries::read(&node, &types, text, diags);
            let interrupting = endings::interrupting(&node);
            PlanHead { name: node.name(), entries, places, interrupting, node }
        })
        .collect();
    let mut names = Names::default();
    for name in plans.iter().filter_map(|plan| plan.name.as_ref()) {
        names.declare(name, diags);
    }
    let below_version = file.version().map_or(whole.before(), |version| {
        let line =
            text[version.span.end as usize..].find('\n').map_or(text.len() as u32, |length| {
                version.span.end + u32::try_from(length + 1).unwrap_or(0)
            });
        Span { start: line, end: line, ..version.span }
    });
    Context { toolboxes, imports, types, plans, text, top: below_version }
}

/// The enums and object types of the file and its toolboxes.
fn types(file: &File, imports: &[Import], diags: &mut Diagnostics) -> Types {
    let mut types = Types::default();
    let mut names = Names::default();
    for item in file.items() {
        let Item::Enum(node) = item else { continue };
        let Some(home) = enums::read(&node, None, diags) else { continue };
        let name = Name { text: home.name.clone(), span: home.span };
        if Types::is_built_in(&name.text) {
            shadows(&name, diags);
        } else if names.declare(&name, diags) {
            types.enums.push((None, home));
        }
    }
    for import in imports {
        let qualifier = || Some(import.qualifier.clone());
        types.enums.extend(import.toolbox.enums.iter().map(|each| (qualifier(), each.clone())));
        types.objects.extend(import.toolbox.objects.iter().map(|each| (qualifier(), each.clone())));
    }
    types
}

/// Reports a type that hides one of the language.
pub(crate) fn shadows(name: &Name, diags: &mut Diagnostics) {
    let message = format!("'{}' is a type of the language", name.text);
    diags.push(Diagnostic::new(Code::E0213, name.span, message).help("choose another name"));
}

fn scenarios(file: &File, diags: &mut Diagnostics) {
    for item in file.items() {
        if let Item::Scenario(scenario) = item {
            let Some(Name { span, .. }) = scenario.name() else { continue };
            diags.push(
                Diagnostic::new(
                    Code::E0502,
                    span,
                    "scenarios cannot be run yet; this one is only read",
                )
                .help("run the plan itself, or wait for a version with 'afpc test'"),
            );
        }
    }
}

/// The plan to run, by its place in the file.
fn select(
    context: &Context<'_>,
    file: &File,
    main: Option<&str>,
    whole: Span,
    diags: &mut Diagnostics,
) -> Option<usize> {
    let name = |head: &PlanHead| head.name.as_ref().map(|name| name.text.clone());
    if let Some(main) = main {
        let place = context.plans.iter().position(|head| name(head).as_deref() == Some(main));
        if place.is_none() {
            let names: Vec<_> = context.plans.iter().filter_map(name).collect();
            let message = format!("the file has no plan '{main}'");
            let help = match names.as_slice() {
                [] => "add a plan of that name".to_owned(),
                names => format!("name {}", words::list(names.iter().map(String::as_str), "or")),
            };
            diags.push(Diagnostic::new(Code::E0504, whole.before(), message).help(help));
        }
        return place;
    }
    if context.plans.is_empty() && !diags.has_errors() {
        let head = file.items().into_iter().find_map(|item| match item {
            Item::Toolbox(head) => head.name(),
            _ => None,
        });
        diags.push(match head {
            Some(name) => Diagnostic::new(
                Code::E0503,
                name.span,
                format!("the file is the toolbox '{}' and has no plan", name.text),
            )
            .help("name a file with a plan that uses the toolbox"),
            None => Diagnostic::new(Code::E0503, whole.before(), "the file has no plan")
                .help("add one, such as 'plan Patrol { ... }'"),
        });
    }
    (!context.plans.is_empty()).then_some(0)
}

/// Puts the plans that `main` needs into one graph, sub-plans first.
fn assemble(
    context: &Context<'_>,
    mut plans: Vec<Option<graph::Plan>>,
    order: &[usize],
    main: usize,
) -> Option<Graph> {
    let mut needed = vec![false; plans.len()];
    let mut open = vec![main];
    while let Some(place) = open.pop() {
        if !std::mem::replace(&mut needed[place], true) {
            let used = recursion::sub_plans(&context.plans[place], &context.plans);
            open.extend(used.into_iter().map(|(used, _)| used));
        }
    }
    let chosen: Vec<_> = order.iter().copied().filter(|place| needed[*place]).collect();
    let id = |place: usize| {
        let found = chosen.iter().position(|known| *known == place)?;
        u16::try_from(found).ok().map(PlanId)
    };
    let mut drawn = Vec::with_capacity(chosen.len());
    for place in &chosen {
        let mut plan = plans[*place].take()?;
        for element in &mut plan.elements {
            if let Component::SubPlan(sub_plan) = &mut element.component {
                *sub_plan = id(sub_plan.index())?;
            }
        }
        drawn.push(plan);
    }
    let toolboxes = context.imports.iter().map(|import| import.toolbox.clone()).collect();
    Some(Graph { plans: drawn, main: id(main)?, toolboxes })
}
