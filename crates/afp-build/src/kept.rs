//! Cached builds.

mod folder;
mod fresh;

use std::path::{Path, PathBuf};

use afp_codegen::{LinkOptions, extension_files, runner_files};
use afp_project::{HardwareLink, RobotLink};
use afp_run::{RunError, hash, say};

use crate::cargo::{self, Artifact, Blame, Job};
use crate::parts::Parts;
use crate::{NotBuilt, crate_folder, origin};

use fresh::Around;

pub use folder::cache;

/// The kind of a linked product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Product {
    /// The command line, with these features.
    Runner(&'static [&'static str]),
    /// The native half of the Python package.
    Extension,
}

impl Product {
    /// Its name in folders and packages.
    fn name(self) -> &'static str {
        match self {
            Product::Runner(_) => "runner",
            Product::Extension => "extension",
        }
    }

    /// The features of its main dependency.
    fn features(self) -> &'static [&'static str] {
        match self {
            Product::Runner(features) => features,
            Product::Extension => &[],
        }
    }

    /// Its name in messages.
    fn words(self) -> &'static str {
        match self {
            Product::Runner(_) => "a runner",
            Product::Extension => "a Python extension",
        }
    }
}

impl Parts<'_> {
    /// The file with the parts linked in: cached if nothing has changed, or else built now.
    ///
    /// # Errors
    /// There is no writable folder, cargo is missing, a crate does not build.
    pub fn product(mut self, product: Product) -> Result<PathBuf, NotBuilt> {
        // The order of the plans must not matter.
        self.toolboxes.sort_by(|one, other| one.name.cmp(&other.name));
        let kept = Kept::new(&self, product)?;
        let files = kept.files(&self)?;
        match fresh::program(&kept.folder, &kept.around(&self), &files) {
            Some(built) => Ok(built),
            None => kept.build(&self, &files),
        }
    }
}

/// A product and its folder.
struct Kept {
    product: Product,
    options: LinkOptions,
    folder: PathBuf,
    /// Cargo's target folder.
    target: PathBuf,
}

impl Kept {
    fn new(parts: &Parts<'_>, product: Product) -> Result<Kept, RunError> {
        let mut options = LinkOptions {
            package: String::new(),
            origin: origin::of_afp(parts.project)?,
            robot: parts.robot.as_ref().map(RobotLink::rust_type),
            hardware: parts.hardware.as_ref().map(HardwareLink::rust_type),
            toolboxes: Vec::new(),
            dependencies: parts.crates().map(origin::dependency).collect(),
            features: product.features().iter().map(|&name| name.to_owned()).collect(),
        };
        for own in &parts.toolboxes {
            options.toolboxes.push((own.name.clone(), own.krate.rust_path()));
        }
        let (inputs, name) =
            (hash(&format!("{} {options:?}", env!("CARGO_PKG_VERSION"))), product.name());
        options.package = format!("afp-{name}-{inputs}");
        let below = Path::new(name).join(&inputs);
        let folder::Folder { kept, build } = folder::find(&parts.project.folder, &below)?;
        Ok(Kept { product, options, folder: kept.join(below), target: build })
    }

    /// The influences on its build other than its packages.
    fn around<'a>(&self, parts: &Parts<'a>) -> Around<'a> {
        let lock = crate_folder::lock_of(&self.options.origin);
        Around { caller: &parts.project.folder, lock }
    }

    /// The files of its crate.
    fn files(&self, parts: &Parts<'_>) -> Result<Vec<(String, String)>, RunError> {
        let declared: Vec<_> = parts.toolboxes.iter().map(|own| &*own.declared).collect();
        let files = match self.product {
            Product::Runner(_) => runner_files(&self.options, &declared),
            Product::Extension => extension_files(&self.options, &declared),
        };
        files.map_err(|path| {
            RunError::usage(format!("'{path}' is not a module path"), "fix 'module' in afp.toml")
        })
    }

    fn build(&self, parts: &Parts<'_>, files: &[(String, String)]) -> Result<PathBuf, NotBuilt> {
        let names = parts.names();
        let no_cargo = RunError::Missing {
            message: format!(
                "the plan needs {names}, whose Rust must be built first, but cargo is not installed"
            ),
            help:
                "install Rust from https://rustup.rs, then run the same command again; plans that use only built-in toolboxes run without it"
                    .to_owned(),
        };
        let texts: Vec<_> = files.iter().map(|(path, text)| (&**path, &**text)).collect();
        crate_folder::put_own(&self.folder, &texts, &self.options.origin)?;
        say(format_args!("building {} for {names} (once) ...", self.product.words()));
        let begun = fresh::begin(&self.folder)?;
        let built = cargo::build(Job {
            folder: &self.folder,
            caller: Some(&parts.project.folder),
            target: Some(&self.target),
            toolchain: None,
            artifact: match self.product {
                Product::Runner(_) => Artifact::Program,
                Product::Extension => Artifact::Extension,
            },
            blame: Blame { generated: None, toolboxes: &parts.toolboxes },
            no_cargo,
            tools: None,
        })?;
        let program = built.artifact.ok_or(NotBuilt::Told { first: None })?;
        let watched = fresh::watched(&built.manifests, &self.around(parts));
        fresh::done(&self.folder, &program, &watched, begun)?;
        Ok(program)
    }
}
