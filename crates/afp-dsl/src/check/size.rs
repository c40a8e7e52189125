//! Sizes of plans: their tables, and their components at run time.
//!
//! Rows have 16-bit numbers. At run time every use of a sub-plan is a separate instance: a few
//! plans that use each other twice make a million elements, which would exhaust memory or stack.

use crate::check::Program;
use crate::graph::{Component, Plan};
use crate::rows::{MAX_ROWS, Table, tables};
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Maximum number of elements and supervisors at run time.
const MAX_COMPONENTS: u64 = 100_000;
/// Maximum nesting of sub-plans.
const MAX_DEPTH: u32 = 1_000;

/// Size of a plan at run time.
#[derive(Clone, Copy)]
struct Size {
    components: u64,
    entries: u64,
    depth: u32,
}

/// Reports plans that are too large, but not their users; `order` has sub-plans before their users.
pub(super) fn check(
    program: &Program<'_>,
    plans: &[Option<Plan>],
    order: &[usize],
    diags: &mut Diagnostics,
) {
    too_many_plans(program, diags);
    let mut sizes = vec![None; plans.len()];
    for place in order {
        if let Some(plan) = &plans[*place] {
            // Limits visible in the source are also reported without a graph.
            let derived =
                |table| !matches!(table, Table::Entries | Table::Elements | Table::Supervisors);
            let rows = tables(plan).into_iter().filter(|(table, _)| derived(*table));
            too_many_rows(program.plans[*place].name.as_ref(), rows, diags);
        }
        let Some(size) = plans[*place].as_ref().and_then(|plan| size(plan, &sizes)) else {
            continue;
        };
        let name = program.plans[*place].name.as_ref();
        match too_large(&size).zip(name) {
            Some((why, name)) => diags.push(
                Diagnostic::new(Code::E0231, name.span, message!("'{}' {}", name.text, why))
                    .help("use its sub-plans less often, or nest them less deeply"),
            ),
            None => sizes[*place] = Some(size),
        }
    }
}

/// Reports the first item beyond a limit.
pub(crate) fn at_most(
    limit: usize,
    (owner, what): (&str, &str),
    items: impl IntoIterator<Item = Span>,
    help: &'static str,
    diags: &mut Diagnostics,
) {
    if let Some(span) = items.into_iter().nth(limit) {
        let message = message!("{} has at most {} {}", Words(owner), limit, Words(what));
        diags.push(Diagnostic::new(Code::E0231, span, message).help(help));
    }
}

/// Reports each table of a plan with too many rows.
pub(super) fn too_many_rows(
    name: Option<&Name>,
    rows: impl IntoIterator<Item = (Table, usize)>,
    diags: &mut Diagnostics,
) {
    let Some(name) = name else { return };
    for (table, count) in rows.into_iter().filter(|(_, count)| *count > MAX_ROWS) {
        let message = message!(
            "'{}' has {} {}; at most {} fit",
            name.text,
            count,
            Words(what(table)),
            MAX_ROWS
        );
        diags.push(
            Diagnostic::new(Code::E0231, name.span, message)
                .help("move some of them to a sub-plan"),
        );
    }
}

fn what(table: Table) -> &'static str {
    match table {
        Table::Entries => "entries",
        Table::Elements => "elements",
        Table::Supervisors => "supervisors",
        Table::Watches => "supervisors and elements that events of global ones lead to",
        Table::Edges => "states and events",
        Table::Reasons => "reasons to fail",
        Table::Sweeps => "pairs of an element and a supervisor that watches it",
    }
}

fn too_many_plans(program: &Program<'_>, diags: &mut Diagnostics) {
    let help = "leave out files whose plans are not needed";
    let names = program.plans.iter().filter_map(|head| Some(head.name.as_ref()?.span));
    at_most(MAX_ROWS, ("a plan with the files that it uses", "plans"), names, help, diags);
}

/// `None` for a plan that contains a plan which is too large or has errors.
fn size(plan: &Plan, sizes: &[Option<Size>]) -> Option<Size> {
    let mut size = Size {
        components: (plan.elements.len() + plan.supervisors.len()) as u64,
        entries: plan.entries.len() as u64,
        depth: 0,
    };
    for element in &plan.elements {
        let Component::SubPlan(id) = element.component else { continue };
        let inner = sizes[id.index()]?;
        size.components += inner.components;
        size.entries += inner.entries;
        size.depth = size.depth.max(inner.depth + 1);
    }
    Some(size)
}

fn too_large(size: &Size) -> Option<Message> {
    let counted = "with its sub-plans counted at each use";
    if size.components > MAX_COMPONENTS {
        let count = size.components;
        return Some(message!(
            "has {} elements and supervisors {}; at most {} can run",
            count,
            Words(counted),
            MAX_COMPONENTS
        ));
    }
    if size.entries > MAX_COMPONENTS {
        let count = size.entries;
        return Some(message!(
            "has {} entries {}; at most {} can run",
            count,
            Words(counted),
            MAX_COMPONENTS
        ));
    }
    (size.depth > MAX_DEPTH).then(|| {
        message!("has sub-plans in sub-plans {} deep; at most {} can run", size.depth, MAX_DEPTH)
    })
}
