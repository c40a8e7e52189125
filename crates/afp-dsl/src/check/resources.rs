//! Resources that two components would command at the same time.
//!
//! An element, its supervisors, and all enclosing global supervisors are active together; in a
//! sub-plan everything is.

use crate::check::PlanHead;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

/// A component and its resources.
#[derive(Clone, Debug)]
pub(crate) struct User {
    /// Its name in the plan.
    pub name: String,
    pub span: Span,
    pub uses: Vec<String>,
    /// Its sub-plan.
    pub plan: Option<usize>,
}

/// The components of a plan that command resources.
#[derive(Clone, Debug, Default)]
pub(crate) struct Users {
    pub globals: Vec<User>,
    /// Elements, each with its supervisors.
    pub elements: Vec<(User, Vec<User>)>,
}

/// Maximum number of notes.
const MAX_NOTES: usize = 3;

/// A resource, and place and name of a component that commands it.
type Command<'a> = (&'a str, Span, &'a str);

/// Reports every pair once, at the later supervisor; `order` has sub-plans before their users.
pub(crate) fn check(plans: &[PlanHead], users: &[Users], order: &[usize], diags: &mut Diagnostics) {
    let mut inside: Vec<Vec<Command<'_>>> = vec![Vec::new(); plans.len()];
    for plan in order {
        let all = &users[*plan];
        let of = |user| own(user, &inside);
        let mut commands = Vec::new();
        for (place, global) in all.globals.iter().enumerate() {
            let elements = all.elements.iter().map(|(element, _)| element);
            report(global, all.globals[..place].iter().chain(elements).flat_map(of), diags);
            commands.extend(of(global));
        }
        for (element, guards) in &all.elements {
            for (place, guard) in guards.iter().enumerate() {
                let others = [element].into_iter().chain(&guards[..place]).chain(&all.globals);
                report(guard, others.flat_map(of), diags);
                commands.extend(of(guard));
            }
            commands.extend(of(element));
        }
        commands.sort_unstable();
        commands.dedup_by_key(|(resource, ..)| *resource);
        inside[*plan] = commands;
    }
}

/// The resources of a component, each with a place.
fn own<'a>(
    user: &'a User,
    inside: &[Vec<Command<'a>>],
) -> impl Iterator<Item = Command<'a>> + Clone {
    let (uses, within) = match user.plan {
        Some(plan) => (&[][..], &inside[plan][..]),
        None => (&user.uses[..], &[][..]),
    };
    let uses = uses.iter().map(|resource| (resource.as_str(), user.span, &*user.name));
    uses.chain(within.iter().copied())
}

fn report<'a>(
    supervisor: &User,
    others: impl Iterator<Item = Command<'a>> + Clone,
    diags: &mut Diagnostics,
) {
    for resource in &supervisor.uses {
        let same = others.clone().filter(|(name, ..)| name == resource);
        let mut places: Vec<_> = same.map(|(_, place, name)| (place, name)).collect();
        places.sort();
        places.dedup();
        let Some((_, other)) = places.first() else { continue };
        let message = message!(
            "'{}' and '{}' both control '{}' at the same time",
            *other,
            supervisor.name,
            resource
        );
        let conflict = Diagnostic::new(Code::E0223, supervisor.span, message);
        let shown = places.iter().take(MAX_NOTES).fold(conflict, |conflict, (place, _)| {
            conflict.note(*place, message!("this commands '{}' at the same time", resource))
        });
        diags.push(shown.help(message!(
            "watch with a supervisor that does not command '{}', or only elements that do not",
            resource
        )));
    }
}
