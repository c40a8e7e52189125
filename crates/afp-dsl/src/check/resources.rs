//! Resources that two components would command at the same time.
//!
//! Active together are an element, its supervisors, and all global supervisors outward; of a
//! sub-plan everything inside.

use crate::check::PlanHead;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::source::Span;

/// A component and what it commands.
#[derive(Clone, Debug)]
pub(crate) struct User {
    /// Its name in the plan.
    pub name: String,
    /// Where its name stands.
    pub span: Span,
    /// What it commands.
    pub uses: Vec<String>,
    /// The plan that it contains.
    pub plan: Option<usize>,
}

/// The components of a plan that command something.
#[derive(Clone, Debug, Default)]
pub(crate) struct Users {
    /// Global supervisors.
    pub globals: Vec<User>,
    /// Elements, each with its supervisors.
    pub elements: Vec<(User, Vec<User>)>,
}

/// Greatest number of other places that one diagnostic shows.
const MAX_NOTES: usize = 3;

/// Reports every pair once, at the later supervisor; `order` has sub-plans before their users.
pub(crate) fn check(plans: &[PlanHead], users: &[Users], order: &[usize], diags: &mut Diagnostics) {
    let mut inside: Vec<Vec<(String, Span)>> = vec![Vec::new(); plans.len()];
    for plan in order {
        let all = &users[*plan];
        let mut commands = Vec::new();
        for (place, global) in all.globals.iter().enumerate() {
            let mut others = flat(&all.globals[..place], &inside);
            others.extend(all.elements.iter().flat_map(|(element, _)| own(element, &inside)));
            report(global, &others, diags);
            commands.extend(own(global, &inside));
        }
        for (element, guards) in &all.elements {
            let inner = own(element, &inside);
            for (place, guard) in guards.iter().enumerate() {
                let mut others = inner.clone();
                others.extend(flat(&guards[..place], &inside));
                others.extend(flat(&all.globals, &inside));
                report(guard, &others, diags);
                commands.extend(own(guard, &inside));
            }
            commands.extend(inner);
        }
        commands.sort();
        commands.dedup_by(|a, b| a.0 == b.0);
        inside[*plan] = commands;
    }
}

/// What a component commands, with a place for each.
fn own(user: &User, inside: &[Vec<(String, Span)>]) -> Vec<(String, Span)> {
    match user.plan {
        Some(plan) => inside[plan].clone(),
        None => user.uses.iter().map(|resource| (resource.clone(), user.span)).collect(),
    }
}

fn flat(users: &[User], inside: &[Vec<(String, Span)>]) -> Vec<(String, Span)> {
    users.iter().flat_map(|user| own(user, inside)).collect()
}

fn report(supervisor: &User, others: &[(String, Span)], diags: &mut Diagnostics) {
    for resource in &supervisor.uses {
        let same = others.iter().filter(|(name, _)| name == resource);
        let mut places: Vec<Span> = same.map(|(_, place)| *place).collect();
        places.sort();
        places.dedup();
        if places.is_empty() {
            continue;
        }
        let message = format!(
            "'{}' commands '{resource}', which is in use while it watches",
            supervisor.name
        );
        let conflict = Diagnostic::new(Code::E0223, supervisor.span, message);
        let shown = places.iter().take(MAX_NOTES).fold(conflict, |conflict, place| {
            conflict.note(*place, format!("this commands '{resource}' at the same time"))
        });
        diags.push(
            shown
                .help(format!("watch with a supervisor that does not command '{resource}', or only elements that do not")),
        );
    }
}
