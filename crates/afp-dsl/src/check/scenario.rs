//! Scenarios: resolves names in their plan, checks types of values, orders times.
//!
//! A scenario is checked against the complete graph of its plan, so only if that has no errors.
//! Each kind of line has a submodule.

mod actions;
mod claims;
mod commits;
mod compare;
mod devices;
mod lines;
mod names;
mod often;
mod over;
mod paths;
mod resolve;
mod robot;
mod signals;
mod times;

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::check::formula::Scope;
use crate::check::names::{ambiguous, unknown};
use crate::check::range;
use crate::check::{Context, Members, PlanHead, Program, assemble};
use crate::gather::PlanFile;
use crate::graph::{self, EntryKind, Formula};
use crate::scenario::{Scenario, Start};
use crate::types::{Constant, Dimension, Type};
use afp_syntax::ast::{self, Item, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Sought, Words, list};
use afp_syntax::message;
use afp_syntax::unquote;

pub use actions::VERBS;
use lines::readable;
use over::Over;
use paths::Paths;
use resolve::Resolver;
use robot::Robot;
use times::Stretch;

/// The plans of a program, as far as they could be checked.
pub(super) struct Plans<'a> {
    /// By index in [`Program::plans`].
    pub plans: &'a [Option<graph::Plan>],
    /// Sub-plans before their users.
    pub order: &'a [usize],
    /// The components of each plan, complete or not.
    pub members: &'a [Members],
}

/// Checks the scenarios of all files and returns those of the first one.
pub(super) fn check(
    program: &Program<'_>,
    files: &[PlanFile],
    plans: &Plans<'_>,
    diags: &mut Diagnostics,
) -> Vec<Scenario> {
    let (mut checked, mut graphs) = (Vec::new(), Graphs::new());
    let robot = Robot::of(program);
    for (index, file) in files.iter().enumerate() {
        let mut named: Vec<Name> = Vec::new();
        for node in nodes(&file.tree) {
            let context = Context { program, file: &program.files[index] };
            if let Some(name) = node.name() {
                twice(&name, &mut named, diags);
            }
            let scenario = scenario(context, (files, &robot), (plans, &mut graphs), &node, diags);
            checked.extend(scenario.into_iter().flatten().filter(|_| index == 0));
        }
    }
    checked
}

/// The connected outputs of a declared outcome of a component, named by its path: each with its
/// position in the template, its name and its value's type. Empty for an unknown component.
pub fn outputs(graph: &graph::Graph, component: &str, outcome: u16) -> Vec<(u16, String, Type)> {
    let Some((plan, part)) = paths::by_path(graph, component) else { return Vec::new() };
    let outputs = paths::outputs(graph, plan, part, outcome).into_iter();
    outputs.map(|(index, port, ty)| (index, port.name.clone(), ty)).collect()
}

/// The plan of a file's first scenario with a known plan: the main plan if the file has none.
pub(super) fn first_plan(program: &Program<'_>, file: &PlanFile) -> Option<usize> {
    let known = &program.files.first()?.plans;
    let plan = |node: &ast::Scenario| known.get(&node.plan()?.name()?.text)?.first().copied();
    nodes(&file.tree).iter().find_map(plan)
}

fn nodes(file: &ast::File) -> Vec<ast::Scenario> {
    let scenarios = file.items().into_iter().filter_map(|item| match item {
        Item::Scenario(scenario) => Some(scenario),
        _ => None,
    });
    scenarios.collect()
}

fn twice(name: &Name, named: &mut Vec<Name>, diags: &mut Diagnostics) {
    match named.iter().find(|known| known.text == name.text) {
        Some(first) => diags.push(
            Diagnostic::new(Code::E0212, name.span, "two scenarios have this name")
                .note(first.span, "the first one")
                .help("give one of them another name"),
        ),
        None => named.push(name.clone()),
    }
}

/// Graphs of the scenarios' plans, by index; scenarios of one plan share its graph.
type Graphs = BTreeMap<usize, Option<Arc<graph::Graph>>>;

struct Checker<'a> {
    context: Context<'a>,
    paths: Paths<'a>,
    robot: &'a Robot<'a>,
    head: &'a PlanHead,
}

