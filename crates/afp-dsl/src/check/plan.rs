//! One plan: elements, supervisors, `start`.

mod component;
mod faults;

use std::rc::Rc;

use crate::check::edges::Elements;
use crate::check::formula::Scope;
use crate::check::head::EntryDraft;
use crate::check::names::{self, DeclaredNames, Indices};
use crate::check::places::Ranges;
use crate::check::reactions::Watchers;
use crate::check::resources::Users;
use crate::check::signature::Signature;
use crate::check::synonyms::Leads;
use crate::check::{Context, PlanHead, Program, edges, resume, size, suspend};
use crate::graph::{self, Element, ElementId, Formula, Supervisor, SupervisorId};
use crate::index::Recorder;
use crate::outline::Component;
use crate::rows::Table;
use crate::types::Type;
use afp_syntax::ast;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

use component::{Checked, Components};
use faults::Owner;

/// A plan, as far as it could be checked.
pub(crate) struct CheckedPlan {
    /// The plan for the graph; `None` if it is incomplete. [`graph::Component::SubPlan`] still has
    /// the index in [`Program::plans`].
    pub plan: Option<graph::Plan>,
    /// For an incomplete plan, the valid inputs of each element.
    pub inputs: Vec<Vec<Formula>>,
    pub users: Users,
    /// Names and templates of its components.
    pub members: Members,
}

/// Names and templates of a plan's components, as written.
#[derive(Default)]
pub(crate) struct Members {
    pub globals: Vec<Component>,
    /// The elements, each with its supervisors and reactions.
    pub elements: Vec<Component>,
    /// Signature of each supervisor: global ones, then those of each element.
    pub of_supervisors: Vec<Option<Rc<Signature>>>,
    pub of_elements: Vec<Option<Rc<Signature>>>,
    pub indices: Indices,
}

impl Members {
    /// Nothing yet, with room for this number of elements.
    fn with_elements(number: usize) -> Members {
        let mut members = Members::default();
        members.elements.reserve(number);
        members.of_elements.reserve(number);
        members
    }
}

pub(crate) fn check(program: &Program<'_>, index: usize, diags: &mut Diagnostics) -> CheckedPlan {
    let head = &program.plans[index];
    let context = Context { program, file: &program.files[head.file] };
    let elements = head.node.elements();
    let names = declare(head, &elements, program.record, diags);
    let scope = scope(context, head);
    let components = Components { context, scope: &scope, elements: &names };
    let mut users = Users::default();
    let mut members = Members::with_elements(elements.len());
    let mut supervisors = Vec::with_capacity(elements.len());
    for guard in head.node.guards() {
        let checked = components.supervisor(&guard, None, diags);
        supervisors.push(checked.built);
        users.globals.extend(checked.user);
        members.of_supervisors.push(checked.signature);
        members.globals.push(checked.draft);
    }
    let globals = supervisors.len();
    let watchers = Watchers {
        globals: &members.globals,
        signatures: &members.of_supervisors,
        elements: &names,
        text: context.file.text,
        record: program.record,
    };
    let mut drawn = Vec::with_capacity(elements.len());
    let mut of_locals = Vec::new();
    users.elements.reserve(elements.len());
    for (at, node) in elements.iter().enumerate() {
        let Checked { built, user, signature, draft } = components.element(node, diags);
        let first = supervisors.len();
        let nodes = node.guards();
        let mut guards = Vec::with_capacity(nodes.len());
        members.of_elements.push(signature);
        members.elements.push(draft);
        let Some(draft) = members.elements.last_mut() else { continue };
        draft.supervisors.reserve_exact(nodes.len());
        let owner = Owner::new(id(at).map(ElementId), draft);
        for guard in nodes {
            let checked = components.supervisor(&guard, Some(owner), diags);
            supervisors.push(checked.built);
            guards.extend(checked.user);
            of_locals.push(checked.signature);
            draft.supervisors.push(checked.draft);
        }
        let (reactions, drafts) = watchers.check(node, diags);
        draft.reactions = drafts;
        users.elements.extend(user.map(|user| (user, guards)));
        let built = built.map(|element| Element { reactions, ..element });
        drawn.push(built.and_then(|element| own(element, first, supervisors.len())));
    }
    members.of_supervisors.extend(of_locals);
    let start = start(&head.node, &names, diags);
    sized(head, [head.entries.len(), elements.len(), supervisors.len()], diags);
    let reasons = names.reasons();
    members.indices = names.into_indices();
    let all = suspend::Drawn { elements: &drawn, supervisors: &supervisors, start };
    flow_stays(&all, &members, diags);
    match finish(context, head, (drawn, supervisors, reasons), globals, start) {
        Ok(plan) => CheckedPlan { plan: Some(plan), inputs: Vec::new(), users, members },
        Err(inputs) => CheckedPlan { plan: None, inputs, users, members },
    }
}

/// Checks the edges after which an element continues: `resume`, `suspend` and `return`.
fn flow_stays(drawn: &suspend::Drawn<'_>, members: &Members, diags: &mut Diagnostics) {
    resume::check(drawn.elements, drawn.start, diags);
    let Members { globals, elements, indices: names, .. } = members;
    suspend::check(drawn, &suspend::Written { globals, elements, names }, diags);
}

/// Checks that entries, elements and supervisors fit into the tables.
fn sized(head: &PlanHead, rows: [usize; 3], diags: &mut Diagnostics) {
    let tables = [Table::Entries, Table::Elements, Table::Supervisors];
    size::too_many_rows(head.name.as_ref(), tables.into_iter().zip(rows), diags);
}

