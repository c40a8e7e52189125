//! Files beside the manifest, and the toolboxes: built in, of the project, or named by the caller.

use std::path::{Path, PathBuf};
use std::{env, fs};

use afp_dsl::files::Disk;
use afp_dsl::toolbox::Toolboxes;
use afp_project::{CrateLink, ProjectError, ProjectFile};
use afp_syntax::source::Source;
use proc_macro2::TokenStream;
use quote::quote;

/// A text and the expression that gives it to the program.
pub struct File {
    /// The text, for the compiler of plans.
    pub source: Source,
    /// `include_str!`, or the text itself where it is built in.
    pub text: TokenStream,
}

/// A toolbox file: one beside the manifest, else a built-in one.
///
/// # Errors
/// A sentence that says what is missing.
pub fn toolbox(path: &str) -> Result<File, String> {
    let builtin = afp_toolboxes::ALL.iter().find(|builtin| builtin.file_name == path);
    match (read(path), builtin) {
        (Err(_), Some(builtin)) => {
            let text = builtin.text;
            Ok(File { source: Source::new(path, text), text: quote!(#text) })
        }
        (read, _) => read,
    }
}

/// A file beside the manifest.
///
/// # Errors
/// A sentence that says what is missing.
pub fn read(path: &str) -> Result<File, String> {
    let full = root().join(path);
    let text = fs::read_to_string(&full)
        .map_err(|error| format!("error: cannot read '{}': {error}", full.display()))?;
    Ok(File { source: Source::new(path, text), text: include(&full) })
}

/// The plan files that others use, seen from the manifest.
pub fn used() -> Disk {
    Disk(root())
}

/// The expression of the text of a file beside the manifest.
pub fn included(path: &str) -> TokenStream {
    include(&root().join(path))
}

/// The toolboxes that a plan can use.
pub struct Available {
    /// The toolboxes for the compiler of plans.
    pub toolboxes: Toolboxes,
    /// The expressions of the texts that were read, the project file's included.
    pub texts: Vec<TokenStream>,
    /// Toolboxes without a crate: the name and the error that says why.
    pub without_crate: Vec<(String, String)>,
}

/// The built-in toolboxes, then those of the project whose `afp.toml` stands beside the manifest or
/// above, then those of `files`, each with the module that implements it.
///
/// # Errors
/// A sentence that says what is missing or wrong.
pub fn toolboxes(files: &[(String, String)]) -> Result<Available, String> {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let mut all = Available { toolboxes, texts: Vec::new(), without_crate: Vec::new() };
    all.add_project().map_err(|error| error.to_string())?;
    for (path, module) in files {
        let file = read(path)?;
        all.toolboxes.add(file.source, module);
        all.texts.push(file.text);
    }
    Ok(all)
}

impl Available {
    fn add_project(&mut self) -> Result<(), ProjectError> {
        let root = root();
        let project = ProjectFile::find(&root)?;
        if project.exists {
            self.texts.push(include(&project.path()));
        }
        if let Some(name) = project.project.robot.as_ref().and_then(|it| it.toolbox.as_ref()) {
            self.toolboxes.set_robot(name);
        }
        for file in project.toolboxes()? {
            let name = file.toolbox.name;
            let path = match file.krate {
                Ok(krate) => rust_path(&krate, &root),
                Err(mistake) => {
                    let error = project.wrong(vec![mistake]).to_string();
                    self.without_crate.push((name.clone(), error));
                    name
                }
            };
            let shown = file.path.strip_prefix(&root).unwrap_or(&file.path).display().to_string();
            self.toolboxes.add(Source::new(shown, file.text), &path);
            self.texts.push(include(&file.path));
        }
        Ok(())
    }
}

/// The path of a toolbox's module as the crate under compilation names it.
fn rust_path(krate: &CrateLink, root: &Path) -> String {
    let is_here = krate.folder.is_some() && krate.folder == root.canonicalize().ok();
    let is_library = env::var("CARGO_CRATE_NAME").is_ok_and(|name| name == krate.rust_name())
        && env::var_os("CARGO_BIN_NAME").is_none();
    if is_here && is_library { krate.in_crate("crate") } else { krate.rust_path() }
}

/// The folder of the manifest.
pub fn root() -> PathBuf {
    env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default()
}

/// `include_str!` of a file.
fn include(path: &Path) -> TokenStream {
    let path = path.to_string_lossy();
    quote!(include_str!(#path))
}
