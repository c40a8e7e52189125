//! The workspace's `dev` profile, for builds with less optimisation.

use std::fs;
use std::process::Command;

use toml_edit::{DocumentMut, Item, TableLike};

use crate::shell::{Failure, root};

/// A command that optimises nothing, for programs that run only briefly.
///
/// # Errors
/// The manifest cannot be read.
pub fn unoptimised(command: &mut Command) -> Result<&mut Command, Failure> {
    let manifest: DocumentMut = fs::read_to_string(root().join("Cargo.toml"))?.parse()?;
    for (name, _) in packages(&manifest)?.iter() {
        command.arg("--config").arg(format!("profile.dev.package.{name}.opt-level=0"));
    }
    Ok(command)
}

/// The packages with their own settings in the `dev` profile.
fn packages(manifest: &DocumentMut) -> Result<&dyn TableLike, Failure> {
    let dev = manifest.get("profile").and_then(|profile| profile.get("dev"));
    let packages = dev.and_then(|dev| dev.get("package")).and_then(Item::as_table_like);
    packages.ok_or_else(|| Failure("error: Cargo.toml has no [profile.dev.package]".to_owned()))
}
