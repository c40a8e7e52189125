//! The name of the project file, and paths in messages.

use std::path::{Path, PathBuf};

/// The name of the project file.
pub(crate) const NAME: &str = "afp.toml";

/// A path as people name it who work in the current folder.
pub fn shown(path: &Path) -> PathBuf {
    let here = std::env::current_dir().ok();
    let below = here.and_then(|here| Some(path.strip_prefix(here).ok()?.to_owned()));
    below.unwrap_or_else(|| path.to_owned())
}
