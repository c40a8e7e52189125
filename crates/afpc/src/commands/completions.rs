//! `afpc completions`: what a shell needs to complete command lines.

use clap::Args;
use clap_complete::Shell;

use super::print;
use crate::plan_file::NoPlan;

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

/// Prints the completions.
///
/// # Errors
/// Standard output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut crate::cli::command(), "afpc", &mut script);
    print(&String::from_utf8_lossy(&script))
}
