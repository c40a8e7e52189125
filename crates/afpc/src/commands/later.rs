//! Commands that are designed but not in this release.

use afp_run::RunError;

/// Name and what it waits for.
const LATER: &[(&str, &str)] = &[
    ("replay", "replay of logs"),
    ("deploy", "the Raspberry Pi driver"),
    ("attach", "the live server"),
    ("studio", "the graphical editor"),
];

/// The names of such commands.
pub fn names() -> impl Iterator<Item = &'static str> {
    LATER.iter().map(|(name, _)| *name)
}

/// What to say to somebody who asks for such a command.
pub fn refusal(name: &str) -> Option<RunError> {
    let (_, what) = LATER.iter().find(|(later, _)| *later == name)?;
    let version = env!("CARGO_PKG_VERSION");
    Some(RunError::usage(
        format!("'afpc {name}' is not in release {version}: it comes with {what}"),
        "'afpc --help' lists what there is",
    ))
}
