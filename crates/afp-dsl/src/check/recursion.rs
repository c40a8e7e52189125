//! Recursive plans, direct or indirect, which a static graph cannot have.

use crate::check::scope::FileScope;
use crate::check::{PlanHead, Program};
use afp_syntax::ast::ElementKind;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Reports each cycle once; returns the plans with sub-plans before their users.
pub(crate) fn order(program: &Program<'_>, diags: &mut Diagnostics) -> Vec<usize> {
    let plans = &program.plans;
    let mut search = Search {
        plans,
        uses: &program.sub_plans,
        state: vec![State::New; plans.len()],
        order: Vec::with_capacity(plans.len()),
        diags,
    };
    for root in 0..plans.len() {
        search.run(root);
    }
    search.order
}

/// The sub-plans of a plan, each with the place of its use.
pub(crate) fn sub_plans(head: &PlanHead, files: &[FileScope<'_>]) -> Vec<(usize, Span)> {
    let sub_plans = head.node.elements().into_iter().filter(|e| e.kind() == ElementKind::SubPlan);
    let known = &files[head.file].plans;
    sub_plans
        .filter_map(|element| {
            let reference = element.template()?;
            let place = known.get(&reference.name()?.text)?.first()?;
            Some((*place, reference.span()))
        })
        .collect()
}

/// Maximum number of steps of a cycle with notes.
const MAX_NOTES: usize = 8;

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}

struct Search<'a> {
    plans: &'a [PlanHead],
    uses: &'a [Vec<(usize, Span)>],
    state: Vec<State>,
    order: Vec<usize>,
    diags: &'a mut Diagnostics,
}

impl Search<'_> {
    /// Depth-first search with an explicit stack, since a file may have any number of plans.
    fn run(&mut self, root: usize) {
        if self.state[root] != State::New {
            return;
        }
        self.state[root] = State::Open;
        let mut path: Vec<(usize, usize)> = vec![(root, 0)];
        while let Some((plan, next)) = path.last_mut() {
            let plan = *plan;
            let Some((used, span)) = self.uses[plan].get(*next).copied() else {
                self.state[plan] = State::Done;
                self.order.push(plan);
                path.pop();
                continue;
            };
            *next += 1;
            match self.state[used] {
                State::New => {
                    self.state[used] = State::Open;
                    path.push((used, 0));
                }
                State::Open => self.report(&path, used, span),
                State::Done => {}
            }
        }
    }

    fn report(&mut self, path: &[(usize, usize)], used: usize, span: Span) {
        let from = path.iter().position(|(plan, _)| *plan == used).unwrap_or(0);
        let name = |plan: usize| {
            self.plans[plan].name.as_ref().map_or("", |name| name.text.as_str()).to_owned()
        };
        let mut cycle: Vec<_> = path[from..].iter().map(|(plan, _)| name(*plan)).collect();
        cycle.push(name(used));
        let message = message!("'{}' contains itself: {}", name(used), Words(cycle.join(" -> ")));
        let mut error = Diagnostic::new(Code::E0222, span, message)
            .help("lead back with an edge to an element instead of a sub-plan");
        let steps = path[from..].windows(2);
        for step in steps.take(MAX_NOTES) {
            let ((plan, next), (inner, _)) = (step[0], step[1]);
            if let Some((_, place)) = self.uses[plan].get(next.saturating_sub(1)) {
                error = error.note(*place, message!("'{}' contains '{}'", name(plan), name(inner)));
            }
        }
        self.diags.push(error);
    }
}
