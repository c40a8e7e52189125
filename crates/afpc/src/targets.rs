//! The targets that a plan is checked against: those of `afp.toml`, or the one that was named.

use afp_dsl::timing::{BUILT_IN, Target};
use afp_project::Project;
use afp_run::RunError;

/// The target of that name, from `afp.toml` or built in; without a name all that `afp.toml` has.
///
/// # Errors
/// There is no such target.
pub fn choose(project: &Project, name: Option<&str>) -> Result<Vec<Target>, RunError> {
    let own = project
        .targets
        .iter()
        .map(|target| Target::new(&target.name, target.tick, target.capacity));
    let own: Vec<_> = own.collect();
    let Some(name) = name else { return Ok(own) };
    let named = own.iter().find(|target| target.name == name).cloned();
    match named.or_else(|| Target::built_in(name)) {
        Some(target) => Ok(vec![target]),
        None => {
            let names = own.iter().map(|target| target.name.as_str());
            let built_in = BUILT_IN.iter().map(|(name, ..)| *name);
            let known: Vec<_> = built_in.chain(names).map(|name| format!("'{name}'")).collect();
            let message = format!("there is no target '{name}'");
            let help =
                format!("name one of {}, or add '[target.{name}]' to afp.toml", known.join(", "));
            Err(RunError::usage(message, help))
        }
    }
}
