//! Finds the commit that this is built from, for the logs of runs: that of the checkout or of the
//! package.
//!
//! Only for optimised builds: otherwise each commit would rebuild all crates that depend on this
//! one.

use std::env;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=AFP_COMMIT");
    let said = env::var("AFP_COMMIT").is_ok_and(|commit| !commit.is_empty());
    let optimised = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let Ok(folder) = env::var("CARGO_MANIFEST_DIR") else { return };
    if said || !optimised {
        return;
    }
    if let Some(commit) = of_package(Path::new(&folder)).or_else(|| of_checkout(&folder)) {
        println!("cargo::rustc-env=AFP_COMMIT={commit}");
    }
}

/// The commit that cargo wrote into a package.
pub fn of_package(folder: &Path) -> Option<String> {
    let text = std::fs::read_to_string(folder.join(".cargo_vcs_info.json")).ok()?;
    let (_, rest) = text.split_once("\"sha1\"")?;
    rest.split('"').nth(1).map(short)
}

/// The commit of a checkout, with a `+` if files have changed since.
pub fn of_checkout(folder: &str) -> Option<String> {
    let commit = git(folder, &["rev-parse", "HEAD"])?;
    for watched in ["HEAD", "logs/HEAD"] {
        if let Some(path) =
            git(folder, &["rev-parse", "--path-format=absolute", "--git-path", watched])
        {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    println!("cargo::rerun-if-changed={folder}/..");
    let changed = git(folder, &["status", "--porcelain", "--untracked-files=no", "--", ".."])?;
    Some(short(&commit) + if changed.is_empty() { "" } else { "+" })
}

fn short(commit: &str) -> String {
    commit.chars().take(12).collect()
}

/// The output of git; `None` without git or a checkout.
fn git(folder: &str, arguments: &[&str]) -> Option<String> {
    // git must not write its index: cargo rebuilds if a watched file is newer than the build.
    let git = ["--no-optional-locks", "-C", folder];
    let output = Command::new("git").args(git).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok().filter(|_| output.status.success())?;
    Some(text.trim().to_owned())
}