fn scenario(
    context: Context<'_>,
    (files, robot): (&[PlanFile], &Robot<'_>),
    (plans, graphs): (&Plans<'_>, &mut Graphs),
    node: &ast::Scenario,
    diags: &mut Diagnostics,
) -> Option<Vec<Scenario>> {
    let index = node.plan().and_then(|reference| plan(context, &reference, diags));
    let program = context.program;
    let resolver = Resolver { program, members: plans.members };
    names::record(context, &resolver, robot, index, &node.lines());
    let (name, index) = (node.name()?, index?);
    let assembled = || {
        let plan = |place: usize| plans.plans[place].clone();
        assemble::graph(program, plan, plans.order, index).map(Arc::new)
    };
    let graph = graphs.entry(index).or_insert_with(assembled).clone()?;
    let head = &program.plans[index];
    let lines = readable(node.lines(), diags);
    let stretch = Stretch::of(&lines, None, diags);
    let paths = Paths::new(&graph, resolver, index);
    let checker = Checker { context, paths, robot, head };
    let plan_file = &files.get(head.file)?.source.name;
    let mut scenario = Scenario {
        span: name.span,
        ..Scenario::quiet(unquote(&name, diags), graph.clone(), plan_file, stretch.until)
    };
    checker.lines(&lines, &stretch, &mut scenario, diags);
    let over = Over::of(&lines, diags);
    let broken = diags.error_within(node.span());
    if scenario.expectations.is_empty() && !broken {
        diags.push(
            Diagnostic::new(Code::E0609, name.span, "the scenario expects nothing")
                .help("add a line such as 'expect end' or 'never end'"),
        );
    }
    checker.inputs(&scenario, node, &name, diags);
    scenario.stimuli.sort_by_key(|stimulus| stimulus.at);
    Some(over.runs(scenario))
}

/// The index of a scenario's plan.
fn plan(context: Context<'_>, reference: &ast::Ref, diags: &mut Diagnostics) -> Option<usize> {
    let name = reference.name()?;
    let known = &context.file.plans;
    let found = known.get(&name.text).map_or(&[][..], Vec::as_slice);
    let record = context.program.record;
    match (found, reference.home()) {
        ([index], None) => {
            let head = &context.program.plans[*index];
            let span = head.name.as_ref().map_or_else(|| head.node.span(), |name| name.span);
            record.definition(name.span, span);
        }
        ([_, _, ..], None) => {
            let heads = found.iter().filter_map(|index| context.program.plans.get(*index));
            record.several(name.span, heads.filter_map(|head| Some(head.name.as_ref()?.span)));
        }
        (_, home) => {
            record.unknown(name.span);
            home.iter().for_each(|home| context.file.types.qualifier(home, record));
        }
    }
    match (found, reference.home()) {
        ([index], None) => Some(*index),
        ([_, _, ..], None) => {
            let plans = found.iter().map(|index| &context.program.plans[*index]);
            let span = |head: &PlanHead| head.name.as_ref().map_or(head.node.span(), |n| n.span);
            let places: Vec<_> = plans.map(|head| (None, span(head))).collect();
            diags.push(ambiguous("a plan", &name.text, reference.span(), &places));
            None
        }
        _ if context.file.incomplete => None,
        _ => {
            let message = message!("there is no plan '{}'", name.text);
            let mut names: Vec<_> = known.keys().map(String::as_str).collect();
            names.sort_unstable();
            let none = "declare it in this file, or use its file: 'use \"plans/patrol.afp\"'";
            let error = unknown(Code::E0201, reference.span(), message, &name.text, names, none);
            diags.push(error.unknown(Sought::Template, &name.text));
            None
        }
    }
}

impl Checker<'_> {
    fn robot(&self, formulas: &[ast::Formula], diags: &mut Diagnostics) -> Option<Start> {
        let [x, y, heading @ ..] = formulas else { return None };
        let number = |formula: &ast::Formula, ty: &str, diags: &mut Diagnostics| {
            let ty = Type::Quantity(Dimension::named(ty)?);
            match self.constant(formula, &ty, diags)?.1 {
                Constant::Float(number) => Some(number),
                _ => None,
            }
        };
        let (x, y) = (number(x, "length", diags), number(y, "length", diags));
        let heading = match heading.first() {
            Some(heading) => number(heading, "angle", diags),
            None => Some(0.0),
        };
        Some(Start { x: x?, y: y?, heading: heading? })
    }

    /// A value of type `ty`, which may use constants of the plan.
    fn constant(
        &self,
        formula: &ast::Formula,
        ty: &Type,
        diags: &mut Diagnostics,
    ) -> Option<(Formula, Constant)> {
        self.constant_as(formula, |_| ty.clone(), diags)
    }

    /// Like [`Self::constant`], with the wanted type instead of its own.
    fn constant_as(
        &self,
        formula: &ast::Formula,
        want: impl Fn(&Type) -> Type,
        diags: &mut Diagnostics,
    ) -> Option<(Formula, Constant)> {
        let entries = &self.head.entries;
        let known = |index: usize| {
            let entry = &entries[index];
            entry.kind == EntryKind::Const && entry.value.is_some()
        };
        let scope = Scope {
            types: &self.context.file.types,
            tables: &[],
            entries,
            indices: &self.head.indices,
            readable: &known,
            unreadable: "write a value; a scenario knows only the values of 'const' entries",
            text: self.context.file.text,
            record: self.context.program.record,
        };
        let typed = scope.infer(formula, diags)?;
        let want = want(&typed.ty);
        let (formula, value) = scope.finish(typed, Some(&want), None, diags)?;
        Some((formula, value?))
    }

    /// An entry of the outermost plan and a value for it.
    fn set(
        &self,
        path: &ast::Path,
        value: &ast::Formula,
        kinds: &[EntryKind],
        diags: &mut Diagnostics,
    ) -> Option<(u16, Constant)> {
        let (_, plan, id) =
            self.paths.entry(&path.names()).map_err(|error| diags.push(*error)).ok()?;
        let entry = &self.paths.graph.plan(plan).entries[id.index()];
        let outermost = plan == self.paths.graph.main && path.names().len() == 1;
        if !outermost || !kinds.contains(&entry.kind) {
            let message = message!("'{}' cannot be set here", path.text());
            let help = match (outermost, kinds.len()) {
                (false, _) => "set an entry of the scenario's plan, not of a sub-plan",
                (true, 1) => {
                    "set an 'in' entry; the plan gives all others their first value itself"
                }
                (true, _) => "set an 'in' or 'var' entry",
            };
            diags.push(
                Diagnostic::new(Code::E0607, path.span(), message)
                    .note(entry.span, "declared here")
                    .help(help),
            );
            return None;
        }
        if let Type::Object(_) = entry.ty {
            let message = message!("'{}' is an object, which only components can make", entry.name);
            diags.push(
                Diagnostic::new(Code::E0607, path.span(), message)
                    .note(entry.span, "declared here")
                    .help("remove the line"),
            );
            return None;
        }
        let (formula, value) = self.constant(value, &entry.ty, diags)?;
        let message =
            |value: String| message!("'{}' is out of the range of '{}'", value, entry.name);
        let outside = |range| range::outside(&value, range, &entry.ty, formula.span, message);
        if let Some(error) = entry.range.and_then(outside) {
            diags.push(error.note(entry.span, "the range is declared here"));
            return None;
        }
        Some((id.0, value))
    }

    /// Reports `in` entries without a value.
    fn inputs(
        &self,
        scenario: &Scenario,
        node: &ast::Scenario,
        name: &Name,
        diags: &mut Diagnostics,
    ) {
        let plan = self.paths.graph.main();
        let drafts = &self.paths.names.program.plans[self.paths.main].entries;
        // An invalid default has been reported.
        let has_default =
            |index: &u16| drafts.get(usize::from(*index)).is_some_and(|it| it.has_init);
        let missing = (0..).zip(&plan.entries).filter(|(index, entry)| {
            entry.kind == EntryKind::In
                && !has_default(index)
                && !scenario.set.iter().any(|(set, _)| set == index)
        });
        let missing: Vec<_> = missing.map(|(_, entry)| entry).collect();
        if missing.is_empty() || diags.error_within(node.span()) {
            return;
        }
        let names = list(missing.iter().map(|entry| entry.name.as_str()), "and");
        let verb = if missing.len() == 1 { "has" } else { "have" };
        let message = message!("{} of '{}' {} no value", names, plan.name, Words(verb));
        let first = &missing[0];
        diags.push(
            Diagnostic::new(Code::E0225, name.span, message)
                .note(first.span, "declared here without a default")
                .help(message!("add 'set {} = ...'", first.name)),
        );
    }
}

fn seed(number: &Name, diags: &mut Diagnostics) -> Option<u64> {
    let seed = number.text.parse().ok();
    if seed.is_none() {
        diags.push(
            Diagnostic::new(Code::E0224, number.span, "the seed does not fit 64 bits")
                .help("write a smaller number"),
        );
    }
    seed
}