/// The scope of a plan's formulas.
fn scope<'a>(context: Context<'a>, head: &'a PlanHead) -> Scope<'a> {
    Scope {
        types: &context.file.types,
        tables: &context.file.tables,
        entries: &head.entries,
        indices: &head.indices,
        readable: &|_| true,
        unreadable: "",
        text: context.file.text,
        record: context.program.record,
    }
}

fn id(index: usize) -> Option<u16> {
    u16::try_from(index).ok()
}

/// The element with its own supervisors.
fn own(mut element: Element, first: usize, end: usize) -> Option<Element> {
    let ids: Option<Vec<_>> = (first..end).map(|place| id(place).map(SupervisorId)).collect();
    element.supervisors = ids?;
    Some(element)
}

/// Elements, supervisors, and the reasons after `fail`.
type Parts = (Vec<Option<Element>>, Vec<Option<Supervisor>>, Vec<String>);

/// The plan or, if incomplete, the inputs of its elements.
fn finish(
    context: Context<'_>,
    head: &PlanHead,
    (mut elements, supervisors, reasons): Parts,
    globals: usize,
    start: Option<(ElementId, Span)>,
) -> Result<graph::Plan, Vec<Vec<Formula>>> {
    let is_whole = elements.iter().all(Option::is_some)
        && supervisors.iter().all(Option::is_some)
        && head.entries.iter().all(|draft| draft.ty.is_some());
    let (Some(name), Some(globals), Some((start, start_span)), true) =
        (&head.name, id(globals), start, is_whole)
    else {
        let inputs = |element: &mut Option<Element>| element.take().map(|element| element.inputs);
        return Err(elements
            .iter_mut()
            .map(|element| inputs(element).unwrap_or_default())
            .collect());
    };
    Ok(graph::Plan {
        name: name.text.clone(),
        file: context.file_from_main(),
        doc: head.node.doc(),
        entries: head.entries.iter().map(entry).collect(),
        elements: elements.into_iter().flatten().collect(),
        supervisors: supervisors.into_iter().flatten().collect(),
        globals,
        reasons,
        start,
        start_span,
        interruptible: head.interrupting.is_some(),
        forever: head.node.forever().is_some(),
        span: name.span,
    })
}

/// An entry. An unknown type, which occurs only in an incomplete plan, becomes `bool`.
pub(super) fn entry(draft: &EntryDraft) -> graph::Entry {
    graph::Entry {
        name: draft.name.text.clone(),
        doc: draft.doc.clone(),
        kind: draft.kind,
        live: draft.live,
        ty: draft.ty.clone().unwrap_or(Type::Bool),
        init: draft.init.clone(),
        value: draft.value.clone(),
        range: draft.range,
        ranged_by: draft.ranged_by.clone(),
        span: draft.name.span,
    }
}

/// Checks the names of the plan's scope and returns the elements.
fn declare<'a>(
    head: &PlanHead,
    elements: &[ast::Element],
    record: &'a Recorder,
    diags: &mut Diagnostics,
) -> Elements<'a> {
    let mut scope = DeclaredNames::default();
    for entry in &head.entries {
        scope.declare(&entry.name, diags);
        names::entry(&entry.name, diags);
    }
    for guard in head.node.guards() {
        if let Some(name) = guard.name() {
            scope.declare(&name, diags);
        }
    }
    for element in elements {
        if let Some(name) = element.name() {
            scope.declare(&name, diags);
            names::element(&name, diags);
        }
        let mut local = DeclaredNames::default();
        for guard in element.guards() {
            if let Some(name) = guard.name() {
                local.declare(&name, diags);
            }
        }
    }
    Elements::new(elements.iter().map(ast::Element::name).collect(), record)
}

fn start(
    plan: &ast::Plan,
    elements: &Elements<'_>,
    diags: &mut Diagnostics,
) -> Option<(ElementId, Span)> {
    let starts = plan.starts();
    let name = plan.name();
    let Some(first) = starts.first() else {
        let span = name.as_ref().map_or_else(|| plan.span(), |name| name.span);
        if !half_typed(plan, diags) {
            let text = name.map(|name| name.text).unwrap_or_default();
            let one = elements.names().next().unwrap_or("first");
            diags.push(
                Diagnostic::new(Code::E0215, span, message!("'{}' has no 'start'", text))
                    .help(message!("add 'start {}', or another element", one)),
            );
        }
        return None;
    };
    for other in &starts[1..] {
        diags.push(
            Diagnostic::new(Code::E0215, other.span(), message!("a plan has one '{}'", "start"))
                .note(first.span(), "the first one")
                .help("remove one of them"),
        );
        if let Some(target) = other.target() {
            edges::find(&target, Leads::Start, elements, &mut Diagnostics::default());
        }
    }
    let target = first.target()?;
    Some((edges::find(&target, Leads::Start, elements, diags)?, target.span))
}

/// Whether an item of the plan itself, outside of elements, could not be parsed.
fn half_typed(plan: &ast::Plan, diags: &Diagnostics) -> bool {
    let inner: Vec<Span> = plan
        .elements()
        .iter()
        .map(ast::Element::span)
        .chain(plan.guards().iter().map(ast::Guard::span))
        .chain(plan.entries().iter().map(ast::Entry::span))
        .collect();
    let inner = Ranges::new(inner);
    diags.syntax_errors_within(plan.span()).any(|span| !inner.any(span))
}
