//! `afpc completions`: completion scripts for shells.

use clap::{Args, Command};
use clap_complete::Shell;

use super::print;
use crate::no_plan::NoPlan;

/// Arguments of `afpc completions`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc completions bash > ~/.local/share/bash-completion/completions/afpc
  afpc completions zsh > ~/.zfunc/_afpc
  afpc completions fish > ~/.config/fish/completions/afpc.fish";

/// Prints the completion script for a shell.
///
/// # Errors
/// Standard output cannot be written.
pub fn run(arguments: &Arguments, all: &Command) -> Result<u8, NoPlan> {
    let mut script = Vec::new();
    let mut command = seen(all).version(env!("CARGO_PKG_VERSION"));
    clap_complete::generate(arguments.shell, &mut command, "afpc", &mut script);
    print(&String::from_utf8_lossy(&script))
}

/// The command without hidden options, which completions would offer.
fn seen(command: &Command) -> Command {
    // clap needs static names; the program ends after printing them.
    let name: &'static str = command.get_name().to_owned().leak();
    let seen = Command::new(name)
        .args(command.get_arguments().filter(|argument| !argument.is_hide_set()).cloned())
        .subcommands(command.get_subcommands().map(self::seen));
    match command.get_about() {
        Some(about) => seen.about(about.clone()),
        None => seen,
    }
}
