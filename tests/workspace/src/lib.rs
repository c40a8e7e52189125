//! Cargo's knowledge of the workspace: its packages and their dependencies. The modules of a
//! package.

pub mod modules;
mod paths;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

#[derive(Debug)]
pub struct Package {
    /// Its folder, relative to the root.
    pub folder: PathBuf,
    /// Its dependencies in the workspace: normal, build and optional ones, without development
    /// dependencies.
    pub needs: BTreeSet<String>,
}

pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here).to_owned()
}

/// The cargo of the tests, at the root and offline.
pub fn cargo(command: &str) -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root()).args([command, "--offline"]);
    cargo
}

/// The output of a command.
///
/// # Panics
/// It cannot run, or fails; its errors are shown.
pub fn output(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}\n{errors}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The packages of the workspace by name.
///
/// # Panics
/// Cargo cannot read the manifests.
pub fn packages() -> BTreeMap<String, Package> {
    let text = output(cargo("metadata").args(["--no-deps", "--format-version", "1"]));
    let metadata: Value = serde_json::from_str(&text).expect("cargo prints JSON");
    let root = root().canonicalize().expect("the root is there");
    let packages = metadata["packages"].as_array().expect("packages are a list");
    packages.iter().map(|package| read(package, &root)).collect()
}

fn read(package: &Value, root: &Path) -> (String, Package) {
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let manifest = PathBuf::from(text(&package["manifest_path"]));
    let folder = manifest.parent().and_then(|folder| folder.strip_prefix(root).ok());
    let dependencies = package["dependencies"].as_array().into_iter().flatten();
    let ours = dependencies.filter(|each| each["path"].is_string() && each["kind"] != "dev");
    let needs = ours.map(|each| text(&each["name"])).collect();
    let folder = folder.map(Path::to_owned).unwrap_or_default();
    (text(&package["name"]), Package { folder, needs })
}

/// All dependencies of a package, with itself.
pub fn built_from(packages: &BTreeMap<String, Package>, name: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![name.to_owned()];
    while let Some(next) = open.pop() {
        if let Some(package) = packages.get(&next) {
            open.extend(package.needs.iter().cloned());
        }
        found.insert(next);
    }
    found
}
