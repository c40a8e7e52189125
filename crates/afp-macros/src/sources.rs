//! Files relative to the manifest, and the toolboxes: built in, from the project, or from the
//! caller.

use std::path::{Path, PathBuf};
use std::{env, fs};

use afp_codegen::compile_error;
use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::files::Disk;
use afp_project::{CrateLink, ProjectError, ProjectFile};
use afp_syntax::source::Source;
use afp_toolboxes::project::OwnToolboxes;
use proc_macro2::TokenStream;
use quote::quote;

/// A text and the expression for it in the program.
pub struct File {
    /// The text, for the compiler of plans.
    pub source: Source,
    /// `include_str!`, or the text itself if it is built in.
    pub text: TokenStream,
}

/// The inputs for compiling a plan file.
pub struct Available {
    toolboxes: Toolboxes,
    /// The expressions of all read texts, including the project file.
    pub texts: Vec<TokenStream>,
    /// Toolboxes without a crate: the name and the error.
    pub without_crate: Vec<(String, String)>,
}

/// A toolbox file: relative to the manifest, or else built in.
///
/// # Errors
/// A compile error for a missing file, as everywhere in this module.
pub fn toolbox(path: &str) -> Result<File, TokenStream> {
    read(path).or_else(|missing| {
        let is_it = |each: &&afp_toolboxes::Builtin| each.file_name == path;
        let text = afp_toolboxes::ALL.iter().find(is_it).ok_or(missing)?.text;
        Ok(File { source: Source::new(path, text), text: quote!(#text) })
    })
}

/// A file relative to the manifest.
pub fn read(path: &str) -> Result<File, TokenStream> {
    let full = root().join(path);
    match fs::read_to_string(&full) {
        Ok(text) => Ok(File { source: Source::new(path, text), text: include(&full) }),
        Err(why) => Err(compile_error(&format!("error: cannot read '{}': {why}", full.display()))),
    }
}

/// The file itself, or the plan files of the folder, relative to the manifest.
///
/// # Errors
/// A folder that cannot be read.
pub fn plan_files(path: &str) -> Result<Vec<String>, TokenStream> {
    let root = root();
    if !root.join(path).is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let files = afp_project::all_files(&root.join(path)).map_err(|(folder, why)| {
        compile_error(&format!("error: cannot read the folder '{}': {why}", folder.display()))
    })?;
    let plans = files.iter().filter(|file| file.extension().is_some_and(|ending| ending == "afp"));
    Ok(plans.map(|file| file.strip_prefix(&root).unwrap_or(file).display().to_string()).collect())
}

/// A plan file, and the optional name of a plan after a colon: `patrol.afp:Search`.
///
/// # Errors
/// Those of [`read`].
pub fn read_plan(path: &str) -> Result<(File, Option<&str>), TokenStream> {
    match path.rsplit_once(':') {
        Some((file, plan)) if file.ends_with(".afp") => Ok((read(file)?, Some(plan))),
        _ => Ok((read(path)?, None)),
    }
}

/// Compiles a plan file: the plan of that name, or the first one. It uses the built-in toolboxes,
/// then those of the project with the `afp.toml` in the manifest's folder or above, then those of
/// `files`, each with the module of its implementation.
pub fn compile(
    file: &File,
    plan: Option<&str>,
    files: &[(String, String)],
) -> Result<(Compiled, Available), TokenStream> {
    let root = root();
    let mut all =
        Available::of_project(&root).map_err(|error| compile_error(&error.to_string()))?;
    for (path, module) in files {
        let File { source, text } = read(path)?;
        all.toolboxes.add(source, module);
        all.texts.push(text);
    }
    let disk = Disk(root.clone());
    let compiled = afp_dsl::compile_plan(&file.source, &all.toolboxes, &disk, plan);
    all.texts.extend(compiled.plan_sources().map(|source| include(&root.join(&source.name))));
    Ok((compiled, all))
}

impl Available {
    fn of_project(root: &Path) -> Result<Available, ProjectError> {
        let own = OwnToolboxes::read(ProjectFile::find(root)?)?;
        let project = &own.project;
        let mut texts = Vec::new();
        if project.exists {
            texts.push(include(&project.path()));
        }
        texts.extend(own.files().iter().map(|file| include(&file.path)));
        let without_crate = own.files().iter().filter_map(|file| {
            let mistake = file.krate.as_ref().err()?.clone();
            Some((file.toolbox.name.clone(), project.wrong(vec![mistake]).to_string()))
        });
        let without_crate = without_crate.collect();
        let toolboxes = own.with_built_in_as(
            |file| {
                let shown = file.path.strip_prefix(root).unwrap_or(&file.path);
                Source::new(shown.display().to_string(), &file.text)
            },
            |file| match &file.krate {
                Ok(krate) => rust_path(krate, root),
                Err(_) => file.toolbox.name.clone(),
            },
        )?;
        Ok(Available { toolboxes, texts, without_crate })
    }
}

/// The path of a toolbox's module in the crate under compilation.
fn rust_path(krate: &CrateLink, root: &Path) -> String {
    let is_here = krate.folder.is_some() && krate.folder == root.canonicalize().ok();
    let is_library = env::var("CARGO_CRATE_NAME").is_ok_and(|name| name == krate.rust_name())
        && env::var_os("CARGO_BIN_NAME").is_none();
    if is_here && (is_library || !has_library(root)) {
        krate.in_crate("crate")
    } else {
        krate.rust_path()
    }
}

/// Whether a package has a library; without one, a program has its own templates.
fn has_library(root: &Path) -> bool {
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap_or_default();
    root.join("src/lib.rs").exists() || manifest.lines().any(|line| line.trim() == "[lib]")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_without_a_library_has_its_own_templates() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert!(has_library(here));
        assert!(!has_library(&here.join("tests/wrong")));
        assert!(!has_library(&here.join("../../xtask")));
    }
}
