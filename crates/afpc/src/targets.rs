//! The targets of a plan's check: the targets of `afp.toml`, or the named target.

use afp_dsl::graph::Graph;
use afp_dsl::timing::{BUILT_IN, Target, check_target};
use afp_project::Project;
use afp_run::RunError;
use afp_syntax::diagnostics::{Diagnostics, words};
use afp_toolboxes::project::OwnToolboxes;

/// The target of that name, from `afp.toml` or built in. Without a name, all targets of `afp.toml`.
///
/// # Errors
/// The target does not exist.
pub fn choose(project: &Project, name: Option<&str>) -> Result<Vec<Target>, RunError> {
    let own: Vec<_> = project.targets.iter().map(completed).collect();
    let Some(name) = name else { return Ok(own) };
    let named = own.iter().find(|target| target.name == name).cloned();
    match named.or_else(|| Target::built_in(name)) {
        Some(target) => Ok(vec![target]),
        None => {
            let names = own.iter().map(|target| target.name.as_str());
            let built_in = BUILT_IN.iter().map(|target| target.name);
            let known: Vec<_> = built_in.chain(names).map(|name| format!("'{name}'")).collect();
            let message = format!("there is no target '{name}'");
            let help =
                format!("name one of {}, or add '[target.{name}]' to afp.toml", known.join(", "));
            Err(RunError::usage(message, help))
        }
    }
}

/// A project's target, completed from the built-in target of the same name.
fn completed(own: &afp_project::Target) -> Target {
    let usual = Target::named(&own.name);
    Target {
        tick: own.tick.or(usual.tick),
        capacity: own.capacity.unwrap_or(usual.capacity),
        slowdown: own.slowdown.unwrap_or(usual.slowdown),
        budgets: own.budgets.clone(),
        ..usual
    }
}

/// The diagnostics of a plan on targets.
///
/// # Errors
/// A target has a budget for an unknown toolbox or template.
pub fn check(
    graph: &Graph,
    own: &OwnToolboxes,
    targets: &[Target],
) -> Result<Diagnostics, RunError> {
    let mut diags = Diagnostics::default();
    for target in targets {
        know_templates(graph, own, target)?;
        diags.extend(check_target(graph, target));
    }
    Ok(diags)
}

/// Checks the template names: with a misspelled name, the declared budget would still apply.
/// Toolboxes that the plan does not use may belong to another plan.
fn know_templates(graph: &Graph, own: &OwnToolboxes, target: &Target) -> Result<(), RunError> {
    for (toolbox, name) in target.budgeted() {
        let Some(known) = graph.toolboxes.iter().find(|known| known.name == toolbox) else {
            know_toolbox(own, target, (toolbox, name))?;
            continue;
        };
        let names = || known.templates.iter().map(|template| template.name.as_str());
        if names().any(|known| known == name) {
            continue;
        }
        let message =
            format!("'[target.{}]' of afp.toml: '{toolbox}' has no template '{name}'", target.name);
        let help = match words::nearest(name, names()) {
            Some(near) => format!("write 'budgets.{toolbox}.{near}'"),
            None => format!("'afpc templates {toolbox}' lists its templates"),
        };
        return Err(RunError::usage(message, help));
    }
    Ok(())
}

/// Rejects a budget for a toolbox that is neither built in nor in the project.
fn know_toolbox(
    own: &OwnToolboxes,
    target: &Target,
    (toolbox, template): (&str, &str),
) -> Result<(), RunError> {
    let built_in = afp_toolboxes::ALL.iter().map(|built_in| built_in.name);
    let names: Vec<_> = built_in.chain(own.texts().map(|(name, _)| name)).collect();
    if names.contains(&toolbox) {
        return Ok(());
    }
    let message =
        format!("'[target.{}]' of afp.toml: there is no toolbox '{toolbox}'", target.name);
    let help = match words::nearest(toolbox, names.iter().copied()) {
        Some(near) => format!("write 'budgets.{near}.{template}'"),
        None => format!("there are {}", words::list(names.iter().copied(), "and")),
    };
    Err(RunError::usage(message, help))
}
