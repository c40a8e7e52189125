//! The answer to `--version`: what a program is made of.

use std::env::consts::{ARCH, OS};
use std::fmt::Write;

use afp_session::Build;

use crate::Program;
use crate::hash::hash;
use crate::run::plan_hash;

/// The build of AFP and its machine: `0.1.0 (8f3a2c1) for x86_64-linux`.
pub fn build_line() -> String {
    format!("{} for {ARCH}-{OS}", Build::this())
}

/// The plan with its hash, the toolboxes of the project with theirs, the linked robots, and the
/// build of AFP. The hashes are those of logs.
pub fn version(program: &Program<'_>, robots: &str) -> String {
    let (texts, toolboxes) = program.text_files();
    let mut text = format!("{}\nplan     {}\n", plan_hash(&texts), program.file);
    for toolbox in toolboxes {
        let _ = writeln!(text, "toolbox  {} {}", toolbox.name, hash(&toolbox.text));
    }
    let _ = write!(text, "robot    {robots}\nafp      {}", build_line());
    text
}
