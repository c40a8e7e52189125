//! `afp.toml`: what a project says once instead of on every command line.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::error::RunError;

/// The file's name.
const NAME: &str = "afp.toml";

/// What `afp.toml` says.
#[derive(Clone, Debug, Default, Deserialize)]
pub struct Settings {
    /// How plans are run.
    #[serde(default)]
    pub run: Run,
    /// Where generated crates take the `afp` crates from.
    pub afp: Option<Afp>,
    /// Toolboxes of the project, by name.
    #[serde(default)]
    pub toolboxes: BTreeMap<String, Toolbox>,
    /// The folder that the file stands in; its paths are relative to it.
    #[serde(skip)]
    pub folder: PathBuf,
}

/// How plans are run.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// The world file.
    pub world: Option<PathBuf>,
}

/// Where generated crates take the `afp` crates from.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Afp {
    /// A checkout.
    pub path: Option<PathBuf>,
    /// A repository.
    pub git: Option<String>,
    /// A published version.
    pub version: Option<String>,
}

/// A toolbox of the project.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Toolbox {
    /// Its `.afp` file.
    pub path: PathBuf,
    /// The Rust crate that implements it.
    #[serde(rename = "crate")]
    pub krate: Option<String>,
}

impl Settings {
    /// Reads the nearest `afp.toml` in `folder` or above it; without one nothing is set.
    ///
    /// # Errors
    /// The file cannot be read, or says something wrong.
    pub fn find(folder: &Path) -> Result<Settings, RunError> {
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        let Some(home) = folder.ancestors().find(|above| above.join(NAME).is_file()) else {
            return Ok(Settings::default());
        };
        let path = home.join(NAME);
        let text = fs::read_to_string(&path)
            .map_err(RunError::file("cannot read the project file", &path))?;
        match toml_edit::de::from_str::<Settings>(&text) {
            Ok(settings) => Ok(Settings { folder: home.to_owned(), ..settings }),
            Err(error) => {
                let place = error.span().map(|span| place(&text, span.start));
                let message = error.message().to_owned();
                Err(RunError::Content { path, place, text, message })
            }
        }
    }
}

/// Line and column from 1 of a byte.
fn place(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
    (line, column)
}
