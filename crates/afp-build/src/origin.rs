//! The sources of crates in generated manifests.

use std::path::Path;

use afp_codegen::{Dependency, Features, Origin};
use afp_project::{CrateLink, ProjectFile};
use afp_run::RunError;

/// The source of the `afp` crates: from the project file, or else the checkout of this program.
///
/// # Errors
/// The checkout is gone.
pub fn of_afp(project: &ProjectFile) -> Result<Origin, RunError> {
    match &project.project.afp {
        Some(origin) => Ok(origin_in(&project.folder, origin)),
        None => checkout(),
    }
}

pub fn dependency(krate: &CrateLink) -> Dependency {
    Dependency {
        key: krate.key.clone(),
        package: krate.package.clone(),
        origin: origin_in(Path::new(""), &krate.origin),
        features: Features::Default,
    }
}

fn origin_in(folder: &Path, origin: &afp_project::Origin) -> Origin {
    match origin {
        afp_project::Origin::Path(path) => {
            let path = folder.join(path);
            Origin::Path(path.canonicalize().unwrap_or(path).display().to_string())
        }
        afp_project::Origin::Git(git) => Origin::Git(git.clone()),
        afp_project::Origin::Version(version) => Origin::Version(version.clone()),
    }
}

/// An origin in a project file's form.
pub fn as_written(origin: Origin) -> afp_project::Origin {
    match origin {
        Origin::Path(path) => afp_project::Origin::Path(path),
        Origin::Git(git) => afp_project::Origin::Git(git),
        Origin::Version(version) => afp_project::Origin::Version(version),
    }
}

/// The checkout of this program.
fn checkout() -> Result<Origin, RunError> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2);
    match root.filter(|root| root.join("crates/afp/Cargo.toml").is_file()) {
        Some(root) => Ok(Origin::Path(root.display().to_string())),
        None => Err(RunError::Missing {
            message: concat!(
                "the checkout that afpc was built from is no longer at '",
                env!("CARGO_MANIFEST_DIR"),
                "/../..'"
            )
            .to_owned(),
            help: "set the path of the afp crates: '[afp] path = \"...\"' in afp.toml".to_owned(),
        }),
    }
}
