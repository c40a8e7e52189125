//! Commands that are not in this program: designed for another release, or left out of this build.

use afp_run::RunError;

/// Name and what it waits for.
const LATER: &[(&str, &str)] = &[
    ("replay", "replay of logs"),
    ("deploy", "the Raspberry Pi driver"),
    ("attach", "the live server"),
];

/// Commands that this program was built without; each is a feature of its name.
const LEFT_OUT: &[&str] = &[
    #[cfg(not(feature = "dap"))]
    "dap",
    #[cfg(not(feature = "lsp"))]
    "lsp",
    #[cfg(not(feature = "studio"))]
    "studio",
];

/// The names of such commands.
pub fn names() -> impl Iterator<Item = &'static str> {
    LATER.iter().map(|(name, _)| *name).chain(LEFT_OUT.iter().copied())
}

/// What to say to somebody who asks for such a command.
pub fn refusal(name: &str) -> Option<RunError> {
    if LEFT_OUT.contains(&name) {
        // Its page is made by other programs than cargo.
        let help = match name {
            "studio" => "in a checkout of AFP, 'cargo studio' builds it and opens it",
            _ => "'cargo install --path crates/afpc --features full' brings everything there is",
        };
        return Some(RunError::usage(format!("this afpc was built without '{name}'"), help));
    }
    let (_, what) = LATER.iter().find(|(later, _)| *later == name)?;
    let version = env!("CARGO_PKG_VERSION");
    Some(RunError::usage(
        format!("'afpc {name}' is not in release {version}: it comes with {what}"),
        "'afpc --help' lists what there is",
    ))
}
