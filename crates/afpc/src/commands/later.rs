//! Commands that are not in this program: planned for a later release, or left out of this build.

use afp_run::RunError;
#[cfg(feature = "dap")]
use clap::Args;

/// Name, reason, and alternative.
const LATER: &[(&str, &str, &str)] =
    &[("replay", "replay of logs", "'afpc run --again RUN.mcap' repeats the run of a log")];

/// The option for remote clients.
#[cfg(feature = "dap")]
#[derive(Args, Debug)]
pub struct Listen {
    /// Serve other machines, too (not in this release)
    #[arg(long, hide = true, value_name = "ADDRESS")]
    listen: Option<String>,
}

#[cfg(feature = "dap")]
impl Listen {
    /// Rejects unencrypted remote access.
    ///
    /// # Errors
    /// The option is given.
    pub fn check(&self) -> Result<(), RunError> {
        match self.listen {
            None => Ok(()),
            Some(_) => Err(RunError::usage(
                "'--listen' is not available: the connection would not be encrypted",
                "start it with '--port 4711'; then run 'ssh -L 4711:localhost:4711 HOST' on the other machine",
            )),
        }
    }
}

/// Commands that this program was built without.
const LEFT_OUT: &[&str] = &[
    #[cfg(not(all(feature = "dap", unix)))]
    "attach",
    #[cfg(not(all(unix, feature = "pi")))]
    "calibrate",
    #[cfg(not(feature = "dap"))]
    "dap",
    #[cfg(not(feature = "lsp"))]
    "lsp",
    #[cfg(not(feature = "studio"))]
    "studio",
];

/// The names of the unavailable commands.
pub fn names() -> impl Iterator<Item = &'static str> {
    LATER.iter().map(|(name, ..)| *name).chain(LEFT_OUT.iter().copied())
}

/// The error for an unavailable command.
pub fn refusal(name: &str) -> Option<RunError> {
    if LEFT_OUT.contains(&name) {
        // The studio's page is not built by cargo.
        let help = match name {
            "studio" => "in a checkout of AFP, 'cargo studio' builds it and opens it",
            _ => "'cargo install --path crates/afpc --features full' installs all commands",
        };
        return Some(RunError::usage(format!("this afpc was built without '{name}'"), help));
    }
    let (_, what, help) = LATER.iter().find(|(later, ..)| *later == name)?;
    let version = env!("CARGO_PKG_VERSION");
    Some(RunError::usage(
        format!("'afpc {name}' is not in release {version}: it comes with {what}"),
        *help,
    ))
}
