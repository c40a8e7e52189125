//! How large a plan is when it runs: every use of a sub-plan is a sub-plan of its own.
//!
//! A few plans that use each other twice are a million elements; whatever unfolds them would run out
//! of memory or stack.

use crate::check::Program;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::graph::{Component, Plan};

/// Greatest number of elements and supervisors of a running plan.
const MAX_COMPONENTS: u64 = 100_000;
/// Greatest depth of sub-plans in sub-plans.
const MAX_DEPTH: u32 = 1_000;

/// What a plan comes to when it runs.
#[derive(Clone, Copy)]
struct Size {
    components: u64,
    entries: u64,
    depth: u32,
}

/// Reports the plans that grow too large, but not those that contain them; `order` has sub-plans
/// before their users.
pub(super) fn check(
    program: &Program<'_>,
    plans: &[Option<Plan>],
    order: &[usize],
    diags: &mut Diagnostics,
) {
    let mut sizes = vec![None; plans.len()];
    for place in order {
        let Some(size) = plans[*place].as_ref().and_then(|plan| size(plan, &sizes)) else {
            continue;
        };
        let name = program.plans[*place].name.as_ref();
        match too_large(&size).zip(name) {
            Some((why, name)) => diags.push(
                Diagnostic::new(Code::E0231, name.span, format!("'{}' {why}", name.text))
                    .help("use its sub-plans less often, or nest them less deeply"),
            ),
            None => sizes[*place] = Some(size),
        }
    }
}

/// `None` for a plan that contains one which is too large or has errors.
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

fn too_large(size: &Size) -> Option<String> {
    let counted = "with its sub-plans counted at each use";
    if size.components > MAX_COMPONENTS {
        let count = size.components;
        return Some(format!(
            "has {count} elements and supervisors {counted}; at most {MAX_COMPONENTS} can run"
        ));
    }
    if size.entries > MAX_COMPONENTS {
        let count = size.entries;
        return Some(format!("has {count} entries {counted}; at most {MAX_COMPONENTS} can run"));
    }
    (size.depth > MAX_DEPTH).then(|| {
        format!("has sub-plans in sub-plans {} deep; at most {MAX_DEPTH} can run", size.depth)
    })
}
