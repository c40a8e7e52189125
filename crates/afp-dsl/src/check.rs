//! From the trees of plan files to the static graph.
//!
//! Each rule has a submodule. All rules run on everything that was parsed, so that the errors of
//! all files are reported at once; the graph exists only without errors.

mod assemble;
pub(crate) mod bindings;
mod callee;
mod choices;
mod computations;
mod consequences;
mod convert;
mod draft;
pub(crate) mod edges;
mod endings;
mod entries;
mod enums;
mod foreign;
mod formula;
mod head;
mod imports;
mod meant;
mod mistaken;
mod names;
mod outline;
pub(crate) mod partial;
mod places;
mod plan;
mod program;
mod range;
mod reactions;
mod recursion;
mod resources;
mod resume;
pub(crate) mod scenario;
mod scope;
pub(crate) mod signature;
mod size;
mod suspend;
mod synonyms;
mod tables;
pub(crate) mod timing;
pub(crate) mod toolbox;
mod types;
pub mod watch;
mod written;

use crate::flow::{self, Model};
use crate::gather::{PlanFile, Toolboxes};
use crate::graph::{self, Graph};
use crate::index::{self, Declared, Index, Meanings, Recorder};
use crate::outline::Outline;
use crate::scenario::Scenario;
use afp_syntax::ast::{Item, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, list};
use afp_syntax::message;

pub(crate) use head::PlanHead;
use outline::Material;
use partial::{Partial, Parts};
pub(crate) use plan::Members;
pub(crate) use scope::{Context, Program};
use toolbox::names_only;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    Checked,
    /// For tests of invalid plans at run time.
    Unchecked,
}

/// Results of the check; no graph and scenarios if anything except scenarios has errors.
#[derive(Default)]
pub(crate) struct Checked {
    /// The graph of the main plan.
    pub graph: Option<Graph>,
    /// The known parts of a main plan with errors.
    pub partial: Option<Partial>,
    /// The scenarios of the first file.
    pub scenarios: Vec<Scenario>,
    /// Contents of the files, with or without errors.
    pub outline: Outline,
    /// Meanings of names, with or without errors.
    pub index: Index,
}

/// Checks plan files and builds the graph of the plan `main` of the first file. Defaults to its
/// first plan or, in a file with only scenarios, to the plan of the first scenario.
pub(crate) fn check(
    files: &[PlanFile],
    toolboxes: &Toolboxes,
    main: Option<&str>,
    flow: Flow,
    diags: &mut Diagnostics,
) -> Checked {
    for file in files {
        imports::check_version(&file.tree, diags);
        imports::check_order(&file.tree, diags);
        imports::check_no_templates(&file.tree, diags);
    }
    let bytes: usize = files.iter().map(|file| file.source.text.len()).sum();
    let record = Recorder::for_text(bytes);
    let program = program::program(files, toolboxes, &record, diags);
    let order = recursion::order(&program, diags);
    let (mut plans, mut inputs) = (Vec::new(), Vec::new());
    let (mut users, mut members) = (Vec::new(), Vec::new());
    for place in 0..program.plans.len() {
        let checked = plan::check(&program, place, diags);
        plans.push(checked.plan);
        inputs.push(checked.inputs);
        users.push(checked.users);
        members.push(checked.members);
    }
    resources::check(&program.plans, &users, &order, diags);
    size::check(&program, &plans, &order, diags);
    if flow == Flow::Checked {
        check_flow(&program, &plans, &order, diags);
    }
    let ready = scenario::Plans { plans: &plans, order: &order, members: &members };
    let scenarios = scenario::check(&program, files, &ready, diags);
    read_by_scenarios(&program, files, diags);
    consequences::hold_back(&program, files, diags);
    let main = files.first().and_then(|file| select(&program, file, main, diags));
    note_files(files, &record);
    let (meanings, declared) = names(files, toolboxes, &record, diags);
    let material = Material { program: &program, files, members, meanings: &meanings, main };
    let outline = outline::build(material);
    let index = index::build(&outline, &meanings, declared);
    let mut checked = Checked { outline, index, ..Checked::default() };
    let Some(main) = main else { return checked };
    if checked.outline.excuses(diags) {
        let graph = assemble::graph(&program, |place| plans[place].take(), &order, main);
        return Checked { graph, scenarios, ..checked };
    }
    let parts = plans.into_iter().zip(inputs).map(|(plan, inputs)| Parts { plan, inputs });
    let wanted = (&*order, main);
    checked.partial = partial::partial(&program, parts.collect(), &checked.outline, wanted, diags);
    checked
}

