//! Checks a claim of a scenario against an occurrence or a state.

use afp_core::trace::{Author, ComponentId};
use afp_dsl::scenario::Claim;

use super::{Occurrence, State, ends, fits};

pub(super) fn happens(claim: &Claim, occurrence: &Occurrence) -> bool {
    match (claim, occurrence) {
        (
            Claim::Transition { from, to, by },
            Occurrence::Edge { from: left, to: goal, by: why },
        ) => from == left && *goal == Some(*to) && by.is_none_or(|by| fits(&by, *why)),
        (Claim::Happens(wanted), Occurrence::Outcome(cause)) => fits(wanted, *cause),
        (Claim::End(wanted), Occurrence::End(ending, last)) => ends(*wanted, *ending, *last),
        (Claim::Interrupt(wanted), Occurrence::Interrupt(element)) => wanted == element,
        (Claim::Commit { of, by }, Occurrence::Commit { entry, author, first }) => {
            let by = by.is_none_or(|by| *author == Author::Component(ComponentId(by)));
            by && of.map_or(*first, |of| of == *entry)
        }
        _ => false,
    }
}

/// Whether a claim holds now; `None` if it is not about the state.
pub(super) fn holds(claim: &Claim, state: &State) -> Option<bool> {
    match claim {
        Claim::Active(id) => Some(state.active.get(*id as usize) == Some(&true)),
        Claim::Suspended(id) => Some(state.suspended.get(*id as usize) == Some(&true)),
        Claim::Running => Some(state.ending.is_none()),
        Claim::Compare { left, comparison, right } => {
            let both = state.held(left)?.zip(state.operand(right)?);
            Some(both.is_some_and(|(left, right)| comparison.holds(&left, &right)))
        }
        Claim::Transition { .. }
        | Claim::Happens(_)
        | Claim::End(_)
        | Claim::Interrupt(_)
        | Claim::Commit { .. } => None,
    }
}