/// Withdraws warnings of unread entries that scenarios use.
fn read_by_scenarios(program: &Program<'_>, files: &[PlanFile], diags: &mut Diagnostics) {
    let items = files.iter().flat_map(|file| file.tree.items());
    let scenarios = items.filter_map(|item| match item {
        Item::Scenario(scenario) => Some(scenario.span()),
        _ => None,
    });
    let scenarios: Vec<_> = scenarios.collect();
    if !scenarios.is_empty() {
        let is_read = |entry| program.record.is_named_within(entry, &scenarios);
        diags.retain(|each| each.code != Code::E0304 || !is_read(each.span));
    }
}

/// Meanings of all names, and declarations of toolboxes.
fn names(
    files: &[PlanFile],
    toolboxes: &Toolboxes,
    record: &Recorder,
    diags: &Diagnostics,
) -> (Meanings, Vec<Declared>) {
    let mut declared = toolboxes.declared().to_vec();
    let is_tool = |item: &Item| match item {
        Item::Template(node) => !node.is_declared(),
        item => matches!(item, Item::Toolbox(_) | Item::Object(_) | Item::Device(_)),
    };
    let items: Vec<_> = files.iter().map(|file| file.tree.items()).collect();
    for (file, items) in files.iter().zip(&items) {
        if items.iter().any(is_tool) {
            names_only(&file.tree, &file.source, file.index, record);
        }
    }
    let mut own = Meanings::new(record.take());
    for (file, items) in files.iter().zip(&items) {
        if items.iter().any(is_tool) {
            declared.extend(index::of_toolbox(items, &own));
        } else {
            let templates = items.iter().filter_map(|item| match item {
                Item::Template(node) => Some(node),
                _ => None,
            });
            templates.for_each(|node| index::of_template(node, None, &own, &mut declared));
        }
        if diags.error_within(file.whole()) {
            index::unread(file.tree.root(), file.index, &mut own);
        }
    }
    let mut meanings = toolboxes.meanings().clone();
    meanings.extend(own);
    (meanings, declared)
}

/// Records the meanings of paths after `use`.
fn note_files(files: &[PlanFile], record: &Recorder) {
    for file in files {
        let paths = file.tree.items().into_iter().filter_map(|item| match item {
            Item::Use(line) => line.path(),
            _ => None,
        });
        paths.for_each(|path| record.unknown(path.span));
        for (path, used) in &file.paths {
            record.file(*path, files[*used].index);
        }
    }
}

/// Checks the flow of every plan without errors.
fn check_flow(
    program: &Program<'_>,
    plans: &[Option<graph::Plan>],
    order: &[usize],
    diags: &mut Diagnostics,
) {
    let valid = |(head, plan): (&PlanHead, _)| {
        Option::filter(plan, |_| !diags.error_within(head.node.span()))
    };
    let valid = program.plans.iter().zip(plans.iter().map(Option::as_ref)).map(valid).collect();
    let toolboxes = program.linked.clone();
    flow::check(&Model { plans: valid, order: order.to_vec(), toolboxes }, diags);
}

/// Reports a type that shadows a built-in one.
pub(crate) fn shadows(name: &Name, diags: &mut Diagnostics) {
    let message = message!("'{}' is a type of the language", name.text);
    diags.push(Diagnostic::new(Code::E0213, name.span, message).help("choose another name"));
}

/// Index of the main plan, one of the first file.
fn select(
    program: &Program<'_>,
    file: &PlanFile,
    main: Option<&str>,
    diags: &mut Diagnostics,
) -> Option<usize> {
    let name = |head: &PlanHead| head.name.as_ref().map(|name| name.text.clone());
    let own = || program.plans.iter().filter(|head| head.file == 0);
    if let Some(main) = main {
        let index = own().position(|head| name(head).as_deref() == Some(main));
        if index.is_none() {
            let names: Vec<_> = own().filter_map(name).collect();
            let message = message!("the file has no plan '{}'", main);
            let help = match names.as_slice() {
                [] => "add a plan of that name".into(),
                names => message!("name {}", list(names.iter().map(String::as_str), "or")),
            };
            let top = file.whole().before();
            diags.push(Diagnostic::new(Code::E0504, top, message).help(help));
        }
        return index;
    }
    if own().next().is_none()
        && let Some(index) = scenario::first_plan(program, file)
    {
        return Some(index);
    }
    let empty = own().next().is_none();
    if empty && !diags.has_errors() {
        diags.push(no_plan(file));
    }
    (!empty).then_some(0)
}

fn no_plan(file: &PlanFile) -> Diagnostic {
    let head = file.tree.items().into_iter().find_map(|item| match item {
        Item::Toolbox(head) => head.name(),
        _ => None,
    });
    match head {
        Some(name) => {
            let message = message!("the file is the toolbox '{}' and has no plan", name.text);
            Diagnostic::new(Code::E0503, name.span, message)
                .help("name a file with a plan that uses the toolbox")
        }
        None => Diagnostic::new(Code::E0503, file.whole().before(), "the file has no plan")
            .help("add one, such as 'plan Patrol { ... }'"),
    }
}
